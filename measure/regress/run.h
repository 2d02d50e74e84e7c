// Runs a suite: renders every case, holds it against what is approved, leaves results and reports;
// and takes what a run rendered as approved. How a case is rendered is the caller's.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "measure/regress/case_result.h"
#include "measure/regress/suite.h"

namespace fanbeam::measure {

struct SuiteRun {
  std::filesystem::path output;  // results_folder
  std::filesystem::path junit;   // empty: junit.xml in the output folder
  bool page = true;              // report.html with its pictures
  // Renders a case into a new folder. What it throws as InputError is of the case, its options by their
  // names on the command line.
  std::function<void(const SuiteCase& one, const std::filesystem::path& folder)> render;
  std::function<void(const CaseResult& result)> told;  // of each case, once it is judged
};

// Writes rendered/, results.json, junit.xml and report.html. Processors' instructions are limited as the
// caller did already, else as suite and cases say, case by case. Throws InputError, before anything is
// rendered: E-IO for folders of data that are not there, E-PATH for an output folder that holds something
// else than earlier results, or overlaps the approved pictures.
std::vector<CaseResult> run_suite(const Suite& suite, const SuiteRun& run);

struct Approving {
  std::filesystem::path output;  // of the run
  std::string only;              // name of a case; empty: every case that did not pass
  std::string reason;            // why the new pictures are right
  std::function<void(const SuiteCase& one, std::size_t pictures,
                     const std::filesystem::path& folder)>
      told;  // of each case
};

// Case by case all pictures or, when anything fails, none. How many cases. Throws InputError: E-REF for
// a case that the suite has not, that could not be rendered, and for results of another state of the
// suite; E-IO and E-PARSE for results that are not there, or not what a run leaves.
std::size_t approve_cases(const Suite& suite, const Approving& approving);

}  // namespace fanbeam::measure
