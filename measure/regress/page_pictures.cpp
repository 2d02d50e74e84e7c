#include <algorithm>
#include <cmath>

#include "core/colour_picture.h"
#include "core/files.h"
#include "measure/regress/report.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;

constexpr double kShownDecades = 6.0;  // below the brightest cell of both

// The first layer in grey, 60 dB deep: EXR is nothing that a browser shows.
core::Picture8 grey_of(const core::Image& image, double brightest) {
  core::Picture8 picture{image.columns, image.rows, {}};
  for (const double value : image.layers.front().values) {
    const double decades = value > 0.0 ? std::log10(value / brightest) : -kShownDecades;
    picture.pixels.push_back(static_cast<std::uint8_t>(
        std::lround(255.0 * std::clamp(1.0 + decades / kShownDecades, 0.0, 1.0))));
  }
  return picture;
}

double brightest_of(const core::Image& image) {
  double brightest = 0.0;
  for (const double value : image.layers.front().values)
    if (std::isfinite(value)) brightest = std::max(brightest, value);
  return brightest;
}

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
    core::Image old_image, new_image;
    if (before) old_image = core::read_image(approved_ / picture.file);
    if (now) new_image = core::read_image(rendered_ / picture.file);
    const double brightest =
        std::max(before ? brightest_of(old_image) : 0.0, now ? brightest_of(new_image) : 0.0);
    const double scale = brightest > 0.0 ? brightest : 1.0;
    if (before) core::write_png(place(picture, PageSide::approved), grey_of(old_image, scale), {});
    if (now) core::write_png(place(picture, PageSide::rendered), grey_of(new_image, scale), {});
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
