#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

namespace {

/// The reporter "suite", which tests/runner reads: doctest's XML, with what
/// INFO and CAPTURE noted before an exception, which doctest leaves out.
struct SuiteReporter : doctest::XmlReporter {
  using XmlReporter::XmlReporter;

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
