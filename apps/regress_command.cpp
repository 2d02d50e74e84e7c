// fanbeam regress: a suite of pictures against approved ones, and approving new ones.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
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

struct RegressOptions {
  std::string suite;   // TOML file
  std::string output;  // default out/regress/<suite name>
  std::string data;    // folder instead of the suite's
  std::string junit;   // default junit.xml in the output folder
  bool page = true;    // report.html with its pictures
  int threads = 0;
};

struct ApproveOptions {
  std::string suite, output;
  std::string reason;
  std::string only;  // name of a case; empty: every case that did not pass
};

struct RegressionOptions {
  bool approves = false;  // its subcommands: run, or approve
  RegressOptions run;
  ApproveOptions approval;
};

constexpr const char* kOutputHelp = "Folder of results (default out/regress/<suite name>)";

void add_run(CLI::App& regress, RegressOptions& options) {
  CLI::App& command = *regress.add_subcommand(
      "run", "Render the suite's cases, compare with the approved pictures and report");
  add_file(command, "SUITE", options.suite, "TOML file (docs/regression.md)")->required();
  add_output_option(command, options.output, kOutputHelp);
  add_file(command, "--junit", options.junit,
           "File for the JUnit XML (default junit.xml in the folder of results)");
  command.add_flag(
      "--html,!--no-html", options.page,
      "Write report.html with the pictures that differ (the default), or leave it out");
  add_data_option(command, options.data, "instead of the suite's");
  add_threads_option(command, options.threads);
  command.footer(
      "--isa replaces what the suite pins. docs/regression.md tells how to use it in a CI.");
}

CLI::App& add_approve(CLI::App& regress, ApproveOptions& options) {
  CLI::App& command = *regress.add_subcommand(
      "approve", "Take the pictures of the last run as the approved ones, and keep the reason");
  add_file(command, "SUITE", options.suite, "TOML file (docs/regression.md)")->required();
  command
      .add_option("--reason", options.reason,
                  "Why the new pictures are right; stands beside them in approval.json")
      ->required();
  command.add_option("--case", options.only,
                     "Name of one case (default: every case that did not pass)");
  add_output_option(command, options.output, kOutputHelp);
  return command;
}

CLI::App& declare_regress(CLI::App& program, RegressionOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "regress", "Image regression: a suite of pictures against approved ones");
  command.require_subcommand(1);
  add_run(command, options.run);
  CLI::App& approval = add_approve(command, options.approval);
  approval.callback([&options] { options.approves = true; });
  return command;
}

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
    fmt::print("{:11} {}\n", "report", full_path(shown));
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

// Does the one or the other (measure/regress/run.h), and tells. Of run: 0 when all pictures are within
// their tolerances; 1 when some are not, or are not approved yet; otherwise, after the reports were
// written, what the cases that could not be rendered ask for (exit_code_of). Throws InputError for a
// suite that is not valid, before anything is rendered, and E-RANGE for a reason that says nothing.
int regression(const RegressionOptions& options, const CommonOptions& common) {
  return options.approves ? approve(options.approval, common) : regress(options.run, common);
}

}  // namespace

void add_regress(CommandLine& line) { line.add(declare_regress, regression); }

}  // namespace fanbeam::apps
