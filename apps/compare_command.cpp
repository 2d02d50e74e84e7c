#include "apps/compare_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "core/image_compare.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::path& path) {
  return path.extension() == ".png" || path.extension() == ".exr";
}

std::set<fs::path> images_below(const fs::path& folder) {
  std::set<fs::path> images;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_image(entry.path()))
      images.insert(entry.path().lexically_relative(folder));
  return images;
}

// Grey pictures are judged in grey levels, float layers in dB where both are positive.
bool judge(const std::string& name, const core::LayerDifference& difference, bool grey,
           const CompareOptions& options, bool quiet) {
  const double rms = grey ? difference.rms : difference.rms_dB;
  const double mean = grey ? difference.mean : difference.mean_dB;
  const double largest = grey ? difference.largest : difference.largest_dB;
  const double percent = 100.0 * static_cast<double>(difference.different) /
                         static_cast<double>(std::max<std::size_t>(difference.cells, 1));
  const bool ok = options.exact ? difference.different == 0
                                : rms <= options.rms &&
                                      (options.largest <= 0.0 || largest <= options.largest) &&
                                      percent <= options.percent_different &&
                                      (grey || difference.only_one_positive == 0);
  if (!quiet || !ok)
    fmt::print(
        "{} {} {}: mean {:+.4f}, RMS {:.4f}, largest {:.3f} {}, {:.3f} % of {} cells differ{}\n",
        ok ? "same  " : "DIFFER", name, difference.layer, mean, rms, largest, grey ? "grey" : "dB",
        percent, difference.cells,
        difference.only_one_positive > 0
            ? fmt::format(", {} lit in one only", difference.only_one_positive)
            : "");
  return ok;
}

bool compare_files(const fs::path& a, const fs::path& b, const CompareOptions& options,
                   bool quiet) {
  bool same = true;
  for (const core::LayerDifference& difference :
       core::compare_images(core::read_image(a), core::read_image(b), a.string(), b.string()))
    same =
        judge(a.filename().string(), difference, a.extension() == ".png", options, quiet) && same;
  return same;
}

}  // namespace

int compare(const CompareOptions& options, const CommonOptions& common) {
  const fs::path a = options.a;
  const fs::path b = options.b;
  for (const fs::path& path : {a, b})
    if (!fs::exists(path))
      core::throw_input_error(core::ErrorClass::io, core::Place{path.string()}, "", "missing",
                              "an image or a folder");
  if (fs::is_directory(a) != fs::is_directory(b))
    core::throw_input_error(core::ErrorClass::ref, core::Place{b.string()}, "kind",
                            fs::is_directory(b) ? "a folder" : "a file",
                            "two images or two folders");
  if (!fs::is_directory(a))
    return compare_files(a, b, options, common.quiet) ? kExitDone : kExitCompareFailed;
  const std::set<fs::path> in_a = images_below(a);
  const std::set<fs::path> in_b = images_below(b);
  bool same = true;
  std::size_t pairs = 0;
  for (const fs::path& name : in_a) {
    if (in_b.contains(name)) {
      ++pairs;
      same = compare_files(a / name, b / name, options, common.quiet) && same;
    } else {
      same = false;
      fmt::print("DIFFER {}: only in {}\n", name.string(), a.string());
    }
  }
  for (const fs::path& name : in_b) {
    if (in_a.contains(name)) continue;
    same = false;
    fmt::print("DIFFER {}: only in {}\n", name.string(), b.string());
  }
  if (pairs == 0)
    core::throw_input_error(core::ErrorClass::io, core::Place{a.string()}, "images",
                            "none in both folders", "PNG or EXR images");
  if (!common.quiet || !same)
    fmt::print("{} pairs of images {}\n", pairs, same ? "agree" : "compared, some differ");
  return same ? kExitDone : kExitCompareFailed;
}

}  // namespace fanbeam::apps
