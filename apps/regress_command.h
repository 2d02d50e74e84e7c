// fanbeam regress: a suite of pictures against approved ones, and approving new ones.
#pragma once

#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

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

// Does the one or the other (measure/regress/run.h), and tells. Of run: 0 when all pictures are within
// their tolerances; 1 when some are not, or are not approved yet; otherwise, after the reports were
// written, what the cases that could not be rendered ask for (exit_code_of). Throws InputError for a
// suite that is not valid, before anything is rendered, and E-RANGE for a reason that says nothing.
int regression(const RegressionOptions& options, const CommonOptions& common);
CLI::App& add_regress_command(CLI::App& program, RegressionOptions& options);

}  // namespace fanbeam::apps
