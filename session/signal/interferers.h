// Other radars of a scene, as the signal of one frame hears them, and what they cost it.
#pragma once

#include <string>
#include <vector>

#include "session/plots/gnuplot.h"
#include "session/signal/chain.h"
#include "signal/synthesis/interference.h"

namespace fanbeam::session {

// One for every [[interferer]] whose target is among these echoes, those that the frame sees: a target that is hidden or out of the
// field of view hides its radar too. Power by Friis with the sensor's one-way pattern and loss.
std::vector<signal::Interferer> interferers_of(const scenes::Scene& scene, int frame,
                                               const std::vector<core::Echo>& targets);

// The frame without interferers, with them, and with each mitigation.
struct InterferenceCase {
  std::string name;        // "clean", "none", "zero", "interpolate"
  double floor_W = 0.0;    // median cell of the range-Doppler map
  std::size_t mended = 0;  // samples
  std::size_t detections = 0;
  std::size_t recovered = 0;      // of those of the clean frame, within a cell of range and speed
  std::size_t false_ones = 0;     // near none of them
  std::vector<double> profile_W;  // mean over speeds, of every range cell
};
// `heard`: that frame as fmcw_frame made it with them, whose samples nothing has mended.
std::vector<InterferenceCase> interference_study(const FmcwRadar& radar, const FmcwPaths& paths,
                                                 FmcwFrame heard, int frame,
                                                 const FmcwSettings& options,
                                                 const SignalBudget& budget);

std::string interference_csv(const std::vector<InterferenceCase>& cases);
Plot interference_plot(const std::vector<InterferenceCase>& cases, double range_step_m,
                       const std::string& title);

}  // namespace fanbeam::session
