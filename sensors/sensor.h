// The radar as plain data: what a sensor file says, in SI. Derived figures are functions, never
// stored twice.
//
// Angles are in the antenna frame: azimuth positive right of the antenna's forward axis, elevation
// positive up.
// Ranges of valid values: sensor_file.h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/polarisation.h"

namespace fanbeam::sensors {

// One cut of an antenna pattern. Gains are one-way power relative to the peak; the two-way pattern
// is the square.
struct BeamCut {
  enum class Shape { gaussian, sinc_squared, table, cosecant_squared, cosine_aperture };
  Shape shape = Shape::gaussian;
  double half_power_width_rad = 0.0;  // one-way, full width between the -3 dB points
  double cut_rad = 0.0;               // the pattern is zero beyond this angle from the peak
  // Shape::table only: increasing angles from the peak, and linear one-way gain relative to the
  // peak there.
  std::vector<double> table_angle_rad;
  std::vector<double> table_gain;
  // Shape::cosecant_squared only: where the cosecant begins and ends, below the peak, and how far
  // the peak itself lies below the horizon.
  double cosecant_from_rad = 0.0;
  double cosecant_to_rad = 0.0;
  double peak_depression_rad = 0.0;
  // One-way gain relative to the peak from the cut on, up to this angle; 0: no side lobes there.
  double side_lobe_gain = 0.0;
  double side_lobe_extent_rad = 0.0;
};

struct Antenna {
  BeamCut azimuth;
  BeamCut elevation;
  double boresight_elevation_rad = 0.0;
  double peak_gain = 1.0;                  // linear, one-way
  double efficiency = 1.0;                 // peak gain over directivity; informative
  std::vector<std::string> pattern_files;  // that the cuts were read from
};

// How the beam moves over a picture's columns.
enum class ScanSurface {
  plane,  // azimuth is the angle in the antenna's horizontal plane
  cone,   // a frequency-scanned line array: azimuth counts from the plane across the array axis
};

// Azimuth as a function of frequency; see antenna/frequency_scan.h.
struct FrequencyScan {
  enum class Law { feed_line, table };
  Law law = Law::feed_line;
  double line_length_per_spacing = 0.0;  // L / d
  double cutoff_Hz = 0.0;
  double spacing_m = 0.0;
  int mode = 0;
  std::vector<double> table_frequency_Hz;  // both increasing
  std::vector<double> table_azimuth_rad;
};

struct Scan {
  // One frequency sweep for each column, or one over the whole field of view.
  enum class Sweep { per_column, whole_scan };
  ScanSurface surface = ScanSurface::plane;
  double field_of_view_rad = 0.0;  // centred on the forward axis
  int columns = 0;
  double frame_rate_Hz = 0.0;
  bool stabilised = true;  // roll and pitch of the aircraft are removed
  Sweep sweep = Sweep::per_column;
  std::optional<FrequencyScan> frequency_scan;  // none: steered mechanically

  double column_width_rad() const { return field_of_view_rad / columns; }
};

struct RangeGate {
  double minimum_m = 0.0;
  double cell_m = 0.0;  // row k spans [minimum + k cell, minimum + (k + 1) cell)
  int cells = 0;

  double maximum_m() const { return minimum_m + cell_m * cells; }
};

struct Waveform {
  // Amplitude weighting of the sweep before the range transform; none: an ideal range cell.
  enum class Window { none, rectangular, hann, hamming, taylor };
  double frequency_Hz = 0.0;
  double bandwidth_Hz = 0.0;  // of one sweep
  double transmit_power_W = 0.0;
  // Own-ship Doppler's shift of range is taken off. What leaves it in has no pictures of powers
  // (session::Setup::pictures), only signals.
  bool doppler_compensated = true;
  core::Place doppler_place{};                                       // of that key in its file
  core::Polarisation polarisation = core::Polarisation::horizontal;  // sent and received
  Window window = Window::none;
  double taylor_side_lobe = 3.1622776601683795e-4;  // highest lobe over the peak, power: -35 dB
  int taylor_equal_lobes = 4;                       // n-bar
};

struct Receiver {
  double noise_figure = 1.0;              // linear
  double loss = 1.0;                      // linear, at least 1; divides the received power
  double dwell_s = 0.0;                   // coherent time of one look
  int looks = 1;                          // per column, their powers averaged
  double false_alarm_probability = 1e-6;  // per cell, of threshold detection
};

// Angles at which the antenna sits on the aircraft, applied only when the scan is not stabilised
// (heading always).
struct Mounting {
  double forward_m = 0.0, right_m = 0.0, down_m = 0.0;  // antenna phase centre in body axes
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};

// How received power becomes grey; see display.h for the mappings.
struct Display {
  // With the words of files, in this order.
  enum class Mapping { stc, log, seed };
  static constexpr std::array<std::string_view, 3> kMappings = {"stc", "log", "seed"};
  Mapping mapping = Mapping::stc;
  double low_dB = -55.0;  // shown as grey 0
  double high_dB = 5.0;   // shown as grey 255
  enum class CScopeMode { true_elevation, flat_earth, shadow };
  static constexpr std::array<std::string_view, 3> kCScopeModes = {"true_elevation", "flat_earth",
                                                                   "shadow"};
  CScopeMode cscope_mode = CScopeMode::true_elevation;
  double cscope_top_rad = 0.0;  // upper edge of the C-scope window
  double cscope_span_rad = 0.0;
  int cscope_rows = 0;
};

// Constants that the published table of the HiVision radar fixes differently from physics, kept so
// that it can be reproduced to the letter; see seed_signal.h for the table and its formulas.
struct SeedConvention {
  bool active = false;
  double speed_of_light_mps = 0.0;
  double azimuth_patch_rad = 0.0;      // the beam's width: stands for the two-way integral
  double pulse_s = 0.0;                // the table's tau: a patch is c tau / 2 deep
  double elevation_minimum_rad = 0.0;  // the table divides the patch by its cosine
  double maximum_range_m = 0.0;        // of the minimum signal; the last range cell may end before
};

struct Sensor {
  std::string name;
  Antenna antenna;
  Scan scan;
  RangeGate range;
  Waveform waveform;
  Receiver receiver;
  Mounting mounting;
  Display display;
  SeedConvention seed;
  // Keys of the values that the sensor file marks as assumed: "antenna.elevation.cut_deg".
  std::vector<std::string> assumed;

  double wavelength_m() const;
  // Pt G0^2 lambda^2 / (4 pi)^3 / loss, in W m^2: received power is this times sigma g^2 L / R^4.
  double radar_constant_W_m2() const;
  // Of the mapping seed: integral of the two-way azimuth pattern; with the seed's convention, its
  // azimuth patch.
  double azimuth_patch_rad() const;
  // k T0 F / dwell: mean noise power per range cell, the bandwidth being that of a range FFT bin of
  // one look. Averaging looks leaves it.
  double noise_power_W() const;
};

}  // namespace fanbeam::sensors
