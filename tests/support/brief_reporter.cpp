// What a student reads when tests fail: at most a screenful, and the most
// telling first. `stageN_tests` by itself says everything.

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace {

/// One failed test, with what its first failed check says.
struct Failure {
  std::string test, says;
  int checks = 0;
  bool golden = false;
};

/// The text in lines of at most 78 columns, each behind `indent`.
std::string wrapped(const std::string& text, const std::string& indent) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string row;
    for (std::string word; words >> word;) {
      if (!row.empty() && indent.size() + row.size() + word.size() > 77) {
        result += indent + row + '\n';
        row.clear();
      }
      row += (row.empty() ? "" : " ") + word;
    }
    result += indent + row + '\n';
  }
  return result;
}

class BriefReporter : public doctest::IReporter {
 public:
  explicit BriefReporter(const doctest::ContextOptions& options)
      : options_(options), out_(*options.cout) {}

  void test_case_start(const doctest::TestCaseData& test) override {
    current_ = {};
    current_.test = test.m_name;
    current_.golden = std::string(test.m_test_suite) == "golden images";
    name_ = test.m_name;
    began_ = std::clock();
  }
  void test_case_end(const doctest::CurrentTestCaseStats&) override {
    name_ = nullptr;
    if (current_.checks > 0) failures_.push_back(current_);
    current_.checks = 0;
  }
  void log_assert(const doctest::AssertData& data) override {
    if (!data.m_failed) return;
    std::ostringstream says;
    says << data.m_expr << '\n';
    if (data.m_threw) {
      says << "threw: " << data.m_exception.c_str() << '\n';
    } else {
      says << "with values: " << data.m_decomp.c_str() << '\n';
    }
    add(says.str() + contexts() + place(data.m_file, data.m_line));
  }
  void log_message(const doctest::MessageData& data) override {
    if (data.m_severity == doctest::assertType::is_warn) return;
    add(data.m_string.c_str() + std::string("\n") + contexts());
  }
  void test_case_exception(const doctest::TestCaseException& error) override {
    add((error.is_crash ? "crashed: " : "threw: ") +
        std::string(error.error_string.c_str()) + '\n' + contexts());
  }

  void test_run_end(const doctest::TestRunStats& stats) override {
    if (failures_.empty()) {
      out_ << stats.numTestCasesPassingFilters << " tests pass\n";
      return;
    }
    out_ << failures_.size() << " of " << stats.numTestCasesPassingFilters
         << " tests fail, the first of them:\n";
    print(failures_.front());
    const auto golden =
        std::find_if(failures_.begin() + 1, failures_.end(),
                     [](const Failure& one) { return one.golden; });
    if (golden != failures_.end()) print(*golden);
    std::size_t named = 0;
    for (auto one = failures_.begin() + 1; one != failures_.end(); ++one) {
      if (one == golden) continue;
      if (named == most_named) break;
      if (named++ == 0) out_ << "\nand\n";
      out_ << "  " << one->test << '\n';
    }
    const std::size_t told = 1 + named + (golden != failures_.end());
    if (told < failures_.size()) {
      out_ << "  and " << failures_.size() - told << " more\n";
    }
    out_ << "\nAll that they say: "
         << std::filesystem::absolute(options_.binary_name.c_str())
                .lexically_normal()
                .string()
         << '\n';
  }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override { std::thread(watch).detach(); }
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  static constexpr std::size_t most_named = 8;

  /// Processor time, so that a busy machine stops nobody. No right stage's
  /// test takes a fortieth of it.
  static constexpr int most_seconds = 120;

  /// Ends the program when a test does not end, and says which.
  static void watch() {
    for (;;) {
      std::this_thread::sleep_for(std::chrono::seconds(1));
      const char* const name = name_;
      if (!name || std::clock() - began_ < most_seconds * CLOCKS_PER_SEC) {
        continue;
      }
      std::printf(
          "a test does not end: %s\n"
          "    stopped after %d seconds of processor time; is there a "
          "path without an end?\n",
          name, most_seconds);
      std::fflush(stdout);
      std::_Exit(1);
    }
  }

  void add(const std::string& says) {
    if (current_.checks++ == 0) current_.says = says;
  }

  static std::string place(const char* file, int line) {
    return std::string(file) + ':' + std::to_string(line) + '\n';
  }

  /// What CAPTURE and INFO have noted.
  static std::string contexts() {
    std::ostringstream text;
    const int count = doctest::IReporter::get_num_active_contexts();
    for (int i = 0; i < count; ++i) {
      doctest::IReporter::get_active_contexts()[i]->stringify(&text);
      text << '\n';
    }
    return text.str();
  }

  void print(const Failure& failure) {
    out_ << "\n  " << failure.test << '\n' << wrapped(failure.says, "    ");
    if (failure.checks > 1) {
      out_ << "    (and " << failure.checks - 1 << " more in this test)\n";
    }
  }

  inline static std::atomic<const char*> name_{nullptr};
  inline static std::atomic<std::clock_t> began_{0};

  const doctest::ContextOptions& options_;
  std::ostream& out_;
  Failure current_;
  std::vector<Failure> failures_;
};

}  // namespace

DOCTEST_REGISTER_REPORTER("brief", 0, BriefReporter);
