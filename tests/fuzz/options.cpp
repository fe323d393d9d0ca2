// The command line: refused in one line with exit code 2, or understood, and
// then every value is one that the program can do.

#include "common/program/options.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/image/image_file.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

namespace {

constexpr int most_bounces = 64;

/// What is printed while it lives: stdout and stderr are streams in memory.
class Printed {
 public:
  Printed() : stdout_(stdout), stderr_(stderr) {
    stdout = open_memstream(&out_, &out_size_);
    stderr = open_memstream(&err_, &err_size_);
  }
  ~Printed() {
    std::fclose(stdout);
    std::fclose(stderr);
    stdout = stdout_;
    stderr = stderr_;
    std::free(out_);
    std::free(err_);
  }
  Printed(const Printed&) = delete;
  Printed& operator=(const Printed&) = delete;

  std::string errors() {
    std::fflush(stderr);
    return {err_, err_size_};
  }

 private:
  std::FILE *stdout_, *stderr_;
  char *out_ = nullptr, *err_ = nullptr;
  std::size_t out_size_ = 0, err_size_ = 0;
};

template <class Number>
bool within(const std::optional<Number>& value, Number least, Number most) {
  return !value || (*value >= least && *value <= most);
}

void check(const Options& options) {
  for (const std::string& path : options.outputs) {
    expect(std::count(image_endings.begin(), image_endings.end(),
                      ending(path)) == 1,
           "an output is an image", path);
  }
  expect(!options.outputs.empty() || options.report || options.pixel,
         "something is asked for");
  expect(within(options.samples_per_pixel, 1, 1'000'000'000), "--spp fits");
  expect(within(options.max_bounces, 0, most_bounces), "--max-bounces fits");
  expect(within(options.threads, 0, 1024), "--threads fits");
  if (options.size) {
    expect(options.size->width >= 1 && options.size->width <= 65536 &&
               options.size->height >= 1 && options.size->height <= 65536,
           "--size fits");
  }
  if (options.pixel) {
    expect(options.pixel->column >= 0 && options.pixel->row >= 0 &&
               options.pixel->sample <= 999'999'999,
           "--pixel and --sample fit");
  }
  const ToneMapping& mapping = options.tone_mapping;
  expect(mapping.gamma >= 0.1f && mapping.gamma <= 10, "--gamma fits");
  expect(std::abs(mapping.exposure) <= 40, "--exposure fits");
}

}  // namespace

/// One argument a line.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words{"stage5", ""};
  for (const char c : text_of(data, size)) {
    if (c == '\n') {
      words.emplace_back();
    } else if (c != '\0') {  // no argument can hold one
      words.back() += c;
    }
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);

  Options options;
  std::optional<int> code;
  std::string errors;
  {
    Printed printed;
    code = parse_options(count, arguments.data(),
                         {.program = "stage5",
                          .description = "A program.",
                          .most_bounces = most_bounces},
                         options);
    errors = printed.errors();
  }
  if (!code) {
    expect(errors.empty(), "what is understood is no error", errors);
    check(options);
  } else if (*code == 2) {
    expect(!errors.empty() && errors.back() == '\n' &&
               is_one_line(errors.substr(0, errors.size() - 1)),
           "wrong usage is told in one line", errors);
  } else {
    expect(*code == 0, "the exit code is 0 or 2", std::to_string(*code));
    expect(errors.empty(), "--help and --version are no errors", errors);
  }
  return 0;
}
