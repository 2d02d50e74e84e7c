// The study's bounds are those of the ramps that it measures with.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/decibel.h"
#include "session/signal/tracks/study.h"
#include "tracking/simulation/measurement_bound.h"

using namespace fanbeam;

TEST_CASE("Errors over the noise figure meet the bound of a file's own ramps", "[track]") {
  core::HighwayRadar radar;
  radar.transmit_gain = core::power_from_dB(32.0);
  radar.receive_gain = core::power_from_dB(27.0);
  radar.waveforms.triangle_ramp_s = 1e-3;
  const session::StudyPart part = session::study_noise_figure(radar, 1);
  const auto& series = part.plots.at(0).second.series;
  const double errors_mm = series.at(0).y.at(2), bound_mm = series.at(1).y.at(2);  // 4.5 dB
  radar.noise_figure = core::power_from_dB(4.5);
  radar.ramp_s = 1e-3;
  CHECK(bound_mm == Approx(1e3 * tracking::measurement_bound(radar, 10.0, 100.0, 0.0).range_sigma_m)
                        .epsilon(1e-9));
  // Of 100 draws, four standard deviations; that of 2 ms is 1.4 times smaller.
  CHECK(errors_mm == Approx(bound_mm).epsilon(0.28));
}
