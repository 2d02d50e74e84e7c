#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/regress/report.h"
#include "apps/regress_command.h"
#include "core/files.h"
#include "core/folder_swap.h"
#include "core/spelling.h"
#include "core/text.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

constexpr std::uint64_t kMostResults_bytes = 256U << 20U;

nlohmann::json results_of(const fs::path& output) {
  const fs::path file = output / "results.json";
  if (!fs::exists(file))
    core::throw_input_error(ErrorClass::io, core::Place{file.string()}, "results", "not found",
                            "results of fanbeam regress run, with the same -o");
  try {
    return nlohmann::json::parse(core::read_file(file, kMostResults_bytes));
  } catch (const nlohmann::json::exception& error) {
    core::throw_input_error(ErrorClass::parse, core::Place{file.string()}, "", error.what(),
                            "the results that fanbeam regress run writes");
  }
}

// The cases to approve, as results.json has them.
std::vector<nlohmann::json> chosen(const Suite& suite, const nlohmann::json& results,
                                   const std::string& only) {
  std::vector<std::string> names;
  for (const SuiteCase& one : suite.cases) names.push_back(one.name);
  if (!only.empty() && std::find(names.begin(), names.end(), only) == names.end()) {
    std::string near;
    for (const std::string& name : core::nearest_names(only, names, 3)) near += " " + name;
    core::throw_input_error(ErrorClass::ref, "--case", "\"" + only + "\"",
                            "a case of the suite, such as" + near);
  }
  std::vector<nlohmann::json> cases;
  core::ProblemList problems;
  for (const nlohmann::json& one : results.at("cases")) {
    const bool asked = one.at("name") == only;
    if (asked || (only.empty() && one.at("state") != name_of(CaseState::passed)))
      cases.push_back(one);
    if ((asked || only.empty()) && one.at("state") == name_of(CaseState::failed))
      problems.error(ErrorClass::ref, {}, "case \"" + one.at("name").get<std::string>() + "\"",
                     "not rendered", "pictures: run the suite again once the case is mended");
  }
  problems.throw_if_errors();
  return cases;
}

// All pictures of the case or, when anything fails, none.
void approve_case(const Suite& suite, const SuiteCase& one, const fs::path& output,
                  const std::string& reason, bool quiet) {
  const fs::path rendered = rendered_folder(output, one.folder);
  const fs::path approved = suite.approved / one.folder;
  std::size_t pictures = 0;
  core::replace_folder(approved, [&](const fs::path& folder) {
    for (const PictureResult& picture : compare_pictures({}, rendered, {})) {
      core::write_file_atomically(folder / picture.file,
                                  core::read_file(rendered / picture.file, kMostResults_bytes));
      ++pictures;
    }
    Approval approval = record_of(rendered);
    approval.reason = reason;
    write_approval(folder, approval);
  });
  if (!quiet)
    fmt::print("approved    {}: {} pictures, {}\n", one.name, pictures, approved.string());
}

// Results of another state of the suite say nothing about this one.
void refuse_other_suite(const Suite& suite, const nlohmann::json& results, const fs::path& output) {
  if (results.at("input") != nlohmann::json::parse(results_json(suite, {})).at("input"))
    core::throw_input_error(ErrorClass::ref, core::Place{(output / "results.json").string()},
                            "results", "of another state of " + suite.file.string(),
                            "results of the suite as it is: run it again");
  if (results.at("cases").empty())
    core::throw_input_error(ErrorClass::ref, core::Place{(output / "results.json").string()},
                            "results", "of a run that did not end", "a whole run of the suite");
}

}  // namespace

int approve(const ApproveOptions& options, const CommonOptions& common) {
  const std::string reason(core::trimmed(options.reason));
  if (reason.empty())
    core::throw_input_error(ErrorClass::range, "--reason", "\"" + options.reason + "\"",
                            "why the new pictures are right");
  const Suite suite = read_valid_suite(options.suite);
  const fs::path output = results_folder(suite, options.output);
  const nlohmann::json results = results_of(output);
  std::size_t approved = 0;
  try {
    refuse_other_suite(suite, results, output);
    core::remove_abandoned_temporaries(suite.approved);
    for (const nlohmann::json& result : chosen(suite, results, options.only))
      for (const SuiteCase& one : suite.cases)
        if (result.at("name") == one.name) {
          approve_case(suite, one, output, reason, common.quiet);
          ++approved;
        }
  } catch (const nlohmann::json::exception& error) {
    core::throw_input_error(ErrorClass::parse, core::Place{(output / "results.json").string()}, "",
                            error.what(), "the results that fanbeam regress run writes");
  }
  if (approved == 0 && !common.quiet)
    fmt::print("nothing to approve: every case passed (--case NAME approves one all the same)\n");
  return kExitDone;
}

}  // namespace fanbeam::apps
