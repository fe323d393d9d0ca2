#pragma once

// The files that a render leaves: images, and the report.

#include <string>

#include "common/image/render_result.hpp"
#include "common/program/options.hpp"
#include "common/program/report.hpp"

namespace lightwalk {

/// Throws if one of the files cannot be written, and says which.
void check_files(const Options& options);

/// Writes all files that can be written, and reports the others on stderr. An
/// image that has no sample in some pixels does not replace an old image.
/// Lists the written images in `report.outputs`. Returns whether nothing
/// failed.
bool write_files(const std::string& program, const Options& options,
                 const RenderResult& result, Report& report);

}  // namespace lightwalk
