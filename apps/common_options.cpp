#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/common.h"
#include "apps/number_check.h"
#include "renderer/plan/plan.h"
#include "session/version.h"

namespace fanbeam::apps {

void add_common_options(CLI::App& command, CommonOptions& common) {
  command.set_version_flag(
      "--version", "fanbeam " + session::version_text() + " (" + session::commit_text() + ")");
  command.add_flag("-q,--quiet", common.quiet,
                   "No progress and no notes: only what was asked for, and errors");
  command.add_option("--log-level", common.log_level, "Least message level shown")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error"}))
      ->capture_default_str();
  command
      .add_option("--isa", common.isa,
                  "Use no instructions beyond this level of x86-64 (v2 SSE4.2, v3 AVX2, v4 "
                  "AVX-512), in our kernels and in Embree, for pictures that machines of several "
                  "kinds are to share (default: the best of this machine)")
      ->check(CLI::IsMember({"v2", "v3", "v4"}));
}

// No refinement reaches 0, and past 100 of 255 levels there is no picture left to speak of.
CLI::Option* add_accuracy_option(CLI::App& command, double& accuracy_grey,
                                 const std::string& what) {
  return command.add_option("--accuracy", accuracy_grey, what)
      ->check(number_from(renderer::kAccuracies_grey.low, renderer::kAccuracies_grey.high));
}

}  // namespace fanbeam::apps
