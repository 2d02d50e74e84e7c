#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/colour_picture.h"
#include "core/files.h"
#include "measure/regress/report.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;

constexpr double kShownDecades = 6.0;  // below the brightest cell of both

const core::Image::Layer& layer_of(const core::Image& image, const std::string& name) {
  const auto found = std::find_if(image.layers.begin(), image.layers.end(),
                                  [&](const core::Image::Layer& l) { return l.name == name; });
  return found == image.layers.end() ? image.layers.front() : *found;
}

// Values in grey, as EXR is nothing that a browser shows: power 60 dB deep below the brightest cell,
// all else, as angles and numbers of objects, from the least to the largest.
class ShownScale {
 public:
  explicit ShownScale(session::DifferenceUnit unit)
      : linear_(unit == session::DifferenceUnit::own) {}

  void hold(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    }
  }

  core::Picture8 picture(const core::Image& image, const std::vector<double>& values) const {
    core::Picture8 picture{image.columns, image.rows, {}};
    for (const double value : values)
      picture.pixels.push_back(
          static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share(value), 0.0, 1.0))));
    return picture;
  }

 private:
  double share(double value) const {
    if (!std::isfinite(value)) return value > 0.0 ? 1.0 : 0.0;
    if (linear_) return value > low_ ? (value - low_) / (high_ - low_) : 0.0;
    return value > 0.0 ? 1.0 + std::log10(value / high_) / kShownDecades : 0.0;
  }

  bool linear_;
  double low_ = std::numeric_limits<double>::max(), high_ = std::numeric_limits<double>::lowest();
};

// Layers that are beyond their tolerance; all of them would be a map too wide to look at.
core::Image only_differing(core::Image image, const PictureResult& picture) {
  std::erase_if(image.layers, [&](const core::Image::Layer& layer) {
    return std::any_of(
        picture.layers.begin(), picture.layers.end(),
        [&](const LayerJudgement& judged) { return judged.layer == layer.name && judged.within; });
  });
  return image;
}

class PageWriter {
 public:
  PageWriter(const Suite& suite, fs::path output, const CaseResult& result)
      : output_(std::move(output)),
        result_(result),
        approved_(suite.approved / result.folder),
        rendered_(rendered_folder(output_, result.folder)) {}

  void write(const PictureResult& picture) const {
    const bool before = picture.state != PictureState::unapproved;
    const bool now = picture.state != PictureState::missing;
    if (picture.state == PictureState::same || picture.state == PictureState::unreadable) return;
    if (picture.file.ends_with(".exr")) {
      write_shown(picture, before, now);
    } else {
      if (before) copy(approved_, picture, PageSide::approved);
      if (now) copy(rendered_, picture, PageSide::rendered);
    }
    if (picture.state == PictureState::differs) write_difference(picture);
  }

 private:
  fs::path place(const PictureResult& picture, PageSide side) const {
    return output_ / page_picture(result_.folder, picture.file, side);
  }

  void copy(const fs::path& from, const PictureResult& picture, PageSide side) const {
    core::write_file_atomically(place(picture, side),
                                core::read_file(from / picture.file, kMostPicture_bytes));
  }

  void write_shown(const PictureResult& picture, bool before, bool now) const {
    std::vector<std::pair<PageSide, core::Image>> images;
    if (before) images.emplace_back(PageSide::approved, core::read_image(approved_ / picture.file));
    if (now) images.emplace_back(PageSide::rendered, core::read_image(rendered_ / picture.file));
    const std::string name = layer_of(images.front().second, shown_layer(picture)).name;
    ShownScale scale(session::difference_unit(picture.file, name));
    for (const auto& [side, image] : images) scale.hold(layer_of(image, name).values);
    for (const auto& [side, image] : images)
      core::write_png(place(picture, side), scale.picture(image, layer_of(image, name).values), {});
  }

  void write_difference(const PictureResult& picture) const {
    const session::DifferenceLabels labels{picture.file + ": new against approved", "approved",
                                           "new"};
    core::write_png(
        place(picture, PageSide::difference),
        session::difference_map(only_differing(core::read_image(approved_ / picture.file), picture),
                                only_differing(core::read_image(rendered_ / picture.file), picture),
                                picture.file, labels),
        {});
  }

  fs::path output_;
  const CaseResult& result_;
  fs::path approved_, rendered_;
};

}  // namespace

std::string page_picture(const std::string& case_folder, const std::string& file, PageSide side) {
  constexpr std::string_view kEndings[] = {".approved.png", ".new.png", ".difference.png"};
  return "pictures/" + case_folder + "/" + file +
         std::string(kEndings[static_cast<std::size_t>(side)]);
}

void write_page_pictures(const Suite& suite, const std::vector<CaseResult>& results,
                         const fs::path& output) {
  for (const CaseResult& result : results)
    for (const PictureResult& picture : result.pictures)
      PageWriter(suite, output, result).write(picture);
}

}  // namespace fanbeam::measure
