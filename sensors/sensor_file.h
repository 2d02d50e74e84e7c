// Reading sensor files (TOML): units in the keys, other values linear; unknown keys are errors.
//
//   name
//   assumed              keys whose values are assumptions: ["antenna.azimuth.cut_deg"]
//   [antenna]            peak_gain, above 0 to 1e9, or peak_gain_dB, +-90; at most the directivity;
//                        boresight_elevation_deg, +-90; efficiency, optional, checked within 1 %
//   [antenna.azimuth]    shape "gaussian" | "sinc_squared" | "table";
//   [antenna.elevation]  half_power_width_deg, 0.01 to 180;
//                        cut_deg, half the width to 180 (sinc_squared: 90);
//                        a table has no width and cut but table_angle_deg, increasing, +-180, and
//                        table_gain_dB, the largest 0
//   [scan]               surface "plane" | "cone"; field_of_view_deg, above 0 to 360 (cone: 180);
//                        columns, 1 to 4096; frame_rate_Hz, above 0 to 1000; stabilised
//   [range]              minimum_m, 0 to 1e6; cell_m, above 0 to 1e5; cells, 1 to 16384, or
//                        maximum_m for as many whole cells as fit; columns x cells at most 2^24
//   [waveform]           frequency_GHz, above 0 to 1000; bandwidth_MHz, above 0 to 1e5, with at
//                        least one bin of c / 2B in the range window;
//                        transmit_power_W, above 0 to 1e9; doppler_compensated
//   [receiver]           noise_figure_dB and loss_dB, 0 to 60; dwell_us, above 0 to
//                        1 / (frame rate x columns), which is the default
//   [mounting]           forward_m, right_m, down_m, +-1000; yaw_deg, pitch_deg, roll_deg; all 0
//   [display]            mapping "stc" | "log" | "seed"; low_dB < high_dB, each +-400
//   [display.cscope]     mode "true_elevation" | "flat_earth"; top_deg, span_deg, rows; by default
//                        the elevation beam's width about the boresight, as many rows as cells
//   [seed]               only to follow a published table to the letter, see seed_signal.h:
//                        speed_of_light_mps, pulse_us, elevation_minimum_deg
//
// A warning W-RESOLUTION says that the range cells are finer than the bandwidth resolves.
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
