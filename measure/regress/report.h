// What a run of a suite leaves behind for people and for machines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/json_size.h"
#include "measure/regress/case_result.h"
#include "measure/regress/suite.h"

namespace fanbeam::measure {

// Files larger than these are refused.
inline constexpr std::uint64_t kMostPicture_bytes = 256U << 20U;
inline constexpr std::uint64_t kMostResults_bytes = 256U << 20U;
inline constexpr core::JsonLimits kResultsLimits{64, 20'000'000};

struct Verdict {
  std::size_t passed = 0, differs = 0, unapproved = 0, failed = 0;
  bool all_passed() const { return differs + unapproved + failed == 0; }
};
Verdict verdict_of(const std::vector<CaseResult>& results);
// "3 passed, 1 differs": what there is of each.
std::string text_of(const Verdict& verdict);

// `asked`, else out/regress/<suite name>.
std::filesystem::path results_folder(const Suite& suite, const std::string& asked);
// Where a case is rendered, below the folder of results.
std::filesystem::path rendered_folder(const std::filesystem::path& output,
                                      const std::string& case_folder);

// results.json. Without results it says that a run was begun.
std::string results_json(const Suite& suite, const std::vector<CaseResult>& results);
// JUnit XML as Jenkins and GitLab read it: one suite, one test case per case.
std::string junit_xml(const Suite& suite, const std::vector<CaseResult>& results);

// Pictures of what is not the same, for the page: approved, new, and where they differ, as PNG.
void write_page_pictures(const Suite& suite, const std::vector<CaseResult>& results,
                         const std::filesystem::path& output);
// report.html: no scripts, nothing from elsewhere; pictures by relative paths.
std::string report_page(const Suite& suite, const std::vector<CaseResult>& results,
                        const std::filesystem::path& output);

enum class PageSide { approved, rendered, difference };
// "pictures/<case>/bscope/00000.png.new.png": the same path is a URL.
std::string page_picture(const std::string& case_folder, const std::string& file, PageSide side);

}  // namespace fanbeam::measure
