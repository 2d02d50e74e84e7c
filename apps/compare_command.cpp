// fanbeam compare: are two images, or two folders of images, the same within a tolerance?
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "core/image_compare.h"
#include "core/text.h"
#include "measure/image_files.h"
#include "session/figure/difference_map.h"
#include "session/version.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

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

CLI::App& declare_compare(CLI::App& program, CompareOptions& options) {
  CLI::App& command =
      *program.add_subcommand("compare", "Compare two images or two folders of images");
  add_file(command, "A", options.a, "Image (PNG, EXR) or folder of images")->required();
  add_file(command, "B", options.b, "Another of the same kind")->required();
  CLI::Option* rms =
      add_number(command, "--rms", options.rms, {0.0, 1000.0},
                 "Largest RMS difference allowed: grey levels for PNG, dB for power layers "
                 "(default: 0, but none beside another limit)");
  CLI::Option* largest =
      add_number(command, "--largest", options.largest, {0.0, 1000.0},
                 "Largest single difference allowed, same units (0 or default: any)");
  CLI::Option* percent =
      add_number(command, "--percent", options.percent_different, {0.0, 100.0},
                 "Largest share of differing cells allowed, per cent (default: any)");
  command.add_flag("--exact", options.exact, "Every value equal")
      ->excludes(rms)
      ->excludes(largest)
      ->excludes(percent);
  add_file(command, "--heat-map", options.heat_map,
           "Draw where they differ, B - A in grey levels or dB: a PNG file for two images; "
           "for two folders a folder of maps of the pairs that differ");
  return command;
}

// A layer's figures in the unit that it is judged in.
struct Figures {
  double rms = 0.0, largest = 0.0, percent = 0.0;
  std::size_t different = 0;
  std::size_t not_finite = 0;
  std::size_t only_one_lit = 0;  // of powers: no number of dB
};

// The limits that it breaks, empty for none.
std::string broken_limits(const Figures& figures, const CompareOptions& options) {
  std::string text;
  const auto broken = [&text](bool is, const std::string& what) {
    if (is) text += (text.empty() ? "" : ", ") + what;
  };
  const auto hold = [&](double value, double most, const char* what) {
    broken(!(value <= most), what + (" above " + core::number_text(most)));
  };
  if (options.exact) {
    broken(figures.different > 0, "not equal");
    return text;
  }
  const bool no_largest = !(options.largest.value_or(0.0) > 0.0);
  const bool share_alone = options.percent_different && no_largest && !options.rms;
  if (options.rms || (no_largest && !options.percent_different))
    hold(figures.rms, options.rms.value_or(0.0), "RMS");
  if (!no_largest) hold(figures.largest, *options.largest, "largest");
  if (options.percent_different) hold(figures.percent, *options.percent_different, "per cent");
  broken(figures.not_finite > 0, "cells whose difference is no finite number");
  broken(figures.only_one_lit > 0 && !share_alone, "cells lit in one only");
  return text;
}

// Below both folders, or that of the one image.
std::string name_of_pair(const fs::path& file, const CompareOptions& options) {
  const fs::path name = file.lexically_relative(options.a);
  return (name == "." ? file.filename() : name).string();
}

// Grey pictures are judged in grey levels, powers in dB where both are positive, ground truth in the
// unit of its layer.
bool judge(const fs::path& file, const core::LayerDifference& difference,
           const CompareOptions& options, bool quiet) {
  const session::DifferenceUnit unit = session::difference_unit(file, difference.layer);
  const bool in_dB = unit == session::DifferenceUnit::dB;
  const std::string name = name_of_pair(file, options);
  const double rms = in_dB ? difference.rms_dB : difference.rms;
  const double mean = in_dB ? difference.mean_dB : difference.mean;
  const double largest = in_dB ? difference.largest_dB : difference.largest;
  const double percent = 100.0 * static_cast<double>(difference.different) /
                         static_cast<double>(std::max<std::size_t>(difference.cells, 1));
  const std::string broken =
      broken_limits({rms, largest, percent, difference.different, difference.not_finite,
                     in_dB ? difference.only_one_positive : std::size_t{0}},
                    options);
  const bool ok = broken.empty();
  if (!quiet || !ok)
    fmt::print(
        "{} {} {}: mean {:+.4f}, RMS {:.4f}, largest {:.3f} {}, {:.3f} % of {} cells differ{}{}\n",
        ok ? "same  " : "DIFFER", core::printable_text(name),
        core::printable_text(difference.layer), mean, rms, largest,
        session::unit_text(unit, difference.layer), percent, difference.cells,
        in_dB && difference.only_one_positive > 0
            ? fmt::format(", {} lit in one only", difference.only_one_positive)
            : "",
        ok ? "" : ": " + broken);
  return ok;
}

// What is wrong with either is told.
void check_sizes(const fs::path& a, const fs::path& b) {
  std::vector<core::ImageSize> sizes;
  core::ProblemList problems;
  for (const fs::path& file : {a, b}) {
    try {
      sizes.push_back(core::image_size(file));
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  problems.throw_if_errors();
  core::check_same_size(sizes[0], sizes[1], a.string(), b.string());
}

// `map`: where the heat map goes, empty for nowhere; drawn for a pair that is equal only where
// `always` or where there is one.
bool compare_files(const fs::path& a, const fs::path& b, const fs::path& map, bool always,
                   const CompareOptions& options, bool quiet) {
  check_sizes(a, b);
  const core::Image image_a = core::read_image(a), image_b = core::read_image(b);
  bool same = true;
  bool equal = true;
  for (const core::LayerDifference& difference :
       core::compare_images(image_a, image_b, a.string(), b.string())) {
    same = judge(a, difference, options, quiet) && same;
    equal = equal && difference.different == 0;
  }
  std::error_code status;
  if (map.empty() || (equal && !always && !fs::exists(map, status))) return same;
  core::write_png(
      map, session::difference_map(image_a, image_b, a, {b.filename().string() + ": B against A"}),
      {{"Software", "fanbeam " + session::version_text() + " " + session::commit_text()}});
  if (!quiet) fmt::print("map    {}\n", map.string());
  return same;
}

// "bscope/00000.png" of a picture, "power/00000.exr.png" of an EXR.
fs::path heat_map_path(const fs::path& folder, const fs::path& image) {
  fs::path name = image;
  if (name.extension() != ".png") name += ".png";
  return folder / name;
}

// Where the map of two images goes.
fs::path single_map(const CompareOptions& options) {
  const fs::path map = options.heat_map;
  std::error_code status;
  if (map.empty()) return map;
  if (fs::is_directory(map, status)) return heat_map_path(map, fs::path(options.b).filename());
  if (map.extension() != ".png")
    core::throw_input_error(core::ErrorClass::range, "--heat-map", "\"" + options.heat_map + "\"",
                            "a folder, or a file that ends in .png");
  return map;
}

// What fails of a pair is told when all others are compared.
bool compare_folders(const fs::path& a, const fs::path& b, const CompareOptions& options,
                     bool quiet) {
  const std::set<fs::path> in_a = measure::image_files_below(a);
  const std::set<fs::path> in_b = measure::image_files_below(b);
  bool same = true;
  std::size_t pairs = 0;
  core::ProblemList failed;
  for (const fs::path& name : in_a) {
    if (in_b.contains(name)) {
      ++pairs;
      const fs::path map = options.heat_map.empty() ? "" : heat_map_path(options.heat_map, name);
      try {
        same = compare_files(a / name, b / name, map, false, options, quiet) && same;
      } catch (const core::InputError& error) {
        same = false;
        failed.append(error.problems());
      }
    } else {
      same = false;
      fmt::print("DIFFER {}: only in {}\n", core::printable_text(name.string()), a.string());
    }
  }
  for (const fs::path& name : in_b) {
    if (in_a.contains(name)) continue;
    same = false;
    fmt::print("DIFFER {}: only in {}\n", core::printable_text(name.string()), b.string());
  }
  if (pairs == 0)
    core::throw_input_error(core::ErrorClass::io, core::Place{a.string()}, "images",
                            in_a.empty() || in_b.empty()
                                ? "none in " + (in_a.empty() ? a : b).string()
                                : "no name in both",
                            "PNG or EXR images, of the same names below both folders");
  if (!quiet || !same)
    fmt::print("{} pairs of images {}\n", pairs,
               same                  ? "agree"
               : failed.has_errors() ? "found, some could not be compared"
                                     : "compared, some differ");
  failed.throw_if_errors();
  return same;
}

// 0 when every pair is within the tolerance, 1 otherwise. The map of two images is always drawn; a
// map that an earlier comparison of folders left for a pair that is equal now is drawn anew. Throws
// InputError, beside what reading and writing throw (of folders after all other pairs are compared, with all of
// them): E-REF for a file and a folder, E-RANGE for a map that is no PNG, E-PATH for maps on or among the images
// compared.
int compare(const CompareOptions& options, const CommonOptions& common) {
  const fs::path a = options.a;
  const fs::path b = options.b;
  core::ProblemList missing;
  for (const fs::path& path : {a, b})
    if (std::error_code status; !fs::exists(path, status))
      missing.error(core::ErrorClass::io, core::Place{path.string()}, "",
                    status ? status.message() : "missing", "an image or a folder");
  missing.throw_if_errors();
  if (fs::is_directory(a) != fs::is_directory(b))
    core::throw_input_error(core::ErrorClass::ref, core::Place{b.string()}, "kind",
                            fs::is_directory(b) ? "a folder" : "a file",
                            "two images or two folders");
  const bool folders = fs::is_directory(a);
  const fs::path map = folders ? fs::path(options.heat_map) : single_map(options);
  refuse_output_among({a, b}, map, "--heat-map");
  const bool same = folders ? compare_folders(a, b, options, common.quiet)
                            : compare_files(a, b, map, true, options, common.quiet);
  return same ? kExitDone : kExitCompareFailed;
}

}  // namespace

void add_compare(CommandLine& line) { line.add(declare_compare, compare); }

}  // namespace fanbeam::apps
