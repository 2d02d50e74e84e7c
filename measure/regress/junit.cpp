#include <fmt/format.h>

#include "measure/regress/markup.h"
#include "measure/regress/report.h"

namespace fanbeam::measure {
namespace {

std::string lines_of(const CaseResult& result) {
  std::string text;
  for (const core::Problem& problem : result.problems) text += core::to_string(problem) + "\n";
  for (const PictureResult& picture : result.pictures)
    if (picture.state != PictureState::same) text += sentence_of(picture) + "\n";
  if (!result.approval) return text;
  for (const SettingChange& change : changes_of(result))
    text += fmt::format("changed since the approval: {}: {} -> {}\n", change.key, change.approved,
                        change.now);
  return text;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string test_case(const Suite& suite, const CaseResult& result) {
  const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"",
                                       markup_text(suite.name), markup_text(result.name));
  if (result.state == CaseState::passed) return head + "/>\n";
  const std::string lines = lines_of(result);
  const char* kind = result.state == CaseState::failed ? "error" : "failure";
  return fmt::format("{}>\n      <{} type=\"{}\" message=\"{}\">{}</{}>\n    </testcase>\n", head,
                     kind, name_of(result.state), markup_text(first_line(lines)),
                     markup_text(lines), kind);
}

}  // namespace

// No times and no host: the same pictures give the same bytes.
std::string junit_xml(const Suite& suite, const std::vector<CaseResult>& results) {
  const Verdict verdict = verdict_of(results);
  const std::string counts =
      fmt::format("name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\"", markup_text(suite.name),
                  results.size(), verdict.differs + verdict.unapproved, verdict.failed);
  std::string text =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n  <testsuite {}>\n",
                  counts, counts);
  for (const CaseResult& result : results) text += test_case(suite, result);
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace fanbeam::measure
