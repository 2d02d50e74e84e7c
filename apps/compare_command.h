// fanbeam compare: are two images, or two folders of images, the same within a tolerance?
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

struct CompareOptions {
  std::string a, b;
  // Limits; one that is not given does not bind where another is. Without any an RMS of 0.
  std::optional<double> rms;      // of all differences: grey levels, or dB for power layers
  std::optional<double> largest;  // of a single one, same units; 0: none
  std::optional<double> percent_different;
  bool exact = false;
  // A PNG file for two images; for two folders the folder of one map per pair that is not
  // equal, within the tolerance or not, as heat_map_path names it. Empty: none.
  std::string heat_map;
};

// "bscope/00000.png" of a picture, "power/00000.exr.png" of an EXR.
std::filesystem::path heat_map_path(const std::filesystem::path& folder,
                                    const std::filesystem::path& image);

// 0 when every pair is within the tolerance, 1 otherwise. The map of two images is always drawn; a
// map that an earlier comparison of folders left for a pair that is equal now is drawn anew. Throws
// InputError, beside what reading and writing throw (of folders after all other pairs are compared, with all of
// them): E-REF for a file and a folder, E-RANGE for a map that is no PNG, E-PATH for maps on or among the images
// compared.
int compare(const CompareOptions& options, const CommonOptions& common);
CLI::App& add_compare_command(CLI::App& program, CompareOptions& options);

}  // namespace fanbeam::apps
