// The tables of scene.toml with point scatterers: [[target]] and [[line]].
#pragma once

#include <string>

#include "core/config_table.h"
#include "core/polarisation.h"
#include "scenes/description.h"
#include "scenes/highway_path.h"
#include "scenes/object_names.h"
#include "scenes/waypoint_budget.h"

namespace fanbeam::scenes {

inline constexpr core::NumberRange kHeading_deg{-360.0, 360.0};

// -80 to 80 dBsm under the key, as an RCS in m2.
double rcs_m2_from(core::ConfigTable& table, std::string_view key, double fallback_dBsm);

// `usual_name` where the table has none. `polarisation` is the radar's: what a wire is seen with.
// `waypoint_budget` is that of all targets.
TargetDescription read_target(core::ConfigTable& table, const std::string& usual_name,
                              ObjectNames& objects, HighwayPaths& highway,
                              WaypointBudget& waypoint_budget, core::Polarisation polarisation);
// [[interferer]]; carrier and sweep are the sensor's unless it says otherwise.
InterfererDescription read_interferer(core::ConfigTable& table, const sensors::Waveform& own);
LineDescription read_line(core::ConfigTable& table, ObjectNames& objects);

}  // namespace fanbeam::scenes
