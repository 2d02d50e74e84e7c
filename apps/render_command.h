// fanbeam render: a scene's approach as pictures.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "apps/common.h"
#include "apps/scene_choice.h"

namespace fanbeam::apps {

struct Product {
  std::string_view name, what;
  std::string_view files;  // below the output folder, of frame 0
};
inline constexpr std::array<Product, 13> kProducts = {
    {{"bscope", "range over azimuth, PNG", "bscope/00000.png"},
     {"cscope", "elevation over azimuth, PNG", "cscope/00000.png"},
     {"pair", "both side by side", "pair/00000.png"},
     {"figure", "both with scales and legend", "figure/00000.png"},
     {"ppi", "plan view, track up", "ppi/00000.png"},
     {"ppi_north", "plan view, north up", "ppi_north/00000.png"},
     {"ppi_figure", "ppi with scales and legend", "ppi_figure/00000.png"},
     {"power", "EXR, watts, noise included", "power/00000.exr"},
     {"layers", "EXR, ground truth by B-scope cell", "layers/00000.exr"},
     {"cscope_layers", "EXR, the same by C-scope cell", "cscope_layers/00000.exr"},
     {"detections", "mask and CSV", "detections/00000.png and .csv"},
     {"obstacles", "CSV, heights from shadows", "obstacles/00000.csv"},
     {"preview", "video", "preview.mp4, .gif or .apng"}}};

struct RenderOptions : SceneChoice {
  std::string output;  // default out/<scene name>
  std::string frames;  // "A:B[:STEP]", like a Python slice
  std::string products = "bscope,cscope";
  std::string effects;
  std::string realisation;  // "mean" or "sample"; empty: the scene's
  std::string preview_format = "mp4";
  std::string range_unit;  // of the figure: one of kRangeUnits; empty: by how far the sensor sees
  int threads = 0;
  std::string caster;          // one of kCasterWishes; empty: the scene's
  double rays_per_cell = 0.0;  // or slices per column; 0: the scene's, else the default
  bool reference = false;
  double accuracy_grey = 0.0;   // 0: the scene's, else not asked for
  double time_budget_ms = 0.0;  // 0: the scene's, else no limit
  bool repeatable = false;      // no time budget of the scene's, which depends on the machine
  bool estimate_error = false;
  bool plan_per_frame = false;
  bool resume = false;
  bool overwrite = false;  // where other files are
  std::uint64_t seed = 0;
};

// Returns an exit code; throws InputError for bad input. SIGINT and SIGTERM while frames are made
// end the process by that signal (a shell sees 130 or 143), within a second, with whole files only
// and without run.json.
int render(const RenderOptions& options, const CommonOptions& common);
CLI::App& add_render_command(CLI::App& program, RenderOptions& options, CommonOptions& common);

}  // namespace fanbeam::apps
