// What `fanbeam cost` measures, as plain data: the writers of CSV, tables and plots start here.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/turns.h"
#include "renderer/accuracy/grey_error.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::measure {

// Frame rates that every table and plot refers to: one sensor frame, and the best published rate of
// a GPU radar simulator.
inline constexpr double kTime16Hz_ms = 62.5;
inline constexpr double kTime90Hz_ms = 1000.0 / 90.0;

// Ways to sample a frame.
enum class Way { rays, slices, naive_dithered, naive_plain };
inline constexpr std::array<Way, 4> kWays = {Way::slices, Way::rays, Way::naive_dithered,
                                             Way::naive_plain};
std::string_view name_of(Way way);      // "naive_dithered", in CSV
std::string_view words_of(Way way);     // "uniform angles, dithered"
std::string_view fineness_of(Way way);  // "rays_per_cell_and_column"

struct LadderStep {
  int frame = 0;
  Way way = Way::rays;
  double fineness = 0.0;
  renderer::Sampling sampling;  // of the two casters
  core::MedianTime time;
  std::uint64_t rays = 0, slices = 0;
  renderer::FrameError error;
};

// The converged picture of a frame, and how well it is known.
struct ReferenceFigures {
  int frame = 0;
  double time_s = 0.0;
  std::uint64_t rays = 0;
  double rays_per_cell = 0.0;      // and column
  renderer::FrameError own_error;  // of a second one with another seed against it
};

// What an effect does to a displayed picture, in grey levels.
struct Change {
  double largest_grey = 0.0;
  double rms_grey = 0.0;
};

// One effect in one frame: the scene's plan with it against the plan without it.
struct EffectPrice {
  std::string effect, what, reason;  // `reason`: of the plan
  bool planned = false;              // left out to measure it; else forced on
  bool possible = true;              // otherwise there is nothing to measure
  double bound_grey = 0.0, bound_dB = 0.0;
  int frame = 0;
  core::MedianTime with, without;
  Change bscope, cscope;

  double cost_ms() const { return with.ms - without.ms; }
  double cost_error_ms() const;
};

// A setting of the arithmetic or of the sampling beside its alternative.
struct Variant {
  int frame = 0;
  std::string comparison;  // "robust flag"
  std::string name;        // "on"
  core::MedianTime time;
  renderer::FrameError error;
};

// Range from the ray-casting library's float against the range worked out in double from the
// triangle that was hit, over all rays of a frame.
struct RangeFigures {
  int frame = 0;
  std::uint64_t hits = 0;
  double median_m = 0.0, rms_m = 0.0, largest_m = 0.0;  // absolute differences
  std::uint64_t other_cell = 0;                         // hits that change their range cell
  core::MedianTime cast, cast_and_double;               // of the rays alone
};

// Hits of all rays of a frame with the robust flag against hits without it.
struct RobustFigures {
  int frame = 0;
  std::uint64_t rays = 0;
  std::uint64_t lost = 0;   // only with the flag is something hit
  std::uint64_t moved = 0;  // the hit differs by more than a hundredth of a range cell
};

struct NumericFigures {
  std::vector<Variant> variants;
  std::vector<RangeFigures> ranges;
  std::vector<RobustFigures> robust;
};

// One of two ways to the same B-scope: from powers, or from beat signals.
struct LevelStep {
  int frame = 0;
  std::string level;      // "picture" or "signal"
  double fineness = 0.0;  // rays per range cell and column, or looks
  core::MedianTime time;
  double rms_grey = 0.0;  // of the B-scope, with noise
};

struct Machine {
  std::string processor, level;
  int threads = 0;
};

struct CostFigures {
  std::string scene, title;
  Machine machine;
  std::string caster;         // of the effects' frames: "rays"
  std::string why_no_slices;  // empty where there are slices
  std::size_t triangles = 0;
  double dB_per_grey = 0.0;
  double accuracy_grey = 0.0;  // that the plan is made for
  bool quick = false;
  int repetitions = 0;
  std::vector<int> frames;
  std::vector<ReferenceFigures> references;
  std::vector<LadderStep> ladder;
  std::vector<EffectPrice> effects;
  NumericFigures numerics;
  std::vector<LevelStep> levels;
  std::string why_no_levels;  // where they were asked for and the sensor has no signal level
};

}  // namespace fanbeam::measure
