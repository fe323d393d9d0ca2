#pragma once

// The one `main` that every stage shares: reads the command line and the
// scene, renders, and writes the images.
//
// Exit codes: 0 done, 1 could not, 2 wrong usage, 130 interrupted.

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>

#include "common/image/image_file.hpp"
#include "common/program/options.hpp"
#include "common/program/program.hpp"
#include "common/program/progress_line.hpp"
#include "common/scene_file/scene_file.hpp"

namespace lightwalk {

/// Set by the first Ctrl-C; a second one ends the program at once.
inline std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

inline void catch_interrupts() {
  std::signal(SIGINT, [](int) {
    interrupted = true;
    std::signal(SIGINT, SIG_DFL);
  });
}

/// The memory of the machine in bytes, or 0 where it is not known.
inline double physical_memory() {
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGESIZE));
#else
  return 0;
#endif
}

/// Throws where the picture would not fit into the machine's memory.
inline void check_memory(const Camera& camera) {
  const double needed =
      static_cast<double>(sizeof(Pixel) + 4 * sizeof(Vec3)) * camera.width *
      camera.height;
  const double memory = physical_memory();
  if (memory > 0 && needed > 0.8 * memory) {
    throw std::runtime_error(
        "an image of " + std::to_string(camera.width) + " x " +
        std::to_string(camera.height) + " pixels needs " + with_unit(needed) +
        "B of memory, and this machine has " + with_unit(memory) + "B");
  }
}

/// The film as a picture, with what is to be known about it.
inline RenderResult develop(const Film& film, RenderInfo info) {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  for (const Pixel& pixel : film.pixels()) {
    fewest = std::min(fewest, pixel.samples + pixel.dropped);
    info.dropped += pixel.dropped;
  }
  info.samples_per_pixel = fewest;
  return {film.radiance(), film.variance(), std::move(info)};
}

/// Writes all images; the name of one that fails is put before the reason.
inline void write_outputs(const Options& options,
                          const RenderResult& result) {
  for (const std::string& path : options.outputs) {
    try {
      write_image(path, result, options.tone_mapping);
    } catch (const std::exception& error) {
      throw std::runtime_error(path + " cannot be written: " + error.what());
    }
  }
}

inline int run_scene(const Program& program, const Options& options) {
  LoadedScene loaded = load_scene(options.scene, program.syllabus);
  Scene& scene = loaded.scene;
  RenderSettings settings;
  settings.seed = options.seed;
  settings.sampling = options.sampling;
  settings.samples_per_pixel = options.samples_per_pixel.value_or(
      loaded.samples_per_pixel.value_or(settings.samples_per_pixel));
  settings.max_bounces = options.max_bounces.value_or(
      loaded.max_bounces.value_or(program.default_bounces));
  if (settings.max_bounces > program.most_bounces) {
    throw std::runtime_error(
        options.scene + " asks for " + std::to_string(settings.max_bounces) +
        " bounces, and " + program.name + " can do at most " +
        std::to_string(program.most_bounces));
  }
  if (options.size) {
    scene.camera.width = options.size->width;
    scene.camera.height = options.size->height;
  }
  check_memory(scene.camera);
  for (const std::string& path : options.outputs) {
    try {
      check_writable(path);
    } catch (const ImageError& error) {
      throw std::runtime_error(path + " cannot be written: " + error.what());
    }
  }

  Film film(scene.camera.width, scene.camera.height);
  const double pixels = static_cast<double>(film.pixels().size());
  RenderProgress progress;
  catch_interrupts();
  const auto start = std::chrono::steady_clock::now();
  {
    const ProgressLine line(progress, pixels * settings.samples_per_pixel,
                            !options.quiet);
    render(program.renderer(scene, settings), settings.samples_per_pixel,
           options.threads, film, interrupted, progress);
  }
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start;

  const RenderResult result =
      develop(film, {program.name, 0, settings.seed, settings.max_bounces,
                     loaded.sha256, progress.rays, 0, LIGHTWALK_VERSION});
  write_outputs(options, result);
  if (result.info.dropped > 0) {
    std::fprintf(stderr,
                 "%s: %llu samples were not finite and were left out\n",
                 program.name.c_str(),
                 static_cast<unsigned long long>(result.info.dropped));
  }
  const bool cut_short = interrupted && result.info.samples_per_pixel <
                                            settings.samples_per_pixel;
  if (!options.quiet) {
    const auto samples = static_cast<double>(progress.samples.load());
    for (const std::string& path : options.outputs) {
      std::printf("%s: %d x %d, %.0f samples per pixel\n", path.c_str(),
                  film.width(), film.height(), result.info.samples_per_pixel);
    }
    std::printf("%.2f s, %ssamples/s, %.3g rays per sample\n",
                elapsed.count(), with_unit(samples / elapsed.count()).c_str(),
                static_cast<double>(progress.rays.load()) / samples);
  }
  if (cut_short) {
    std::fprintf(stderr,
                 "%s: interrupted after %.0f of %d samples per pixel\n",
                 program.name.c_str(), result.info.samples_per_pixel,
                 settings.samples_per_pixel);
    return 130;
  }
  return 0;
}

/// Runs a stage. Its `main` returns what this returns.
inline int run(int argc, char** argv, const Program& program) {
  Options options;
  if (const auto code =
          parse_options(argc, argv, program.name, program.description,
                        program.most_bounces, options)) {
    return *code;
  }
  try {
    return run_scene(program, options);
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
