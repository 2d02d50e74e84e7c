// What became of a case: its pictures against the approved ones.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "measure/regress/approval.h"
#include "measure/regress/tolerance.h"

namespace fanbeam::measure {

enum class PictureState {
  same,        // within its tolerance
  differs,     // beyond it
  changed,     // of another size, or with other layers: no cells to compare
  missing,     // approved, but not rendered any more
  unapproved,  // rendered, but not approved
  unreadable   // one of the two is damaged
};

struct PictureResult {
  std::string file;  // "bscope/00000.png", below the case's folder
  PictureState state = PictureState::same;
  std::vector<LayerJudgement> layers;  // of same and differs
  std::string note;                    // of changed and unreadable: how
  std::optional<Tolerance> tolerance;  // absent: every value equal
};

enum class CaseState { passed, differs, unapproved, failed };

struct CaseResult {
  std::string name;
  std::string folder;
  CaseState state = CaseState::failed;
  std::vector<PictureResult> pictures;
  std::optional<Approval> approval;     // absent: nothing is approved yet
  Approval now;                         // what this run would be approved with, but for the reason
  std::vector<core::Problem> problems;  // why it failed
};

// The word for results.json, and the plain sentence for a reader.
std::string_view name_of(PictureState state);
std::string_view name_of(CaseState state);
// "rms 0.8 grey (0.5 allowed)" and its like, with no markup; the sentence names the picture before.
std::string what_of(const PictureResult& picture);
std::string sentence_of(const PictureResult& picture);

// Of an EXR's layers the one that a page shows: the first beyond its tolerance. Empty where none is known
// to be, and then the first that is there.
std::string shown_layer(const PictureResult& picture);

// Of a case with an approval, since then; none where it failed.
std::vector<SettingChange> changes_of(const CaseResult& result);

// Compares every PNG and EXR below two folders; `product` of a picture is its first folder.
std::vector<PictureResult> compare_pictures(const std::filesystem::path& approved,
                                            const std::filesystem::path& rendered,
                                            const std::map<std::string, Tolerance>& tolerances);

// Passed when every picture is the same, unapproved when all that speaks against it is pictures
// that nobody approved.
CaseState state_of(const std::vector<PictureResult>& pictures);

}  // namespace fanbeam::measure
