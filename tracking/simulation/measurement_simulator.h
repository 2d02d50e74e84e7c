// What a radar measures of a road scenario, on the level of frequencies: targets become beats with
// noise, beats that are too close merge, and a pairing makes ranges and speeds of them again.
// Misses, ghosts of pairing and false measurements come out as they would of a radar, at no cost.
//
// For every target in view, with the signal-to-noise ratio e of one ramp of the fine triangle (link
// budget, two ways):
//   beats      of signal/pairing/triangle.h, normal errors sqrt(6/e) / (2 pi T); those of one ramp
//              closer than 1.2 bins become one at their mean, weighted with power; with two stages or a
//              coded stretch, which take beats by their direction, only those of one direction (below)
//   azimuth    normal error sqrt(6/(r N (N^2-1))) / (2 pi d/lambda cos azimuth), r = e / N
//   coarse     (two stages) range and speed with errors of 0.3 m and 0.3 m/s, refined by beats of the same direction; targets that share
//              the cells of range and speed (1.2 wide each) and the direction
//              become one, weighted with power; one that no pair of beats fits is dropped
//   coarse     (coded) speed from a flat stretch (2 ms), range from the phase between its two
//              tones (700 kHz apart), both with the errors of their bounds, c / (4 pi df) sqrt(2 / e)
//              in range; targets that share the cell of speed and the direction become one. Of such
//              ones, and of one that no pair fits, all pairs of beats within 1.2 cells of its speed
//   direction  two within x lambda / (N d) in the sine of the azimuth: 0.886, the array's beam, for a coded stretch; for two
//              stages what is told apart from samples (beat_waves.h), 1/6, or where the weaker has the ratio e the x at which
//              two waves in phase leave no more than noise of one, (pi x)^4 e / 720 = 27. Beyond, each has its own bound,
//              which near by is less than there is: 1.3 times in range and 2.4 to 9 in azimuth at half of lambda / (N d)
// Schemes: one triangle with all pairs, or with pairs in the order of range, two slopes, two
// stages, and a coded stretch between the ramps of one triangle, both refined as of
// signal/pairing/ghost_free.h. The azimuth of a pair is the mean of those of its two beats, and
// means nothing for an array of one element. A target below 15 dB, where the bounds end, is not seen. Ranges belong to the turnaround of the
// (first) triangle, which is the time of the frame. A target is seen with `detection_probability`;
// false measurements are Poisson, uniform in range, speed and azimuth.
// Fluctuation: cases 1 and 2 anew in every frame, chi-square of 2 degrees, 3 and 4 of 4.
// Systematic errors told: none for lone beats; for merged ones, which a radar knows by their width
// and an array by their directions, what follows from beats evenly up to 1.2 bins apart, and from directions
// evenly as far apart as one may be.
// Source: rates of misses and ghosts as in tests/signal/pairing_rates_test.cpp; bounds as in
// measurement_bound.h.
// Neglected: side lobes and masking (all targets in view are detected alike), side lobes of the
// array, the ambiguity of the code beyond 214 m, that near 15 dB a target is seen at times.
// Every draw is a function of seed, run, frame and target.
#pragma once

#include <cstdint>
#include <vector>

#include "core/highway.h"
#include "tracking/filters/observation.h"
#include "tracking/simulation/measurement_bound.h"

namespace fanbeam::tracking {

enum class Scheme { triangle, sorted_triangle, two_slopes, two_stage, coded };

// Of the (first) triangle.
double ramp_of(Scheme scheme, const core::HighwayWaveforms& waveforms);
// Of all ramps.
double length_of(Scheme scheme, const core::HighwayWaveforms& waveforms);

struct SimulationSettings {
  Scheme scheme = Scheme::two_stage;
  double detection_probability = 1.0;
  double false_per_frame = 0.0;
  double merge_bins = 1.2;
  double coarse_range_sigma_m = 0.3, coarse_speed_sigma_mps = 0.3;
  double most_speed_mps = 70.0;
};

// Order: as the pairing gives them, false ones last. Refuses (E-RANGE) probabilities outside
// [0, 1], negative rates, and what the link budget refuses.
std::vector<RadarMeasurement> simulated_frame(const core::HighwayScenario& scenario,
                                              const core::HighwayRadar& radar,
                                              const SimulationSettings& settings,
                                              std::uint64_t seed, std::uint32_t run, int frame);

}  // namespace fanbeam::tracking
