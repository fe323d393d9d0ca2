// stage-diff A B: are these two renders the same picture?
//
// Exit codes: 0 the same, 1 different, 2 cannot compare.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "common/image/image_file.hpp"
#include "common/program/command_line.hpp"
#include "common/program/console.hpp"
#include "common/program/signals.hpp"
#include "common/scene_file/message_text.hpp"
#include "compare/claims.hpp"
#include "compare/comparison.hpp"
#include "compare/spread_variance.hpp"
#include "compare/verdict.hpp"

namespace {

using namespace lightwalk;

/// Why two images cannot be compared.
struct CannotCompare : std::runtime_error {
  using std::runtime_error::runtime_error;
};

RenderResult read(const std::string& path) {
  RenderResult result;
  try {
    result = read_image(path);
  } catch (const std::exception& error) {
    throw CannotCompare(shortened(path, max_shown_name) + ": " +
                        error.what());
  }
  if (!result.note.empty()) {
    std::fprintf(stderr, "stage-diff: %s\n",
                 one_line(path + ": " + result.note).c_str());
  }
  for (const Image* image : {&result.radiance, &result.variance}) {
    const bool variance = image == &result.variance;
    for (std::size_t i = 0; i < image->pixels.size(); ++i) {
      const Vec3& pixel = image->pixels[i];
      const bool finite = is_finite(pixel);
      const bool negative = std::min({pixel.x, pixel.y, pixel.z}) < 0;
      if (finite && !(variance && negative)) continue;
      const auto width = static_cast<std::size_t>(image->width);
      throw CannotCompare(path + ": the " +
                          (variance ? "variance of the " : "") +
                          "pixel in column " + std::to_string(i % width) +
                          ", row " + std::to_string(i / width) + " is " +
                          (finite ? "negative" : "not finite"));
    }
  }
  return result;
}

/// One sample has no variance: the zeros in such a file say nothing.
bool has_variance(const RenderResult& result) {
  return !result.variance.pixels.empty() &&
         result.info.samples_per_pixel >= 2;
}

std::string size_of(const RenderResult& result) {
  return std::to_string(result.radiance.width) + " x " +
         std::to_string(result.radiance.height);
}

/// Why neither image says how noisy it is.
std::string no_variance(const std::string& a_path, const RenderResult& a,
                        const std::string& b_path, const RenderResult& b) {
  const auto why = [](const std::string& path, const RenderResult& image) {
    return path + (image.info.samples_per_pixel > 0
                       ? ": one sample per pixel has no variance"
                       : ": it has no variance");
  };
  return "cannot compare: " + why(a_path, a) + "; " + why(b_path, b) +
         "; at least one of them must be an .exr or a .pfm of two samples or "
         "more, to know what is noise";
}

/// An image without variance is taken to be as noisy as the other: per sample
/// if its samples are counted, and otherwise as a picture.
void borrow_variance(const std::string& path, RenderResult& poor,
                     const RenderResult& rich) {
  if (has_variance(poor)) return;
  const bool counted = poor.info.samples_per_pixel > 0;
  poor.variance = rich.variance;
  if (!counted) poor.info.samples_per_pixel = rich.info.samples_per_pixel;
  std::fprintf(stderr,
               "stage-diff: %s has no variance: %s taken to be as noisy as "
               "the other\n",
               one_line(path).c_str(),
               counted ? "a sample of it is" : "it is");
}

/// Two pictures whose variances are further apart come from two estimators, of
/// which one finds light by chance that the other looks for.
constexpr double unlike = 4;

bool other_bounds(const RenderInfo& a, const RenderInfo& b) {
  return a.max_bounces != b.max_bounces && a.max_bounces > 0 &&
         b.max_bounces > 0;
}

void warn_of_other_settings(const RenderInfo& a, const RenderInfo& b) {
  if (a.scene_hash != b.scene_hash && !a.scene_hash.empty() &&
      !b.scene_hash.empty()) {
    std::fprintf(stderr,
                 "stage-diff: WARNING: the two were rendered from different "
                 "scene files\n");
  }
  if (other_bounds(a, b)) {
    std::fprintf(stderr,
                 "stage-diff: WARNING: they have different bounds, %d and %d "
                 "bounces\n",
                 a.max_bounces, b.max_bounces);
  }
}

/// Whether no pixel has any noise.
bool is_quiet(const RenderResult& result) {
  return std::all_of(result.variance.pixels.begin(),
                     result.variance.pixels.end(),
                     [](const Vec3& pixel) { return pixel == Vec3(0); });
}

/// A number for people; "-" if it is not finite, as a quotient by zero.
std::string figure(const char* format, double x) {
  char text[400];
  std::snprintf(text, sizeof text, format, x);
  return std::isfinite(x) ? text : "-";
}

/// Refuses a picture that claims more noise than the pixels show.
void check_claims(const RenderResult& a, const RenderResult& b) {
  const auto claim = false_claim(a, b, tile_scale(a, b));
  if (!claim) return;
  const bool infinite = !std::isfinite(claim->times);
  throw CannotCompare(
      std::string("cannot compare: ") + (claim->by_test ? "A" : "B") +
      " claims " +
      (infinite ? "noise, beyond all of"
                : figure("%.3g", claim->times) + " times") +
      " the noise of " + (claim->by_test ? "B" : "A") +
      ", and its pixels show " + figure("%.2g", 100 * claim->shown) +
      " % of that, at " +
      place_of(claim->region, b.radiance.width, b.radiance.height));
}

/// Whether two pictures that have noise are equal in every bit.
bool same_bits(const RenderResult& a, const RenderResult& b) {
  return a.radiance.pixels == b.radiance.pixels && !is_quiet(b);
}

/// A remark on how noisy one sample of A is, if it is remarkable; `ratio` is
/// its variance over B's.
std::string noise_of(const RenderResult& a, const RenderResult& b,
                     double ratio) {
  if (is_quiet(a)) {
    return is_quiet(b) ? ""
                       : "; A has no noise at all, do its random "
                         "numbers do anything?";
  }
  if (!std::isfinite(ratio) || (ratio < 1.5 && ratio > 0.6)) return "";
  return "; " + figure("%.2f", ratio) +
         " times the variance of the reference, sample for sample: " +
         (ratio > 1 ? "noisier" : "quieter");
}

/// Errors over all pixels, for people who are used to them.
struct Totals {
  double ratio[3];      ///< mean of A over mean of B
  double rmse;          ///< root of the mean squared difference
  double relative_mse;  ///< of (A - B)^2 / (B^2 + 1e-4 mean(B)^2)
};

Totals totals_of(const RenderResult& a, const RenderResult& b) {
  Totals totals{};
  const Region all{0, 0, b.radiance.width, b.radiance.height};
  double squares = 0, relative = 0, mean = 0;
  for (int c = 0; c < 3; ++c) {
    const double reference = mean_over(b.radiance, all, c);
    totals.ratio[c] = mean_over(a.radiance, all, c) / reference;
    mean += reference / 3;
  }
  const double small = 1e-4 * mean * mean + 1e-30;
  for (std::size_t i = 0; i < b.radiance.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const auto x = static_cast<double>(a.radiance.pixels[i][c]);
      const auto y = static_cast<double>(b.radiance.pixels[i][c]);
      squares += (x - y) * (x - y);
      relative += (x - y) * (x - y) / (y * y + small);
    }
  }
  const double count = 3.0 * static_cast<double>(b.radiance.pixels.size());
  totals.rmse = std::sqrt(squares / count);
  totals.relative_mse = relative / count;
  return totals;
}

/// The z beyond which one of `count` looks is off by chance in at most one of
/// ten thousand comparisons.
double critical_z(std::size_t count) {
  double z = 4;
  while (false_alarm_rate(z, static_cast<double>(count)) > 1e-4) z += 0.05;
  return z;
}

/// What is not finite becomes null.
void print_json(bool same, const Totals& totals, const std::string& verdict,
                const RegionDifference& worst, double z_critical) {
  const Region& r = worst.region;
  const nlohmann::ordered_json region = {
      {"left", r.left},           {"top", r.top},
      {"width", r.width},         {"height", r.height},
      {"channel", worst.channel}, {"a", worst.test},
      {"b", worst.reference},     {"z", worst.z}};
  const nlohmann::ordered_json json = {
      {"same", same},        {"mean_ratio", totals.ratio},
      {"rmse", totals.rmse}, {"relative_mse", totals.relative_mse},
      {"worst", region},     {"z_critical", z_critical},
      {"verdict", verdict}};
  std::printf("%s\n", json.dump().c_str());
}

int compare(const std::string& a_path, const std::string& b_path,
            const std::string& picture, bool json, bool other_seeds) {
  RenderResult a = read(a_path), b = read(b_path);
  if (a.radiance.width != b.radiance.width ||
      a.radiance.height != b.radiance.height) {
    throw CannotCompare("the sizes differ: " + a_path + " is " + size_of(a) +
                        ", " + b_path + " is " + size_of(b));
  }
  if (!has_variance(a) && !has_variance(b)) {
    throw CannotCompare(no_variance(a_path, a, b_path, b));
  }
  // A borrowed variance knows nothing of a picture's rare bright pixels.
  const bool own_variances = has_variance(a) && has_variance(b);
  borrow_variance(a_path, a, b);
  borrow_variance(b_path, b, a);
  warn_of_other_settings(a.info, b.info);
  if (other_seeds && same_bits(a, b)) {
    throw CannotCompare(
        "cannot compare: the same bits from two seeds: is this one render "
        "twice, or does the seed change nothing?");
  }
  check_claims(a, b);

  Bands bands;
  const int width = b.radiance.width, height = b.radiance.height;
  const int scale = tile_scale(a, b);
  RenderResult test = a, reference = b;
  const double ratio = variance_ratio(a, b);
  if (own_variances && ratio > unlike) spread_variance(test);
  if (own_variances && ratio < 1 / unlike) spread_variance(reference);
  const auto all = compare_regions(test, reference, bands,
                                   more_regions_of(width, height, scale));
  const PixelSum pixels = own_variances
                              ? sum_over_pixels(test, reference, bands)
                              : PixelSum{HUGE_VAL, -HUGE_VAL};
  bands.z_critical = critical_z(all.size() + 3);
  std::vector<RegionDifference> differing;
  std::copy_if(all.begin(), all.end(), std::back_inserter(differing),
               [&](const auto& one) { return !one.same(bands); });
  const bool pixels_same = pixels.z <= bands.z_critical;
  const bool same = differing.empty() && pixels_same;
  const Totals totals = totals_of(a, b);
  std::string verdict =
      (same ? same_as_far_as_seen(all, bands, 8 * scale)
            : "different: A is " +
                  describe(all, differing, bands, width, height,
                           [](const Region&) { return std::string(); })) +
      (pixels_same ? "" : "; its pixels are further off than their noise") +
      (same && same_bits(a, b)
           ? "; they are the same bits, is this one render twice?"
           : noise_of(a, b, ratio));
  if (!same && other_bounds(a.info, b.info)) {
    verdict += "; their bounds are " + std::to_string(a.info.max_bounces) +
               " and " + std::to_string(b.info.max_bounces) + " bounces";
  }
  const RegionDifference& worst = *worst_of(all);
  if (!picture.empty()) {
    const RenderResult panels{difference_picture(a, b), {}, {}};
    const ToneMapping as_it_is{.steps = {}, .gamma_before = 2.2f};
    try {
      write_image(picture, panels, as_it_is);
    } catch (const std::exception& error) {
      throw CannotCompare(picture + " cannot be written: " + error.what());
    }
  }
  if (json) {
    print_json(same, totals, verdict, worst, bands.z_critical);
    return same ? 0 : 1;
  }
  const auto place = place_of(worst.region, width, height);
  std::printf("%s\n", verdict.c_str());
  std::printf("mean A/B  red %s  green %s  blue %s\n",
              figure("%.4f", totals.ratio[0]).c_str(),
              figure("%.4f", totals.ratio[1]).c_str(),
              figure("%.4f", totals.ratio[2]).c_str());
  std::printf("RMSE %s   relative MSE %s\n",
              figure("%.4g", totals.rmse).c_str(),
              figure("%.4g", totals.relative_mse).c_str());
  std::printf("variance A/B %s\n", figure("%.3f", ratio).c_str());
  std::printf("largest z %s of %zu regions, at %s; %.2f would differ\n",
              std::isfinite(worst.z) ? figure("%.2f", worst.z).c_str()
                                     : "beyond measure (there is no noise)",
              all.size(), place.c_str(), bands.z_critical);
  std::printf("squared differences of pixels %s times their noise%s\n",
              figure("%.3g", std::max(0.0, pixels.times)).c_str(),
              pixels.z > 0 ? figure(", z %.2f", pixels.z).c_str() : "");
  return same ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::string a, b, picture;
  bool json = false, other_seeds = false;
  const std::string program = "stage-diff";
  const std::string example = "build/stage-diff a.pfm b.pfm -o diff.png";
  CLI::App app("Are two renders the same picture, but for their noise?",
               program);
  app.formatter(std::make_shared<HelpText>(example, "A B [OPTION]..."));
  app.allow_windows_style_options(false);  // /home/ana/a.pfm is a file
  app.add_option("A", a, "Image (.pfm, .exr, .ppm, .hdr or .tif)");
  app.add_option("B", b, "Image to compare with, the reference");
  app.add_option("-o,--output", picture,
                 "One picture of both, their difference and z (.png)")
      ->type_name("IMAGE")
      ->check(named_with("images", std::array{".png"}));
  app.add_flag("--json", json, "Print the figures as JSON");
  app.add_flag("--other-seeds", other_seeds,
               "Refuse the same bits: A and B had different seeds");
  add_help_and_version(app, LIGHTWALK_VERSION);
  app.footer("Exit codes: 0 the same, 1 different, 2 cannot compare.");
  if (const auto code = parse(app, argc, argv)) {
    return checked_output(program, *code, 2);
  }
  if (app.count("B") == 0) {
    return wrong_usage(program,
                       "two images are required, as in '" + example + "'");
  }
  ignore_failing_writes();
  try {
    const int code = compare(a, b, picture, json, other_seeds);
    return checked_output(program, code, 2);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stage-diff: %s\n", one_line(error.what()).c_str());
    return 2;
  }
}
