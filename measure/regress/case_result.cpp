#include "measure/regress/case_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/errors.h"
#include "measure/image_files.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;

std::set<std::string> pictures_below(const fs::path& folder) {
  std::set<std::string> files;
  for (const fs::path& image : image_files_below(folder)) files.insert(image.generic_string());
  return files;
}

std::string size_of(const core::Image& image) {
  return fmt::format("{} x {}", image.columns, image.rows);
}

std::string layers_of(const core::Image& image) {
  std::string names;
  for (const core::Image::Layer& layer : image.layers)
    names += (names.empty() ? "" : ", ") + layer.name;
  return names;
}

// How two images are no pair; empty where they are one.
std::string mismatch(const core::Image& approved, const core::Image& rendered) {
  if (size_of(approved) != size_of(rendered))
    return "size " + size_of(rendered) + ", approved " + size_of(approved);
  std::set<std::string> before, now;
  for (const core::Image::Layer& layer : approved.layers) before.insert(layer.name);
  for (const core::Image::Layer& layer : rendered.layers) now.insert(layer.name);
  if (before != now) return "layers " + layers_of(rendered) + "; approved " + layers_of(approved);
  return "";
}

void compare_pair(const fs::path& approved, const fs::path& rendered, PictureResult& result) {
  try {
    const core::Image before = core::read_image(approved), now = core::read_image(rendered);
    result.note = mismatch(before, now);
    if (!result.note.empty()) {
      result.state = PictureState::changed;
      return;
    }
    for (const core::LayerDifference& difference :
         core::compare_images(before, now, "approved", "rendered")) {
      result.layers.push_back(judge(
          difference, session::difference_unit(approved, difference.layer), result.tolerance));
      if (!result.layers.back().within) result.state = PictureState::differs;
    }
  } catch (const core::InputError& error) {
    result.state = PictureState::unreadable;
    result.note = core::to_string(error.problems().front());
  }
}

std::string figure_text(const LayerJudgement& layer, const Figure& figure) {
  std::string text = fmt::format("{} {:.4g} {}", figure.name, figure.value, figure.unit);
  if (figure.allowed) text += fmt::format(" ({:.4g} allowed)", *figure.allowed);
  if (figure.name == "largest")
    text += fmt::format(" at column {}, row {}", layer.largest_column, layer.largest_row);
  return text;
}

std::string difference_text(const PictureResult& picture) {
  std::string text;
  for (const LayerJudgement& layer : picture.layers) {
    if (layer.within) continue;
    std::string figures;
    for (const Figure& figure : layer.figures)
      if (!figure.within || figure.name == "largest")
        figures += (figures.empty() ? "" : ", ") + figure_text(layer, figure);
    text += (text.empty() ? "" : "; ") +
            (picture.layers.size() > 1 ? layer.layer + " " + figures : figures);
  }
  return text;
}

}  // namespace

std::string_view name_of(PictureState state) {
  constexpr std::string_view kNames[] = {"same",    "differs",    "changed",
                                         "missing", "unapproved", "unreadable"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string_view name_of(CaseState state) {
  constexpr std::string_view kNames[] = {"passed", "differs", "unapproved", "failed"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string what_of(const PictureResult& picture) {
  switch (picture.state) {
    case PictureState::same:
      return "within its tolerance";
    case PictureState::differs:
      return difference_text(picture);
    case PictureState::missing:
      return "approved, but not rendered any more";
    case PictureState::unapproved:
      return "rendered, but not approved";
    default:
      return picture.note;
  }
}

std::string sentence_of(const PictureResult& picture) {
  return picture.file + ": " + what_of(picture);
}

std::string shown_layer(const PictureResult& picture) {
  const auto beyond = std::ranges::find(picture.layers, false, &LayerJudgement::within);
  return beyond == picture.layers.end() ? "" : beyond->layer;
}

std::vector<SettingChange> changes_of(const CaseResult& result) {
  if (!result.approval || result.state == CaseState::failed) return {};
  return changes(*result.approval, result.now);
}

std::vector<PictureResult> compare_pictures(const fs::path& approved, const fs::path& rendered,
                                            const std::map<std::string, Tolerance>& tolerances) {
  const std::set<std::string> before = pictures_below(approved), now = pictures_below(rendered);
  std::set<std::string> all = before;
  all.insert(now.begin(), now.end());
  std::vector<PictureResult> results;
  for (const std::string& file : all) {
    PictureResult result;
    result.file = file;
    const auto tolerance = tolerances.find(file.substr(0, file.find('/')));
    if (tolerance != tolerances.end()) result.tolerance = tolerance->second;
    if (!now.contains(file))
      result.state = PictureState::missing;
    else if (!before.contains(file))
      result.state = PictureState::unapproved;
    else
      compare_pair(approved / file, rendered / file, result);
    results.push_back(std::move(result));
  }
  return results;
}

CaseState state_of(const std::vector<PictureResult>& pictures) {
  CaseState state = CaseState::passed;
  for (const PictureResult& picture : pictures) {
    if (picture.state == PictureState::same) continue;
    if (picture.state != PictureState::unapproved) return CaseState::differs;
    state = CaseState::unapproved;
  }
  return state;
}

}  // namespace fanbeam::measure
