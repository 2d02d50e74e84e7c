// What a radar measures of a road scenario, from the samples of its receiver up: beat signals and
// noise, transforms, detector, refinement. Slower than measurement_simulator.h, and without its
// assumptions: merging, misses, false measurements and errors are what the processing makes of the
// samples.
//
// Waveform: two stages, as HighwayWaveforms has them; the default: a chirp sequence of 256 ramps of 20
// us, at 20 MHz, gives range, speed and azimuth by Chebyshev windows of -60 dB, an ordered-statistic
// detector along range (1e-7 per cell, calibrated for sums over the channels, above noise and the side
// lobes of the strongest echo of that range) and the one or two plane waves of a cell (directions.h). A
// triangle of 2 ms ramps, at 500 kHz, gives the beats (triangle_beats.h), each with the direction that
// its amplitudes over the channels have. A coarse detection takes the pair of beats that fits best
// within four standard deviations (0.3 m, 0.3 m/s; 6 mrad and noise between the directions of its beats
// and of its cell, as far as each is one plane wave), at its own speed or at one of its folds by the
// chirps' rate (2 vmax = 98.6 m/s); one without a pair is dropped. Its direction is that of its beats,
// where they are one wave each, else its cell's. Where a beat is one of two tones of a peak, both
// targets are told, each with the other ramp's beat from its direction, or where that is not split,
// with the one there is and an error that says so. Beats that no detection has taken make a second
// target within a cell.
// Array: a line of `radar.array_elements` receivers that share the gain, so that their coherent sum
// has the ratio of the link budget. Phases of targets are random in every frame, and their
// cross-sections as in measurement_simulator.h, by the same draws.
// Ranges belong to the turnaround of the triangle, which is the time of the frame.
// The standard deviations told are the Cramer-Rao bounds at the ratio measured, of tones that share a
// ramp where there are several (signal/detection/tone_bound.h), and for a windowed beat those of its
// window. Beats of one tone that stand in two directions are told apart (beat_waves.h). Told besides the noise:
// 2e-4 bins of a ramp where taking turns with a neighbour within 3.5 bins ends (0.06 mm, 0.1 mm/s); what 70 m/s across the
// line of sight bend the range over a triangle, 0.03 mm at 50 m; 0.5 mrad of a cell's direction; of a beat
// that holds two waves nearer than that 0.2 bins, of one that may be the other target's what the two are apart; of a
// direction that is of several, a beam evenly.
// Neglected: what measurement_simulator.h neglects but the above; a target's turn within a frame;
// the echo of one that comes through the radar within a frame.
// Every draw is a function of seed, run, frame and sample; the same bits for any number of threads.
// Cost: six targets some 60 ms of processor time, a fifth of it for the receiver noise of 1.2
// million samples; the detector's calibration some 0.3 s once, when the radar is made.
#pragma once

#include <cstdint>
#include <vector>

#include "core/highway.h"
#include "signal/cube.h"
#include "signal/detection/cfar.h"
#include "signal/transform/range_doppler.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"
#include "tracking/filters/observation.h"
#include "tracking/simulation/triangle_beats.h"

namespace fanbeam::tracking {

class SampledRadar {
 public:
  // Throws InputError: E-RANGE for what the waveform or the detector refuses, and for chirps of so few samples that the
  // cells around one tell no noise; E-LIMIT for an array longer than 1250 wavelengths.
  explicit SampledRadar(const core::HighwayRadar& radar);

  std::vector<RadarMeasurement> measure(const core::HighwayScenario& scenario, std::uint64_t seed,
                                        std::uint32_t run, int frame) const;
  // Where not, a target is not measured: it is beyond the cells of range or the speed up to which folds are sought, or a
  // beat of it beyond half the triangle's sample rate; or it is in another direction than it is measured in, which of
  // elements more than half a wavelength apart looks the same (signal/angle/angle_peak.h).
  bool shows(const core::HighwayTruth& truth) const;
  static double most_speed_mps();

 private:
  // A local maximum of the coarse map.
  struct Coarse {
    double range_m = 0.0, speed_mps = 0.0, azimuth_rad = 0.0, azimuth_sigma_rad = 0.0;
    double power_W = 0.0;
    std::size_t directions = 1;  // that the cell has
    bool lone_wave = false;      // one plane wave is all that it has
  };
  // A pair of beats that fits a coarse place.
  struct Pair {
    double misfit = 16.0;  // four standard deviations, squared
    std::size_t up = 0, down = 0;
    signal::RangeSpeed coarse, place;
    bool found = false;
  };
  struct Found {
    std::size_t up = 0, down = 0;
    signal::RangeSpeed place;
    double azimuth_rad = 0.0, azimuth_sigma_rad = 0.0, azimuth_systematic_rad = 0.0;
    double merged_bins = 0.0;  // how far a beat of it may be off that is another target's too
  };
  void add(const std::vector<Found>& more, std::vector<Found>& found) const;
  void tell_shared(const SampledBeats& beats, std::vector<Found>& found) const;
  static SampledBeats left_over(SampledBeats beats, const std::vector<Found>& found);
  // Of two that are one plane wave each: squared, over what it may be.
  template <class One, class Other>
  double disagreement(const One& one, const Other& other) const;
  bool agree(const Beat& one, const Beat& other) const;
  double misfit(const signal::TriangleModel& model, const SampledBeats& beats, std::size_t up,
                std::size_t down, const signal::RangeSpeed& place, const Coarse& cell) const;
  std::vector<Pair> fitting(const signal::TriangleModel& model, const SampledBeats& beats,
                            const std::vector<signal::RangeSpeed>& places,
                            const Coarse& cell) const;
  std::vector<Pair> best_pairs(const signal::TriangleModel& model, const SampledBeats& beats,
                               const std::vector<std::vector<signal::RangeSpeed>>& places,
                               const std::vector<Coarse>& cells) const;
  static bool has_beat(const std::vector<Pair>& pairs, bool of_up, std::size_t beat);
  static bool seen_before(const std::vector<Found>& found, const Found& one, double apart);
  std::vector<signal::RangeSpeed> folded(const Coarse& one) const;
  std::vector<Found> apart(const signal::TriangleModel& model, const SampledBeats& beats,
                           const std::vector<Pair>& bests, std::size_t one,
                           const Coarse& coarse) const;
  Found found_of(const SampledBeats& beats, std::size_t up, std::size_t down,
                 const signal::RangeSpeed& place, const Coarse& coarse) const;
  std::vector<Found> two_of_each(const signal::TriangleModel& model, const SampledBeats& beats,
                                 const Pair& best, const Coarse& coarse, std::size_t other_up,
                                 std::size_t other_down) const;
  RadarMeasurement measured(const SampledBeats& beats, const Found& one) const;
  double beam_sine() const;
  std::vector<Coarse> coarse_of(const signal::FloatCube& samples) const;

  core::HighwayRadar radar_;
  signal::Waveform waveform_;
  signal::Array array_;
  double slope_Hz_per_s_ = 0.0, repetition_s_ = 0.0;  // of the chirps
  signal::TriangleModel fine_;
  signal::RangeDopplerAxes axes_;
  signal::RangeDopplerSettings transform_;
  signal::CfarSettings cfar_;
};

}  // namespace fanbeam::tracking
