// What one simulated frame consists of: draws, targets seen, peaks of ramps.
#pragma once

#include <array>

#include "core/random.h"
#include "core/swerling.h"
#include "signal/pairing/triangle.h"
#include "tracking/simulation/measurement_simulator.h"

namespace fanbeam::tracking {

// All draws of one frame.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint32_t run, int frame)
      : key_{seed, core::kStreamHighway, static_cast<std::uint32_t>(frame)}, run_(run) {}
  std::array<double, 2> normal(std::size_t cell, std::uint32_t draw) const {
    return core::normal_pair(key_, at(cell), draw);
  }
  double uniform(std::size_t cell, std::uint32_t draw, std::size_t word = 0) const {
    return core::uniform_from(core::random_words(key_, at(cell), draw)[word]);
  }
  // Of a target's cross-section in this frame, over its mean.
  double fluctuation(core::Swerling model, std::size_t target) const;

 private:
  std::uint64_t at(std::size_t cell) const { return (std::uint64_t{run_} << 32U) + cell; }
  core::RandomKey key_;
  std::uint32_t run_;
};

struct Seen {
  double range_m = 0.0, rate_mps = 0.0, azimuth_rad = 0.0, power = 0.0;  // azimuth with its noise
  MeasurementBound bound;
  bool merged = false;  // of several targets
};

// Beats of one ramp that the radar sees, with the direction they come from and, 0 for a lone one,
// how far merged ones may be from either.
struct Peaks {
  std::vector<double> Hz, azimuth_rad, power, spread_Hz, spread_rad;
};
struct RampPeaks {
  Peaks up, down;
};

// The peaks of a pair.
struct PairOfPeaks {
  std::size_t up = 0, down = 0;
};
PairOfPeaks peaks_at(const signal::TriangleModel& model, const RampPeaks& peaks,
                     const signal::RangeSpeed& place);

// Puts what merging leaves uncertain of range and speed into the measurement.
void state_spread(const signal::TriangleModel& model, const RampPeaks& peaks,
                  const PairOfPeaks& pair, RadarMeasurement& measurement);

RadarMeasurement with_sigmas(const signal::RangeSpeed& place, double azimuth_rad,
                             const MeasurementBound& bound);

// A pair at the place that it gives; direction and strength are those of the beats that it explains.
RadarMeasurement measured_pair(const signal::TriangleModel& model, const RampPeaks& peaks,
                               const signal::RangeSpeed& place, const core::HighwayRadar& radar);

// Sines of azimuth nearer than this are one direction to the array where the weaker target has this ratio; all of them
// to one receiver. A coded stretch, whose beats nobody has sought from samples, is taken to tell the array's beam.
double one_direction(const core::HighwayRadar& radar, Scheme scheme, double signal_to_noise);

// Coarse ranges and speeds from a chirp sequence, or from the coded flat stretch of a triangle,
// refined by the triangle's beats.
std::vector<RadarMeasurement> coarse_to_fine(
    const signal::TriangleModel& fine, const RampPeaks& peaks, const std::vector<Seen>& targets,
    const core::HighwayRadar& radar, const SimulationSettings& settings, const Draws& draws);

}  // namespace fanbeam::tracking
