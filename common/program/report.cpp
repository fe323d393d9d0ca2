#include "common/program/report.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "common/files/write_file.hpp"

namespace lightwalk {

std::string to_json(const Report& report) {
  const RenderInfo& info = report.info;
  const auto samples = static_cast<double>(info.samples);
  nlohmann::ordered_json json = {
      {"program", info.stage},
      {"scene", report.scene},
      {"scene_hash", info.scene_hash},
      {"width", report.width},
      {"height", report.height},
      {"samples_per_pixel",
       static_cast<std::uint64_t>(info.samples_per_pixel)},
      {"first_sample", info.first_sample},
      {"max_bounces", info.max_bounces},
      {"seed", info.seed},
      {"threads", report.threads},
      {"seconds", report.seconds},
      {"cpu_seconds", report.cpu_seconds},
      {"samples", info.samples},
      {"rays", info.rays},
      {"samples_per_second", samples / report.seconds},
      {"rays_per_sample", static_cast<double>(info.rays) / samples},
      {"dropped", info.dropped},
      {"interrupted", report.interrupted},
      {"version", info.version},
      {"outputs", report.outputs},
  };
  // File names need not be UTF-8, and JSON must be.
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
  return json.dump(2, ' ', false, replace) + "\n";
}

void write_report(const std::string& path, const Report& report) {
  write_file(path, to_json(report));
}

}  // namespace lightwalk
