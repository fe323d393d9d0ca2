#pragma once

// The files that a render leaves: images, and the report.

#include <string>

#include "common/image/render_result.hpp"
#include "common/program/options.hpp"
#include "common/program/report.hpp"

namespace lightwalk {

/// Throws where one of the files cannot be written, and says which.
void check_files(const Options& options);

/// Writes all files that can be written, and says on stderr what becomes of
/// the others. An old image is not replaced by one that has no sample in some
/// pixels. `report.outputs` is left with the images that were written.
/// Returns whether nothing failed.
bool write_files(const std::string& program, const Options& options,
                 const RenderResult& result, Report& report);

}  // namespace lightwalk
