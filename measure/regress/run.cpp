#include "measure/regress/run.h"

#include <algorithm>
#include <optional>
#include <set>

#include "core/files.h"
#include "core/json_node.h"
#include "core/machine.h"
#include "measure/regress/report.h"
#include "session/shipped.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

// Whether an earlier run wrote here; other programs have files of that name, too.
bool holds_results(const fs::path& output) {
  core::ProblemList problems;
  const auto file =
      core::read_json_file(output / "results.json", kMostResults_bytes, kResultsLimits, problems);
  if (!file) return false;
  const core::JsonNode json(*file, problems);
  return json.member("suite").present() && json.member("unapproved").present() &&
         json.member("cases").present();
}

// What an earlier run left goes; what is not ours stops the run.
void clear_output(const Suite& suite, const fs::path& output) {
  std::error_code status;
  if (fs::exists(output) && !fs::is_empty(output, status) && !holds_results(output))
    core::throw_input_error(ErrorClass::path, "--output", "\"" + output.string() + "\"",
                            "an empty folder, a new one, or one with results of an earlier run");
  if (core::lies_inside(suite.approved, output) || core::lies_inside(output, suite.approved))
    core::throw_input_error(
        ErrorClass::path, "--output", "\"" + output.string() + "\"",
        "a folder apart from the approved pictures in " + suite.approved.string());
  core::write_file_atomically(output / "results.json", results_json(suite, {}));
  for (const char* name : {"rendered", "pictures"}) fs::remove_all(output / name);
  for (const char* name : {"report.html", "junit.xml"}) fs::remove(output / name);
}

// What render says of its options, said of the suite's keys.
std::vector<core::Problem> problems_of(const core::InputError& error, const SuiteCase& one) {
  std::vector<core::Problem> problems = error.problems();
  for (core::Problem& problem : problems) {
    if (!problem.place.file.empty()) continue;
    problem.place = one.place;
    std::string key = problem.field.substr(problem.field.starts_with("--") ? 2 : 0);
    std::replace(key.begin(), key.end(), '-', '_');
    problem.field = "case \"" + one.name + "\" " + key;
  }
  return problems;
}

// Before anything is rendered; cases that share one are told once.
void check_data(const Suite& suite) {
  core::ProblemList problems;
  std::set<std::string> asked;
  for (const SuiteCase& one : suite.cases) {
    if (one.render.data.empty() || !asked.insert(one.render.data).second) continue;
    core::ProblemList missing;
    session::check_data_folder(one.render.data, "data", missing);
    if (missing.has_errors()) problems.append(problems_of(core::InputError(missing.all()), one));
  }
  problems.throw_if_errors();
}

CaseResult run_case(const Suite& suite, const SuiteCase& one, const SuiteRun& run,
                    std::optional<core::InstructionLevel> asked) {
  CaseResult result;
  result.name = one.name;
  result.folder = one.folder;
  const fs::path rendered = rendered_folder(run.output, one.folder);
  const fs::path approved = suite.approved / one.folder;
  try {
    core::limit_instructions(asked ? asked : one.isa, "isa");
    run.render(one, rendered);
    result.now = record_of(rendered);
    result.approval = read_approval(approved);
    result.pictures = compare_pictures(approved, rendered, one.tolerances);
    result.state = state_of(result.pictures);
  } catch (const core::InputError& error) {
    result.problems = problems_of(error, one);
    result.state = CaseState::failed;
  }
  return result;
}

void write_reports(const Suite& suite, const std::vector<CaseResult>& results,
                   const SuiteRun& run) {
  core::write_file_atomically(run.output / "results.json", results_json(suite, results));
  core::write_file_atomically(run.junit.empty() ? run.output / "junit.xml" : run.junit,
                              junit_xml(suite, results));
  if (!run.page) return;
  write_page_pictures(suite, results, run.output);
  core::write_file_atomically(run.output / "report.html", report_page(suite, results, run.output));
}

}  // namespace

std::vector<CaseResult> run_suite(const Suite& suite, const SuiteRun& run) {
  check_data(suite);
  clear_output(suite, run.output);
  const auto asked = core::instruction_limit();  // by --isa, which goes before what is pinned
  std::vector<CaseResult> results;
  for (const SuiteCase& one : suite.cases) {
    results.push_back(run_case(suite, one, run, asked));
    run.told(results.back());
  }
  core::limit_instructions(asked, "--isa");
  write_reports(suite, results, run);
  return results;
}

}  // namespace fanbeam::measure
