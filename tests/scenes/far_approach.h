// An approach that begins where nothing of the airport is within range: a hangar, a post and a
// shower come into view one after the other.
#pragma once

#include <string>

#include "core/files.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

// Writes scene.toml and a sensor of 8 columns; `replaced_from` of the scene becomes `replaced_to`.
inline void write_far_approach(const TemporaryFolder& folder, const std::string& replaced_from = "",
                               const std::string& replaced_to = "") {
  const std::string sensor =
      core::read_file(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", 1U << 20U);
  folder.write("few.toml", replaced(sensor, "field_of_view_deg = 41.0\ncolumns = 164",
                                    "field_of_view_deg = 6.0\ncolumns = 8"));
  const std::string scene = R"([scene]
name = "far"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 50.0 }
vertical_datum = "scene"

[sensor]
file = "few.toml"

[terrain]
half_extent_m = 9000.0
spacing_m = 100.0
material = "short_grass"

[[runway]]
first = { name = "36", latitude_deg = 52.0, longitude_deg = 10.0, elevation_m = 50.0 }
second = { name = "18", latitude_deg = 52.009, longitude_deg = 10.0, elevation_m = 50.0 }
edge_lights = false

[[box]]
name = "hangar"
at = { runway = "36", behind_threshold_m = 300.0, left_m = 60.0 }
length_m = 40.0
width_m = 30.0
height_m = 12.0
wall = "metal"

[[target]]
name = "post"
at = { runway = "36", behind_threshold_m = -600.0, left_m = 20.0 }
rcs = { shape = "constant", rcs_dBsm = 10.0 }
above_ground_m = 4.0

[[weather.rain_cell]]
at = { runway = "36", behind_threshold_m = 1500.0 }
radius_m = 400.0
rain_rate_mm_per_h = 20.0

[trajectory.ils]
runway = "36"
start_distance_m = 6500.0
speed_mps = 70.0
end = "decision_height"
)";
  folder.write("scene.toml",
               replaced_from.empty() ? scene : replaced(scene, replaced_from, replaced_to));
}

inline std::unique_ptr<scenes::Scene> built_for_frames(const TemporaryFolder& folder,
                                                       double accuracy_grey = 0.5,
                                                       const std::string& effects = "") {
  core::ProblemList problems;
  const scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  scenes::BuildOptions options;
  options.accuracy_grey = accuracy_grey;
  if (!effects.empty()) options.wishes = renderer::parse_effect_wishes(effects);
  return scenes::build_scene(description, options, problems);
}

}  // namespace fanbeam::tests
