#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/common.h"

namespace fanbeam::apps {

void add_common_options(CLI::App& command, CommonOptions& common) {
  command.set_version_flag("--version", "fanbeam " + version_text() + " (" + commit_text() + ")");
  command.add_flag("-q,--quiet", common.quiet,
                   "No progress and no notes: only what was asked for, and errors");
  command.add_option("--log-level", common.log_level, "Least message level shown")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error"}))
      ->capture_default_str();
}

}  // namespace fanbeam::apps
