// Highway scenarios from a JSON file ("format": "highway-scenarios", version 1).
//
// The file counts y and azimuth positive to the left; they are turned here, so that all of fanbeam
// counts them positive to the right. Gains and noise figure come in decibels.
// Motion "piecewise-acceleration" has position_m, velocity_mps and segments of two types:
//   {"type": "acceleration", "t0_s", "t1_s", "acceleration_mps2": [x, y]}
//   {"type": "lane-change",  "t0_s", "t1_s", "lateral_m"}           (to the left)
// and "circular" has radius_m, azimuth0_rad, angular_rate_rad_s. A scenario may have "radar_overrides", with
// keys of "radar", and "suppressed_detections", [{"id", "from_s", "to_s"}]: a target that is not measured then.
// "waveforms" are named: {"type": "triangle", "ramp_s", "sample_rate_hz"}, {"type": "triangle-pair", "ramp_s": [a, b]}, {"type":
// "two-stage", "coarse": {"chirps", "chirp_s", "sample_rate_hz"}, "fine": {"ramp_s", "sample_rate_hz"}}, {"type":
// "up-flat-down", "ramp_s", "flat_s", "flat_step_hz", "flat_code"}. Of each type the first name in the order of letters
// counts, or the first of those that a scenario names in its own "waveforms"; what is missing is 2 ms ramps and so on (HighwayWaveforms).
// Those that count for a scenario that names them take no longer than its frame period.
// Members that describe purpose, events, acceptance and truth tables are not read; docs/highway.schema.json has
// them all.
// All problems are told together, each with its JSON pointer ("/scenarios/1/targets/0/rcs_m2"): E-PARSE
// for what is no JSON or of the wrong type, E-REF for a member that is missing; E-NONFINITE and E-RANGE
// for values, a file without scenarios, fractions where a whole number is asked for, segments below
// a nanosecond and a pair of equal ramps included, for truth that a target's motion contradicts (0.1 m, 0.1 m/s, 2 mrad), and for
// a target's id that is empty or holds a comma, a quote or a control character; E-REF also for a member
// that the format, or this type of motion, segment or waveform, does not have, with those like it, for
// truth of an unknown target, and for a scenario, target or truth table whose name was used before;
// E-UNSUPPORTED for another format or version, or an unknown motion; E-LIMIT for more than 64 MiB, a
// million values, nesting deeper than 64, more than 1000 scenarios, targets, segments or truth rows of
// one owner; E-IO.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/highway.h"

namespace fanbeam::scenes {

struct HighwayFile {
  core::HighwayRadar radar;
  std::vector<core::HighwayScenario> scenarios;
  std::string name{};  // of the file, for messages
};

HighwayFile read_highway_file(const std::filesystem::path& file);

// The same from text; `name` stands in messages.
HighwayFile parse_highway(const std::string& text, const std::string& name);

}  // namespace fanbeam::scenes
