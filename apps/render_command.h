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
};
inline constexpr std::array<Product, 9> kProducts = {{{"bscope", "range over azimuth, PNG"},
                                                      {"cscope", "elevation over azimuth, PNG"},
                                                      {"pair", "both side by side"},
                                                      {"ppi", "plan view, track up"},
                                                      {"ppi_north", "plan view, north up"},
                                                      {"power", "EXR, watts, with ground truth"},
                                                      {"detections", "mask and CSV"},
                                                      {"obstacles", "CSV, heights from shadows"},
                                                      {"preview", "video"}}};

struct RenderOptions : SceneChoice {
  std::string output;  // default out/<scene name>
  std::string frames;  // "A:B[:STEP]", like a Python slice
  std::string products = "bscope,cscope";
  std::string effects;
  std::string realisation;  // "mean" or "sample"; empty: the scene's
  std::string preview_format = "mp4";
  int threads = 0;
  std::string caster;          // one of kCasterWishes; empty: the scene's
  double rays_per_cell = 0.0;  // or slices per column; 0: the scene's, else the default
  bool reference = false;
  double accuracy_grey = 0.0;   // 0: not asked for
  double time_budget_ms = 0.0;  // 0: no limit
  bool estimate_error = false;
  bool plan_per_frame = false;
  bool resume = false;
  std::uint64_t seed = 0;
};

// Returns an exit code; throws InputError for bad input. SIGINT and SIGTERM while frames are made
// end the process by that signal (a shell sees 130 or 143), within a second, with whole files only
// and without run.json.
int render(const RenderOptions& options, const CommonOptions& common);

}  // namespace fanbeam::apps
