// Product "spectrum": the beat spectrum of one receiver, the first look at what it hears.
#pragma once

#include <string>
#include <vector>

#include "apps/fmcw/chain.h"
#include "apps/gnuplot.h"

namespace fanbeam::apps {

// Power against range before Doppler: the first channel's windowed range transform, calibrated so
// that a lone tone's cell holds its power.
struct BeatSpectrum {
  double range_step_m = 0.0;
  std::vector<double> one_chirp_W;  // of the frame's first
  std::vector<double> mean_W;       // over its chirps
  double noise_W = 0.0;             // mean of a cell without echoes
};

// Of a radar with maps.
BeatSpectrum beat_spectrum(const FmcwRadar& radar, const signal::FloatCube& beat);

std::string spectrum_csv(const BeatSpectrum& spectrum);
Plot spectrum_plot(const BeatSpectrum& spectrum, const std::string& title);

}  // namespace fanbeam::apps
