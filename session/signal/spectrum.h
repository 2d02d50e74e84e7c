// Product "spectrum": the beat spectrum of one receiver, the first look at what it hears.
#pragma once

#include <string>
#include <vector>

#include "session/plots/gnuplot.h"
#include "session/signal/chain.h"

namespace fanbeam::session {

// A positive power in W as dB above 1 mW, for pictures.
double dBm(double power_W);

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

}  // namespace fanbeam::session
