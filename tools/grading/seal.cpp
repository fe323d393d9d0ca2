// Says which tests have passed, in words that only this file can write.
//
// A student's code runs in the same process as the tests, and could print that
// all of them pass. So the grader hands over a secret: this reads it before any
// code of the student runs, closes its pipe, and puts it before each line that
// it writes. The grader believes no line without it.

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace {

constexpr std::size_t secret_bytes = 32;
char secret[secret_bytes + 1] = {};
int pipe_out = -1;

/// LIGHTWALK_SEAL names two descriptors: where the secret is, and where the
/// lines go.
void take_secret(int, char**, char** environment) {
  for (char** one = environment; *one; ++one) {
    const std::string text(*one);
    const std::string name = "LIGHTWALK_SEAL=";
    if (text.rfind(name, 0) != 0) continue;
    char* end = nullptr;
    const int in =
        static_cast<int>(std::strtol(text.c_str() + name.size(), &end, 10));
    pipe_out = static_cast<int>(std::strtol(end + 1, nullptr, 10));
    if (read(in, secret, secret_bytes) != secret_bytes) secret[0] = '\0';
    close(in);
  }
}

// The loader calls these before all constructors, in the order of linking.
[[gnu::used,
  gnu::section(".preinit_array")]] void (*const first)(int, char**,
                                                       char**) = take_secret;

struct Seal : doctest::IReporter {
  std::string passed, name;

  explicit Seal(const doctest::ContextOptions&) {}
  void test_case_start(const doctest::TestCaseData& test) override {
    name = test.m_name;
  }
  void test_case_end(const doctest::CurrentTestCaseStats& test) override {
    if (test.failure_flags) return;
    passed += std::string(secret) + ' ' + name + '\n';
  }
  void test_run_end(const doctest::TestRunStats&) override {
    passed += std::string(secret) + '\n';
    for (std::size_t done = 0; done < passed.size();) {
      const auto wrote =
          write(pipe_out, passed.data() + done, passed.size() - done);
      if (wrote <= 0) return;
      done += static_cast<std::size_t>(wrote);
    }
  }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};

}  // namespace

DOCTEST_REGISTER_LISTENER("seal", 0, Seal);
