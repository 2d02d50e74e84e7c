// A scene that uses every table and nearly every key, with the (empty) files that it names.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/scene_reader.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

// With values that are no default.
inline const std::string kFullScene = R"(material_library = "mine.toml"
data_folders = ["more data", "even more"]

[scene]
name = "full"
title = "Everything at once"
origin = { latitude_deg = -33.9, longitude_deg = 18.6, height_m = 42.0 }
vertical_datum = "egm96"
earth = "plane"

[terrain]
west_m = 1000.0
east_m = 2000.0
south_m = 3000.0
north_m = 4000.0
spacing_m = 25.0
material = "dirt"
elevation = "dem.asc"
voids = "fill"
quantisation_step_m = 0.5
land_cover = { file = "cover.asc", classes = { 0 = "dirt", 255 = "lawn" } }

[[runway]]
first = { name = "01", latitude_deg = -33.91, longitude_deg = 18.6, elevation_m = 40.0, displaced_m = 120.0 }
second = { name = "19", latitude_deg = -33.89, longitude_deg = 18.61, elevation_m = 46.0 }
width_m = 60.0
shoulder_m = 5.0
surface = "lawn"
shoulder = "dirt"
marking = "chalk"
markings = false
strip_half_width_m = 140.0
blend_m = 50.0
edge_lights = false
approach_lights = "19"
approach_light_slope = 0.01
light_rcs_dBsm = -20.0
fence = { beyond_m = 80.0, height_m = 1.8, spacing_m = 2.0, post_rcs_dBsm = -3.0 }

[[surface]]
runway = "01"
material = "dirt"
behind_threshold_m = [10.0, 200.0]
left_m = [-90.0, -60.0]

[[model]]
name = "van"
file = "van.gltf"
at = { latitude_deg = -33.9, longitude_deg = 18.601 }
above_ground_m = 0.5
heading_deg = 30.0
default_material = "dirt"
materials = { Glass = "chalk" }

[[box]]
name = "shed"
at = { runway = "01", behind_threshold_m = 300.0, left_m = -70.0 }
length_m = 20.0
width_m = 10.0
height_m = 5.0
heading_deg = 45.0
wall = "chalk"
roof = "lawn"

[[buildings]]
file = "town.geojson"
height_property = "h"
min_height_property = "h0"
base = "mean"
wall = "chalk"
roof = "lawn"

[[target]]
name = "corner"
at = { runway = "19", behind_threshold_m = 0.0 }
above_ground_m = 2.0
heading_deg = 10.0
tilt_deg = 5.0
rcs = { shape = "plate", width_m = 0.4, height_m = 0.3 }

[[target]]
rcs = { shape = "cylinder", radius_m = 0.1, length_m = 2.0 }
waypoint = [
  { time_s = 1.0, at = { runway = "19", behind_threshold_m = 0.0 }, above_ground_m = 1.0 },
  { time_s = 2.5, at = { runway = "19", behind_threshold_m = 50.0 } },
]

[[line]]
name = "wire"
from = { runway = "19", behind_threshold_m = -300.0, left_m = 50.0 }
to = { runway = "19", behind_threshold_m = -300.0, left_m = -50.0 }
from_above_m = 20.0
to_above_m = 22.0
rcs_dBsm_per_m = -17.0
spacing_m = 0.5

[weather]
liquid_water_g_per_m3 = 0.1
fog_top_m = 60.0
fog_law = "itu-p840"
rain_rate_mm_per_h = 8.0
rain_law = "itu-p838"
rain_echo_law = "mie"
drop_sizes = "joss-drizzle"
rain_top_m = 2500.0
polarisation_tilt_deg = 90.0
origin_height_m = 30.0
temperature_C = 12.0
pressure_hPa = 1000.0
humidity = 0.9

[sensor]
file = "hivision.toml"
forward_m = 3.0
right_m = 0.1
down_m = 1.0
yaw_deg = 1.0
pitch_deg = -2.0
roll_deg = 3.0
stabilised = false

[display]
mapping = "log"
low_dB = -150.0
high_dB = -90.0
cscope_mode = "flat_earth"

[accuracy]
caster = "auto"
rays_per_cell = 4.0

[trajectory]
file = "flight.csv"
vertical_datum = "ellipsoid"
height_offset_m = -1.5
from_time_s = 10.0
to_time_s = 20.0
from_row = 2
to_row = 300
angle_of_attack_deg = 3.0

[trajectory.columns]
time = "t"
time_unit = "ms"
latitude = "lat"
latitude_unit = "rad"
height = "alt_ft"
heading = "hdg_deg"

[trajectory.transplant]
from_latitude_deg = 50.0
from_longitude_deg = 8.5
from_elevation_m = 100.0
from_bearing_deg = 250.0
onto_runway = "01"

[[database]]
number = 2
scene = "innsbruck-26"
)";

inline void write_full_scene(const TemporaryFolder& folder) {
  folder.write("scene.toml", kFullScene);
  std::filesystem::create_directories(folder.path() / "even more");
  std::filesystem::create_directories(folder.path() / "more data");
  for (const char* name : {"mine.toml", "dem.asc", "cover.asc", "van.gltf", "flight.csv",
                           "even more/town.geojson", "more data/town.geojson"})
    folder.write(name, "");
}

// The description of a scene that must be free of errors.
inline scenes::SceneDescription read(const std::filesystem::path& path,
                                     const std::vector<std::filesystem::path>& data = {}) {
  core::ProblemList problems;
  const scenes::SceneDescription scene =
      scenes::read_scene(path, {FANBEAM_SOURCE_DIR, data, {}}, problems);
  for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
  CHECK_FALSE(problems.has_errors());
  return scene;
}

}  // namespace fanbeam::tests
