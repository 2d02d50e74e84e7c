// Reading sensor files (TOML): units in the keys, other values linear; unknown keys are errors.
//
//   name
//   assumed              keys whose values are assumptions: ["antenna.azimuth.cut_deg"]
//   [antenna]            peak_gain, above 0 to 1e9, or peak_gain_dB, +-90; at most the directivity;
//                        boresight_elevation_deg, +-90; efficiency, optional, checked within 1 %
//                        peak_gain_from_file = true instead takes GAIN of the cuts' .msi file
//   [antenna.azimuth]    shape "gaussian" | "sinc_squared" | "cosine_aperture" |
//   [antenna.elevation]    "cosecant_squared" | "table" | "file", see antenna/beam_pattern.h;
//                        half_power_width_deg, 0.01 to 180 (cosecant_squared: 90);
//                        cut_deg, half the width to 180 (sinc_squared, cosine_aperture: 90);
//                        cosecant_squared, elevation only, has no cut but cosecant_from_deg and
//                        cosecant_to_deg, depressions below the horizon, above 0 to 90, the first
//                        not above the boresight;
//                        a file has no width but file, an .msi, .pln or .csv inside the sensor
//                        file's folder (antenna/pattern_file.h), and cut_deg, 0.01 to 180;
//                        a table has no width and cut but table_angle_deg, increasing, +-180, and
//                        table_gain_dB, -400 to 0, the largest 0; 2 to 4096 values;
//                        side_lobe_level_dB, one-way over the peak, -200 to -3, none by default,
//                        from the cut to side_lobe_extent_deg, up to 180, default 90
//   [scan]               surface "plane" | "cone"; field_of_view_deg, above 0 to 360 (cone: 180);
//                        columns, 1 to 4096; frame_rate_Hz, 0.001 to 1000; stabilised;
//                        sweep "per-column" | "whole-scan"; steering "mechanical" | "frequency"
//   [scan.frequency_scan]  for steering "frequency", see antenna/frequency_scan.h:
//                        law "feed_line": line_length_per_spacing, 1 to 1000; cutoff_GHz, 0 to
//                        1000; spacing_mm, 0.1 to 100; mode, 0 to 1000;
//                        law "table": table_frequency_GHz, above 0 to 1000, and
//                        table_azimuth_deg, +-90, 2 to 4096 values, both increasing
//   [range]              minimum_m, 0 to 1e6; cell_m, 0.001 to 1e5; cells, 1 to 16384, or
//                        maximum_m for as many whole cells as fit; columns x cells at most 2^24
//   [waveform]           frequency_GHz, 0.1 to 300; bandwidth_MHz, above 0 to 1e5, with at
//                        least one bin of c / 2B in the range window;
//                        transmit_power_W, above 0 to 1e9; doppler_compensated, true;
//                        window "none" | "rectangular" | "hann" | "hamming" | "taylor", the last
//                        with taylor_side_lobe_dB, -80 to -15, default -35, and
//                        taylor_equal_lobes, 2 to 20, default 4; "none" for sweep "whole-scan";
//                        with a range response a cell holds at most 100 bins of c / 2B
//                        polarisation "HH" | "VV"
//   [receiver]           noise_figure_dB and loss_dB, 0 to 60; looks, 1 to 1000, which share a
//                        column's time; dwell_us of one look, above 0 to
//                        1 / (frame rate x columns x looks), which is the default;
//                        false_alarm_probability per cell, 1e-15 to 0.1, default 1e-6
//   [mounting]           forward_m, right_m, down_m, +-1000; yaw_deg and roll_deg, +-180;
//                        pitch_deg, +-90; all 0
//   [display]            mapping "stc" | "log" | "seed"; low_dB < high_dB, each +-400, default -55
//                        and 5, required for "log"; "seed" needs a minimum_m above 0
//   [display.cscope]     mode "true_elevation" | "flat_earth" | "shadow"; span_deg, above 0 to 180,
//                        and top_deg, +-90, by default the elevation beam's width about the
//                        boresight; rows, 1 to 16384, by default as many as cells; columns x rows
//                        at most 2^24
//   [seed]               only to follow a published table to the letter, see seed_signal.h:
//                        pulse_us, above 0 to 1e6; speed_of_light_mps, 2.9e8 to 3.1e8, default c;
//                        elevation_minimum_deg, 0 to 89, default 0
//
// A warning W-RESOLUTION says that the range cells are finer than the bandwidth resolves,
// W-STEERING what the one beam of a frequency-scanned picture neglects.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

// All problems go to `problems`, with line and column; the sensor is usable only when none of them
// is an error.
// Nothing that grows with a size in the file is allocated.
Sensor read_sensor(const std::filesystem::path& file, core::ProblemList& problems);

// The same from text; `file_name` is for the messages.
Sensor read_sensor_text(std::string_view text, const std::string& file_name,
                        core::ProblemList& problems);

}  // namespace fanbeam::sensors
