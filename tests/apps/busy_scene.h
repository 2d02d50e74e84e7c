// A small scene in which nearly every effect and every kind of thing is at work, for tests of the
// whole program's bytes.
#pragma once

#include <filesystem>
#include <string>

#include "tests/apps/program.h"

namespace fanbeam::tests {

// Everything but the preview, whose bytes are ffmpeg's.
inline const std::string kAllPictures =
    " --products bscope,cscope,pair,figure,ppi,ppi_north,ppi_figure,power,detections,obstacles ";

// 20 columns of 0.4 deg and 20 or more range cells of 30 m; side lobes, a Taylor window.
inline std::string small_sensor(int cells) {
  return R"(name = "small"
[antenna]
peak_gain = 2000.0
boresight_elevation_deg = -3.8
[antenna.azimuth]
shape = "gaussian"
half_power_width_deg = 0.8
cut_deg = 1.25
side_lobe_level_dB = -20.0
side_lobe_extent_deg = 40.0
[antenna.elevation]
shape = "gaussian"
half_power_width_deg = 10.0
cut_deg = 15.625
[scan]
surface = "plane"
field_of_view_deg = 8.0
columns = 20
frame_rate_Hz = 16.0
stabilised = false
[range]
minimum_m = 200.0
cell_m = 30.0
cells = )" +
         std::to_string(cells) +
         R"(
[waveform]
frequency_GHz = 35.0
bandwidth_MHz = 5.0
transmit_power_W = 1.0
window = "taylor"
doppler_compensated = true
polarisation = "HH"
[receiver]
noise_figure_dB = 6.0
loss_dB = 0.0
looks = 4
false_alarm_probability = 1e-3
[display]
mapping = "stc"
low_dB = -55.0
high_dB = 5.0
[display.cscope]
mode = "shadow"
top_deg = 1.2
span_deg = 10.0
rows = 40
)";
}

inline std::string busy_scene() {
  return R"([scene]
name = "busy"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 50.0 }
vertical_datum = "egm96"
[terrain]
generator = "rolling"
half_extent_m = 4500.0
spacing_m = 50.0
relief_m = 10.0
wood_share = 0.2
seed = 3
fields = ["crops", "tall_grass", "bare_soil"]
[[runway]]
first = { name = "36", latitude_deg = 52.0, longitude_deg = 10.0, elevation_m = 50.0 }
second = { name = "18", latitude_deg = 52.012, longitude_deg = 10.0, elevation_m = 52.0 }
approach_lights = "36"
light_rcs_dBsm = -10.0
fence = { beyond_m = 60.0, height_m = 2.4, spacing_m = 5.0, post_rcs_dBsm = 0.0 }
[[surface]]
runway = "36"
material = "water_calm"
behind_threshold_m = [300.0, 700.0]
left_m = [40.0, 140.0]
[[box]]
name = "hangar"
at = { runway = "36", behind_threshold_m = 500.0, left_m = 60.0 }
length_m = 60.0
width_m = 20.0
height_m = 14.0
wall = "metal"
roof = "metal"
[[target]]
name = "corner"
at = { runway = "36", behind_threshold_m = 400.0, left_m = 20.0 }
above_ground_m = 3.0
swerling = 1
rcs = { shape = "plate", width_m = 0.4, height_m = 0.3 }
[[target]]
name = "runner"
swerling = 2
rcs = { shape = "constant", rcs_dBsm = 5.0 }
waypoint = [
  { time_s = 0.0, at = { runway = "36", behind_threshold_m = 100.0, left_m = -40.0 }, above_ground_m = 1.0 },
  { time_s = 30.0, at = { runway = "36", behind_threshold_m = 600.0, left_m = 40.0 }, above_ground_m = 1.0 },
]
[[line]]
name = "wire"
model = "wire"
from = { runway = "36", behind_threshold_m = -300.0, left_m = 60.0 }
to = { runway = "36", behind_threshold_m = -300.0, left_m = -60.0 }
from_above_m = 15.0
to_above_m = 15.0
[weather]
visibility_m = 500.0
fog_top_m = 200.0
rain_rate_mm_per_h = 4.0
surface = "wet"
[[weather.rain_cell]]
at = { runway = "36", behind_threshold_m = 600.0, left_m = 0.0 }
rain_rate_mm_per_h = 30.0
radius_m = 300.0
[sensor]
file = "small.toml"
[accuracy]
realisation = "sample"
[trajectory.ils]
runway = "36"
start_distance_m = 1500.0
turbulence_wind_20ft_mps = 5.0
seed = 4
)";
}

// Writes the scene and its sensor into `folder`.
inline void write_busy_scene(const TemporaryFolder& folder, int cells = 60) {
  folder.write("scene.toml", busy_scene());
  folder.write("small.toml", small_sensor(cells));
}

}  // namespace fanbeam::tests
