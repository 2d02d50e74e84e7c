#include <fmt/format.h>

#include "measure/regress/report.h"

namespace fanbeam::measure {

Verdict verdict_of(const std::vector<CaseResult>& results) {
  Verdict verdict;
  for (const CaseResult& result : results) {
    switch (result.state) {
      case CaseState::passed:
        ++verdict.passed;
        break;
      case CaseState::differs:
        ++verdict.differs;
        break;
      case CaseState::unapproved:
        ++verdict.unapproved;
        break;
      case CaseState::failed:
        ++verdict.failed;
        break;
    }
  }
  return verdict;
}

std::string text_of(const Verdict& verdict) {
  std::string text;
  const auto add = [&](std::size_t count, const std::string& what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(verdict.passed, "passed");
  add(verdict.differs, verdict.differs == 1 ? "differs" : "differ");
  add(verdict.unapproved, "not approved yet");
  add(verdict.failed, "could not be rendered");
  return text;
}

std::filesystem::path results_folder(const Suite& suite, const std::string& asked) {
  return asked.empty() ? std::filesystem::path("out") / "regress" / file_name_of(suite.name)
                       : std::filesystem::path(asked);
}

std::filesystem::path rendered_folder(const std::filesystem::path& output,
                                      const std::string& case_folder) {
  return output / "rendered" / case_folder;
}

}  // namespace fanbeam::measure
