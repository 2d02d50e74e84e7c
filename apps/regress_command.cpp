#include "apps/regress_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/render_command.h"
#include "apps/scene_choice.h"
#include "core/text.h"
#include "measure/regress/report.h"
#include "measure/regress/run.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using measure::CaseResult;
using measure::CaseState;

void render_case(const measure::SuiteCase& one, const RegressOptions& options,
                 const fs::path& folder) {
  RenderOptions render_options;
  static_cast<session::RenderRequest&>(render_options) = one.render;
  render_options.repeatable = true;
  render_options.output = folder.string();
  render_options.threads = options.threads;
  CommonOptions quiet;
  quiet.quiet = true;
  render(render_options, quiet);
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
  for (const measure::PictureResult& picture : result.pictures)
    if (picture.state != measure::PictureState::same)
      fmt::print("            {}\n", sentence_of(picture));
  for (const measure::SettingChange& change : changes_of(result))
    fmt::print("            since the approval, {}: {} -> {}\n", change.key,
               change.approved.empty() ? "(absent)" : change.approved,
               change.now.empty() ? "(absent)" : change.now);
  std::fflush(stdout);
}

// The suite, the approved pictures and the scenes; what is wrong with a scene is told with its case.
std::vector<fs::path> files_read(const measure::Suite& suite) {
  std::vector<fs::path> files = {suite.file, suite.approved};
  for (const measure::SuiteCase& one : suite.cases) {
    try {
      core::ProblemList told_later;
      const auto of_scene = files_of_scene(one.render, read_chosen_scene(one.render, told_later));
      files.insert(files.end(), of_scene.begin(), of_scene.end());
    } catch (const core::InputError&) {
    }
  }
  return files;
}

int regress(const RegressOptions& options, const CommonOptions& common) {
  core::ProblemList missing;
  check_data_folder(options.data, missing);
  missing.throw_if_errors();
  measure::Suite suite = measure::read_valid_suite(options.suite, shipped_folder());
  if (!options.data.empty())
    for (measure::SuiteCase& one : suite.cases) one.render.data = options.data;
  if (!options.junit.empty()) refuse_output_among(files_read(suite), options.junit, "--junit");
  const fs::path output = results_folder(suite, options.output);
  const std::vector<CaseResult> results =
      run_suite(suite, {output, options.junit, options.page,
                        [&](const measure::SuiteCase& one, const fs::path& folder) {
                          render_case(one, options, folder);
                        },
                        [&](const CaseResult& result) { print_case(result, common.quiet); }});
  const measure::Verdict verdict = measure::verdict_of(results);
  if (!common.quiet || !verdict.all_passed()) {
    fmt::print("{}: {}\n", suite.name, text_of(verdict));
    const fs::path shown = output / (options.page ? "report.html" : "results.json");
    fmt::print("{:11} {}\n", "report", fs::absolute(shown).lexically_normal().string());
  }
  if (verdict.failed > 0) {
    core::ProblemList problems;
    for (const CaseResult& result : results) problems.append(result.problems);
    print_problems(problems.all());
    return exit_code_of(problems.all());
  }
  return verdict.all_passed() ? kExitDone : kExitCompareFailed;
}

int approve(const ApproveOptions& options, const CommonOptions& common) {
  const std::string reason(core::trimmed(options.reason));
  if (reason.empty())
    core::throw_input_error(core::ErrorClass::range, "--reason", "\"" + options.reason + "\"",
                            "why the new pictures are right");
  const measure::Suite suite = measure::read_valid_suite(options.suite, shipped_folder());
  const std::size_t approved = approve_cases(
      suite, {results_folder(suite, options.output), options.only, reason,
              [&](const measure::SuiteCase& one, std::size_t pictures, const fs::path& folder) {
                if (!common.quiet)
                  fmt::print("approved    {}: {} pictures, {}\n", one.name, pictures,
                             folder.string());
              }});
  if (approved == 0 && !common.quiet)
    fmt::print("nothing to approve: every case passed (--case NAME approves one all the same)\n");
  return kExitDone;
}

}  // namespace

int regression(const RegressionOptions& options, const CommonOptions& common) {
  return options.approves ? approve(options.approval, common) : regress(options.run, common);
}

}  // namespace fanbeam::apps
