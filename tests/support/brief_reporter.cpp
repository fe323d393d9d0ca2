// The reporter "brief": collects what fails, and prints it at the end or, if
// the suite was started by run_suite, tells that program at once.

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>

#include "support/report.hpp"

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace {

using lightwalk::tests::as_line;
using lightwalk::tests::kind_of;

class BriefReporter : public doctest::IReporter {
 public:
  explicit BriefReporter(const doctest::ContextOptions& options)
      : options_(options) {
    if (const char* pipe = std::getenv(lightwalk::tests::pipe_variable)) {
      pipe_ = std::atoi(pipe);
    }
  }

  void test_case_start(const doctest::TestCaseData& test) override {
    const int kind = kind_of(test.m_test_suite);
    if (tell({"begin", test.m_name, std::to_string(kind)})) return;
    report_.begin_test(test.m_name, kind);
  }
  void test_case_end(const doctest::CurrentTestCaseStats&) override {
    if (crashed_ || tell({"end"})) return;
    report_.end_test();
  }
  void log_assert(const doctest::AssertData& data) override {
    if (!data.m_failed) return;
    std::string says = std::string(data.m_expr) + '\n';
    if (data.m_threw) {
      says += std::string("threw: ") + data.m_exception.c_str() + '\n';
    } else if (data.m_decomp.size() > 0 && data.m_decomp != data.m_expr) {
      says += std::string("with values: ") + data.m_decomp.c_str() + '\n';
    }
    fail(contexts() + says, place(data.m_file, data.m_line));
  }
  void log_message(const doctest::MessageData& data) override {
    const std::string says = data.m_string.c_str();
    if (data.m_severity != doctest::assertType::is_warn) {
      fail(says + '\n' + contexts(), place(data.m_file, data.m_line));
    } else if (!tell({"note", says})) {
      report_.note(says);
    }
  }
  void test_case_exception(const doctest::TestCaseException& error) override {
    crashed_ = crashed_ || error.is_crash;
    // run_suite sees by itself how the program ends.
    if (error.is_crash && pipe_ >= 0) return;
    const std::string says = error.error_string.c_str();
    // doctest's own; the exception itself comes when the test ends.
    if (says.starts_with("exception thrown in subcase")) return;
    std::string before;
    const int count = get_num_stringified_contexts();
    for (int i = 0; i < count; ++i) {
      before += std::string(get_stringified_contexts()[i].c_str()) + '\n';
    }
    fail((error.is_crash ? "crashed: " : "threw: ") + says + '\n' + before,
         "");
  }

  void test_run_end(const doctest::TestRunStats& stats) override {
    const unsigned tests = stats.numTestCasesPassingFilters;
    if (pipe_ >= 0) {
      if (!crashed_) tell({"done", std::to_string(tests)});
      return;
    }
    *options_.cout << report_.summary(tests, std::filesystem::absolute(
                                                 options_.binary_name.c_str())
                                                 .lexically_normal()
                                                 .string())
                   << std::flush;
  }

  void subcase_start(const doctest::SubcaseSignature&) override {
    tell({"alive"});
  }
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void subcase_end() override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  void fail(const std::string& says, const std::string& place) {
    if (!tell({"fail", says, place})) report_.fail(says, place);
  }

  /// False where nobody listens.
  bool tell(const std::vector<std::string>& fields) const {
    if (pipe_ < 0) return false;
#if __has_include(<unistd.h>)
    const std::string line = as_line(fields);
    std::size_t written = 0;
    while (written < line.size()) {
      const auto count = write(pipe_, line.data() + written,
                               static_cast<unsigned>(line.size() - written));
      if (count <= 0) break;
      written += static_cast<std::size_t>(count);
    }
#endif
    return true;
  }

  /// The file as it is called in the tree, whose folders are known.
  static std::string place(std::string file, int line) {
    const std::size_t folder = file.rfind("/tests/");
    if (folder != std::string::npos) file.erase(0, folder + 1);
    return file + ':' + std::to_string(line);
  }

  /// What CAPTURE and INFO have noted.
  static std::string contexts() {
    std::ostringstream text;
    const int count = get_num_active_contexts();
    for (int i = 0; i < count; ++i) {
      get_active_contexts()[i]->stringify(&text);
      text << '\n';
    }
    return text.str();
  }

  const doctest::ContextOptions& options_;
  int pipe_ = -1;
  bool crashed_ = false;
  lightwalk::tests::Report report_;
};

}  // namespace

DOCTEST_REGISTER_REPORTER("brief", 0, BriefReporter);
