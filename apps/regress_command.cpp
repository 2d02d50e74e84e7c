#include "apps/regress_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/regress/report.h"
#include "core/files.h"
#include "core/machine.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

constexpr std::uint64_t kMostSuite_bytes = 256U << 20U;

// Whether an earlier run wrote here; other programs have files of that name, too.
bool holds_results(const fs::path& output) {
  std::error_code status;
  if (!fs::is_regular_file(output / "results.json", status)) return false;
  const auto json = nlohmann::json::parse(
      core::read_file(output / "results.json", kMostSuite_bytes), nullptr, false);
  return json.is_object() && json.contains("suite") && json.contains("unapproved") &&
         json.contains("cases");
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

void render_case(const SuiteCase& one, const RegressOptions& options, const fs::path& folder) {
  RenderOptions render_options = one.render;
  render_options.output = folder.string();
  render_options.threads = options.threads;
  if (!options.data.empty()) render_options.data = options.data;
  CommonOptions quiet;
  quiet.quiet = true;
  render_options.repeatable = true;
  render(render_options, quiet);
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

CaseResult run_case(const Suite& suite, const SuiteCase& one, const RegressOptions& options,
                    const fs::path& output, std::optional<core::InstructionLevel> asked) {
  CaseResult result;
  result.name = one.name;
  result.folder = one.folder;
  const fs::path rendered = rendered_folder(output, one.folder);
  const fs::path approved = suite.approved / one.folder;
  try {
    core::limit_instructions(asked ? asked : one.isa, "isa");
    render_case(one, options, rendered);
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

void print_case(const CaseResult& result, bool quiet) {
  if (result.state == CaseState::passed) {
    if (!quiet) fmt::print("passed      {}: {} pictures\n", result.name, result.pictures.size());
    return;
  }
  std::string word(name_of(result.state));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  fmt::print("{:<11} {}\n", word, result.name);
  for (const PictureResult& picture : result.pictures)
    if (picture.state != PictureState::same) fmt::print("            {}\n", sentence_of(picture));
  const std::vector<SettingChange> changed = changes_of(result);
  for (const SettingChange& change : changed)
    fmt::print("            since the approval, {}: {} -> {}\n", change.key,
               change.approved.empty() ? "(absent)" : change.approved,
               change.now.empty() ? "(absent)" : change.now);
  std::fflush(stdout);
}

void write_reports(const Suite& suite, const std::vector<CaseResult>& results,
                   const RegressOptions& options, const fs::path& output) {
  core::write_file_atomically(output / "results.json", results_json(suite, results));
  core::write_file_atomically(
      options.junit.empty() ? output / "junit.xml" : fs::path(options.junit),
      junit_xml(suite, results));
  if (!options.page) return;
  write_page_pictures(suite, results, output);
  core::write_file_atomically(output / "report.html", report_page(suite, results, output));
}

}  // namespace

int regress(const RegressOptions& options, const CommonOptions& common) {
  core::ProblemList missing;
  check_data_folder(options.data, missing);
  missing.throw_if_errors();
  const Suite suite = read_valid_suite(options.suite);
  const fs::path output = results_folder(suite, options.output);
  clear_output(suite, output);
  const auto asked = core::instruction_limit();  // by --isa, which goes before what is pinned
  std::vector<CaseResult> results;
  core::ProblemList problems;
  for (const SuiteCase& one : suite.cases) {
    results.push_back(run_case(suite, one, options, output, asked));
    problems.append(results.back().problems);
    print_case(results.back(), common.quiet);
  }
  core::limit_instructions(asked, "--isa");
  write_reports(suite, results, options, output);
  const Verdict verdict = verdict_of(results);
  if (!common.quiet || !verdict.all_passed()) {
    fmt::print("{}: {}\n", suite.name, text_of(verdict));
    const fs::path shown = output / (options.page ? "report.html" : "results.json");
    fmt::print("{:11} {}\n", "report", fs::absolute(shown).lexically_normal().string());
  }
  if (verdict.failed > 0) {
    print_problems(problems.all());
    return exit_code_of(problems.all());
  }
  return verdict.all_passed() ? kExitDone : kExitCompareFailed;
}

int regression(const RegressionOptions& options, const CommonOptions& common) {
  return options.approves ? approve(options.approval, common) : regress(options.run, common);
}

}  // namespace fanbeam::apps
