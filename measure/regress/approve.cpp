#include <algorithm>
#include <map>

#include "core/files.h"
#include "core/folder_swap.h"
#include "core/json_node.h"
#include "core/spelling.h"
#include "core/text.h"
#include "measure/regress/report.h"
#include "measure/regress/run.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

core::JsonFile results_in(const fs::path& file) {
  if (!fs::exists(file))
    core::throw_input_error(ErrorClass::io, core::Place{file.string()}, "results", "not found",
                            "results of fanbeam regress run, with the same -o");
  core::ProblemList problems;
  const auto results = core::read_json_file(file, kMostResults_bytes, kResultsLimits, problems);
  problems.throw_if_errors();
  return *results;
}

// Results of another state of the suite say nothing about this one.
void refuse_other_suite(const Suite& suite, const core::JsonNode& results) {
  const core::JsonFile own =
      *core::parse_json(results_json(suite, {}), "", kResultsLimits, results.problems());
  if (results.required("input").dumped() !=
      core::JsonNode(own, results.problems()).required("input").dumped())
    core::throw_input_error(ErrorClass::ref, results.place(), "results",
                            "of another state of " + suite.file.string(),
                            "results of the suite as it is: run it again");
  if (results.required("cases").elements() == 0)
    core::throw_input_error(ErrorClass::ref, results.place(), "results",
                            "of a run that did not end", "a whole run of the suite");
}

// State by folder, which stands for the case's name.
std::map<std::string, std::string> states_in(const core::JsonNode& results) {
  std::map<std::string, std::string> states;
  const core::JsonNode cases = results.required("cases");
  for (std::size_t i = 0; i < cases.elements(); ++i) {
    const core::JsonNode one = cases.element(i);
    states[one.required("folder").text().value_or("")] = one.required("state").text().value_or("");
  }
  results.problems().throw_if_errors();
  return states;
}

std::vector<const SuiteCase*> chosen(const Suite& suite,
                                     const std::map<std::string, std::string>& states,
                                     const std::string& only) {
  std::vector<const SuiteCase*> cases;
  core::ProblemList problems;
  for (const SuiteCase& one : suite.cases) {
    const auto found = states.find(one.folder);
    if (found == states.end() || (!only.empty() && one.name != only)) continue;
    if (found->second == name_of(CaseState::failed))
      problems.error(ErrorClass::ref, {}, "case \"" + one.name + "\"", "not rendered",
                     "pictures: run the suite again once the case is mended");
    else if (!only.empty() || found->second != name_of(CaseState::passed))
      cases.push_back(&one);
  }
  problems.throw_if_errors();
  return cases;
}

void refuse_unknown_case(const Suite& suite, const std::string& only) {
  std::vector<std::string> names;
  for (const SuiteCase& one : suite.cases) names.push_back(one.name);
  if (only.empty() || std::find(names.begin(), names.end(), only) != names.end()) return;
  std::string near;
  for (const std::string& name : core::nearest_names(only, names, 3)) near += " " + name;
  core::throw_input_error(ErrorClass::ref, "--case", "\"" + only + "\"",
                          "a case of the suite, such as" + near);
}

std::size_t approve_case(const fs::path& rendered, const fs::path& approved,
                         const std::string& reason) {
  std::size_t pictures = 0;
  core::replace_folder(approved, [&](const fs::path& folder) {
    for (const PictureResult& picture : compare_pictures({}, rendered, {})) {
      core::write_file_atomically(folder / picture.file,
                                  core::read_file(rendered / picture.file, kMostPicture_bytes));
      ++pictures;
    }
    Approval approval = record_of(rendered);
    approval.reason = reason;
    write_approval(folder, approval);
  });
  return pictures;
}

}  // namespace

std::size_t approve_cases(const Suite& suite, const Approving& approving) {
  core::ProblemList problems;
  const core::JsonFile file = results_in(approving.output / "results.json");
  const core::JsonNode results(file, problems);
  refuse_unknown_case(suite, approving.only);
  refuse_other_suite(suite, results);
  const auto cases = chosen(suite, states_in(results), approving.only);
  core::remove_abandoned_temporaries(suite.approved);
  for (const SuiteCase* one : cases) {
    const fs::path approved = suite.approved / one->folder;
    approving.told(
        *one,
        approve_case(rendered_folder(approving.output, one->folder), approved, approving.reason),
        approved);
  }
  return cases.size();
}

}  // namespace fanbeam::measure
