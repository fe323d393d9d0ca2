#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <sstream>
#include <string>

namespace {

/// Whether an INFO around the check is a sentence; CAPTURE says "name := x".
bool is_said_in_words() {
  const auto* const contexts = doctest::IReporter::get_active_contexts();
  for (int i = 0; i < doctest::IReporter::get_num_active_contexts(); ++i) {
    std::ostringstream text;
    contexts[i]->stringify(&text);
    if (text.str().find(" := ") == std::string::npos) return true;
  }
  return false;
}

/// The reporter "suite", which tests/runner reads: doctest's XML, with what
/// INFO and CAPTURE noted before an exception, which doctest leaves out, and
/// without the code of a check whose INFO is a sentence.
struct SuiteReporter : doctest::XmlReporter {
  using XmlReporter::XmlReporter;

  void log_assert(const doctest::AssertData& check) override {
    if (!check.m_failed || check.m_threw || !is_said_in_words()) {
      XmlReporter::log_assert(check);
      return;
    }
    const auto severity = static_cast<doctest::assertType::Enum>(
        check.m_at &
        (doctest::assertType::is_warn | doctest::assertType::is_check |
         doctest::assertType::is_require));
    XmlReporter::log_message({"", check.m_file, check.m_line, severity});
  }

  void test_case_exception(const doctest::TestCaseException& error) override {
    XmlReporter::test_case_exception(error);
    for (int i = 0; i < get_num_stringified_contexts(); ++i) {
      xml.scopedElement("Info").writeText(
          get_stringified_contexts()[i].c_str());
    }
  }
};

}  // namespace

DOCTEST_REGISTER_REPORTER("suite", 0, SuiteReporter);
