#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/number_check.h"
#include "apps/regress_command.h"
#include "apps/value_words.h"

namespace fanbeam::apps {
namespace {

constexpr const char* kOutputHelp = "Folder of results (default out/regress/<suite name>)";

void add_run(CLI::App& regress, RegressOptions& options) {
  CLI::App& command = *regress.add_subcommand(
      "run", "Render the suite's cases, compare with the approved pictures and report");
  command.add_option("SUITE", options.suite, "TOML file (docs/regression.md)")
      ->type_name(kFileValue)
      ->required();
  add_output_option(command, options.output, kOutputHelp);
  command
      .add_option("--junit", options.junit,
                  "File for the JUnit XML (default junit.xml in the folder of results)")
      ->type_name(kFileValue);
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
  command.add_option("SUITE", options.suite, "TOML file (docs/regression.md)")
      ->type_name(kFileValue)
      ->required();
  command
      .add_option("--reason", options.reason,
                  "Why the new pictures are right; stands beside them in approval.json")
      ->required();
  command.add_option("--case", options.only,
                     "Name of one case (default: every case that did not pass)");
  add_output_option(command, options.output, kOutputHelp);
  return command;
}

}  // namespace

CLI::App& add_regress_command(CLI::App& program, RegressionOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "regress", "Image regression: a suite of pictures against approved ones");
  command.require_subcommand(1);
  add_run(command, options.run);
  CLI::App& approval = add_approve(command, options.approval);
  approval.callback([&options] { options.approves = true; });
  return command;
}

}  // namespace fanbeam::apps
