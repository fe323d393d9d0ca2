#include "common/program/run.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

#include "common/program/command_line.hpp"
#include "common/program/console.hpp"
#include "common/program/memory.hpp"
#include "common/program/options.hpp"
#include "common/program/output_files.hpp"
#include "common/program/path_story.hpp"
#include "common/program/processor_time.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"
#include "common/program/signals.hpp"
#include "common/scene_file/message_text.hpp"
#include "common/scene_file/scene_file.hpp"

namespace lightwalk {

namespace {

/// Set by the first Ctrl-C, or another signal that asks the program to end;
/// a second one of the same kind ends it at once.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void catch_interrupts() {
  catch_ending_signals([](int signal) {
    interrupted = true;
#ifdef SIGHUP
    // A terminal that closes may say so twice, and the system says each
    // second that the processor time is used up.
    if (signal == SIGHUP || signal == SIGXCPU) return;
#endif
    std::signal(signal, SIG_DFL);
  });
}

/// Each setting is the command line's, or else the scene's, or else the
/// program's.
RenderSettings settings_for(const Program& program, const Options& options,
                            const LoadedScene& loaded) {
  RenderSettings settings;
  settings.samples_per_pixel = options.samples_per_pixel.value_or(
      loaded.samples_per_pixel.value_or(settings.samples_per_pixel));
  settings.first_sample = options.first_sample.value_or(0);
  settings.max_bounces = options.max_bounces.value_or(
      loaded.max_bounces.value_or(program.default_bounces));
  settings.seed = options.seed.value_or(settings.seed);
  settings.sampling = options.sampling.value_or(settings.sampling);
  settings.threads = options.threads.value_or(settings.threads);
  settings.photons = options.photons.value_or(settings.photons);
  settings.neighbors = options.neighbors.value_or(settings.neighbors);
  settings.filter = options.filter.value_or(settings.filter);
  settings.radius = options.radius.value_or(settings.radius);
  if (settings.max_bounces > program.bounce_limit) {
    throw std::runtime_error(
        options.scene + " asks for " + std::to_string(settings.max_bounces) +
        " bounces, and " + program.name + " can do at most " +
        std::to_string(program.bounce_limit));
  }
  return settings;
}

/// Uses a path tracer. What it throws becomes an error that names it.
template <class Use>
void with_path_tracer(Use use) {
  try {
    use();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Stopped&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error("error: the path tracer threw an exception: " +
                             std::string(error.what()));
  } catch (...) {
    throw std::runtime_error(
        "error: the path tracer threw something that is not a "
        "std::exception");
  }
}

/// While this object lives, a path of this thread is cut after 100,000 rays.
class LengthLimit final : public RayWatcher {
 public:
  LengthLimit() { ray_watcher = this; }
  ~LengthLimit() { ray_watcher = nullptr; }
  LengthLimit(const LengthLimit&) = delete;
  LengthLimit& operator=(const LengthLimit&) = delete;

  void look() override {
    if (rays_cast - before_ > 100'000) throw Stopped();
  }

 private:
  std::uint64_t before_ = rays_cast;
};

void say_what_was_dropped(const RenderInfo& info) {
  if (!info.first_dropped) return;
  const auto [column, row, sample] = *info.first_dropped;
  std::fprintf(
      stderr,
      "%s: %llu samples were not finite and were left out; the first "
      "is pixel %d,%d, sample %u: --pixel %d,%d --sample %u tells its "
      "path\n",
      info.stage.c_str(), static_cast<unsigned long long>(info.dropped),
      column, row, sample, column, row, sample);
}

void say_what_was_rendered(const Report& report) {
  const RenderInfo& info = report.info;
  for (const std::string& path : report.outputs) {
    std::printf("%s: %d x %d, %.0f samples per pixel\n",
                escaped(path).c_str(), report.width, report.height,
                info.samples_per_pixel);
  }
  if (info.samples == 0) return;
  const auto samples = static_cast<double>(info.samples);
  std::printf("%.2f s, %ssamples/s, %.3g rays per sample\n", report.seconds,
              with_unit(samples / report.seconds).c_str(),
              static_cast<double>(info.rays) / samples);
}

int paint_scene(const Program& program, const PathTracerCalls& tracing,
                const Options& options, LoadedScene& loaded,
                const RenderSettings& settings) {
  const Camera& camera = loaded.scene.camera;
  check_memory(camera);
  ignore_failing_writes();
  check_files(options);

  RenderProgress progress;
  catch_interrupts();
  RenderResult result;
  const double cpu_start = processor_seconds();
  const auto start = std::chrono::steady_clock::now();
  {
    const double samples = static_cast<double>(camera.width) * camera.height *
                           settings.samples_per_pixel;
    std::optional<Progress> watched;
    if (!options.quiet) {
      watched.emplace(program.name, progress, thread_count(settings.threads),
                      samples);
    }
    with_path_tracer([&] {
      result = tracing.paint(loaded.scene, settings, interrupted, progress);
    });
  }
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start;
  const double cpu_seconds = processor_seconds() - cpu_start;

  RenderInfo& info = result.info;
  info.stage = program.name;
  info.scene_hash = loaded.hash;
  info.version = LIGHTWALK_VERSION;
  Report report{
      .scene = options.scene,
      .width = camera.width,
      .height = camera.height,
      .info = info,
      .threads = thread_count(settings.threads),
      .seconds = elapsed.count(),
      .cpu_seconds = cpu_seconds,
      .interrupted =
          interrupted && info.samples_per_pixel < settings.samples_per_pixel,
  };
  const bool all_written = write_files(program.name, options, result, report);
  say_what_was_dropped(info);
  const bool any_written = all_written || !report.outputs.empty();
  if (any_written && !options.quiet) say_what_was_rendered(report);
  if (report.interrupted) {
    std::fprintf(stderr,
                 "%s: interrupted after %.0f of %d samples per pixel\n",
                 program.name.c_str(), info.samples_per_pixel,
                 settings.samples_per_pixel);
  }
  if (!all_written) return 1;
  return report.interrupted ? 130 : 0;
}

int tell_path(const Program& program, const PathTracerCalls& tracing,
              const PixelSample& which, const LoadedScene& loaded,
              const RenderSettings& settings) {
  const Camera& camera = loaded.scene.camera;
  if (which.column >= camera.width || which.row >= camera.height) {
    return wrong_usage(program.name,
                       "--pixel: " + std::to_string(which.column) + "," +
                           std::to_string(which.row) +
                           " is outside the picture of " +
                           std::to_string(camera.width) + " x " +
                           std::to_string(camera.height) + " pixels");
  }
  PathLog log;
  Vec3 radiance;
  try {
    const PathListener listener(log);
    const LengthLimit limit;
    with_path_tracer(
        [&] { radiance = tracing.sample(loaded.scene, settings, which); });
  } catch (const Stopped&) {
    throw std::runtime_error(
        "the sample follows more than 100,000 rays, too many to print: try "
        "fewer --max-bounces");
  }
  std::printf("%s: pixel %d,%d, sample %u, seed %llu\n\n",
              program.name.c_str(), which.column, which.row, which.sample,
              static_cast<unsigned long long>(settings.seed));
  std::fputs(path_story(log, radiance, loaded, settings).c_str(), stdout);
  return 0;
}

int run_scene(const Program& program, const PathTracerCalls& tracing,
              const Options& options) {
  LoadedScene loaded = load_scene(options.scene, program.syllabus);
  if (!options.quiet) {
    for (const std::string& warning : loaded.warnings) {
      std::fprintf(stderr, "%s: %s\n", program.name.c_str(),
                   one_line(warning).c_str());
    }
  }
  const RenderSettings settings = settings_for(program, options, loaded);
  if (options.size) {
    loaded.scene.camera.width = options.size->width;
    loaded.scene.camera.height = options.size->height;
  }
  return options.pixel
             ? tell_path(program, tracing, *options.pixel, loaded, settings)
             : paint_scene(program, tracing, options, loaded, settings);
}

}  // namespace

int run(int argc, char** argv, const Program& program,
        const PathTracerCalls& tracing) {
  prepare_console();
  Options options;
  if (const auto code = parse_options(argc, argv, program, options)) {
    return checked_output(program.name, *code, 1);
  }
  try {
    const int code = run_scene(program, tracing, options);
    return checked_output(program.name, code, 1);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s: there is not enough memory\n",
                 program.name.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program.name.c_str(),
                 one_line(error.what()).c_str());
  }
  return 1;
}

}  // namespace lightwalk
