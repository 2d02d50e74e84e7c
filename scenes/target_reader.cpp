#include "scenes/target_reader.h"

#include <algorithm>
#include <cmath>

#include "core/decibel.h"
#include "core/units.h"
#include "scenes/line_points.h"
#include "scenes/object_reader.h"

namespace fanbeam::scenes {
namespace {

using core::ConfigTable;
using core::radians;

constexpr core::NumberRange kRcs_dBsm{-80.0, 80.0};
constexpr core::NumberRange kSize_m{0.001, 100.0};
// Power lines are some 10 to 30 mm thick, fence wire 2 mm.
constexpr core::NumberRange kWireRadius_m{1e-4, 10.0};
constexpr core::NumberRange kAcrossWire_deg{0.0, 90.0};
constexpr core::NumberRange kSpacing_m{0.01, 100.0};
// On the flight's clock, which may count from 1970.
constexpr core::NumberRange kTimes_s{-1e10, 1e10, true};

materials::RoundWire read_wire(ConfigTable& table, double usual_polarisation_rad) {
  materials::RoundWire wire;
  wire.radius_m = table.number("radius_m", kWireRadius_m, 0.01);
  wire.length_m = table.number("length_m", kSize_m, 1.0);
  wire.polarisation_rad = radians(
      table.number("polarisation_deg", kAcrossWire_deg, core::degrees(usual_polarisation_rad)));
  wire.coherence_length_m = table.number("coherence_length_m", kSize_m, wire.length_m);
  return wire;
}

materials::RcsModel read_shape(ConfigTable& table, double wire_polarisation_rad) {
  switch (table.choice("shape",
                       {"constant", "sphere", "trihedral", "square_trihedral", "dihedral", "plate",
                        "cylinder", "wire"},
                       0)) {
    case 1:
      return materials::Sphere{table.number("radius_m", kSize_m, 0.1)};
    case 2:
      return materials::TriangularTrihedral{table.number("edge_m", kSize_m, 0.1)};
    case 3:
      return materials::SquareTrihedral{table.number("edge_m", kSize_m, 0.1)};
    case 4:
      return materials::Dihedral{table.number("width_m", kSize_m, 0.1),
                                 table.number("height_m", kSize_m, 0.1)};
    case 5:
      return materials::RectangularPlate{table.number("width_m", kSize_m, 0.1),
                                         table.number("height_m", kSize_m, 0.1)};
    case 6:
      return materials::Cylinder{table.number("radius_m", kSize_m, 0.1),
                                 table.number("length_m", kSize_m, 1.0)};
    case 7:
      return read_wire(table, wire_polarisation_rad);
    default:
      return materials::ConstantRcs{rcs_m2_from(table, "rcs_dBsm", 0.0)};
  }
}

// `rcs` is the name of a typical object or the table of a shape. Returns the Swerling case that
// goes with it.
core::Swerling read_rcs(ConfigTable& target, ObjectNames& objects, double wire_polarisation_rad,
                        materials::RcsModel& rcs) {
  if (target.is_text("rcs")) {
    const materials::TypicalObject* object = objects.find(target, "rcs");
    if (object == nullptr) return core::Swerling::steady;
    rcs = object->rcs();
    return object->fluctuation;
  }
  ConfigTable table = target.table("rcs");
  if (!target.has("rcs"))
    target.error(core::ErrorClass::ref, "rcs", "missing",
                 "the name of an object or { shape, ... }, see docs/scene-format.md");
  rcs = read_shape(table, wire_polarisation_rad);
  return core::Swerling::steady;
}

// Of a target between two waypoints or more.
TargetDescription::Swing read_swing(ConfigTable& target, const TargetDescription& description,
                                    WaypointBudget& budget) {
  constexpr double kMostSwings = 5000.0;
  ConfigTable table = target.table("swing");
  TargetDescription::Swing swing;
  swing.amplitude_m = table.required_number("amplitude_m", {0.0, 10.0});
  swing.period_s = table.required_number("period_s", {0.05, 60.0});
  swing.phase_rad = radians(table.number("phase_deg", {-360.0, 360.0}, 0.0));
  const auto& path = description.path;
  const double duration_s = path.empty() ? 0.0 : path.back().time_s - path.front().time_s;
  if (path.size() < 2) {
    target.error(core::ErrorClass::ref, "swing", "without a way", "two waypoints or more");
  } else if (duration_s > kMostSwings * swing.period_s) {
    table.error(core::ErrorClass::limit, "period_s", core::number_text(swing.period_s),
                "at most 5000 swings from the first waypoint to the last");
  } else {
    double waypoints = 1.0;
    for (std::size_t i = 1; i < path.size(); ++i)  // whose times may be out of order, and told
      waypoints += std::max(swing.legs(path[i].time_s - path[i - 1].time_s), 0.0);
    budget.take(target, "swing", waypoints);
  }
  return swing;
}

}  // namespace

double rcs_m2_from(ConfigTable& table, std::string_view key, double fallback_dBsm) {
  return core::power_from_dB(table.number(key, kRcs_dBsm, fallback_dBsm));
}

TargetDescription read_target(ConfigTable& table, const std::string& usual_name,
                              ObjectNames& objects, HighwayPaths& highway,
                              WaypointBudget& waypoint_budget, core::Polarisation polarisation) {
  TargetDescription target;
  target.place = table.place("");
  target.name = table.text("name", usual_name);
  target.heading_rad = radians(table.number("heading_deg", kHeading_deg, 0.0));
  target.tilt_rad = radians(table.number("tilt_deg", {-90, 90}, 0.0));
  // A wire stands across the boresight.
  const core::Swerling usual = read_rcs(
      table, objects, across_wire_rad(std::cos(target.tilt_rad), polarisation), target.rcs);
  target.swerling =
      static_cast<core::Swerling>(table.integer("swerling", 0, 4, static_cast<int>(usual)));
  std::vector<ConfigTable> waypoints = table.tables("waypoint");
  for (ConfigTable& waypoint : waypoints) {
    const double time_s = waypoint.required_number("time_s", kTimes_s);
    // One that is wrong, and told, reads as the low end.
    if (!target.path.empty() && time_s > kTimes_s.low && time_s <= target.path.back().time_s)
      waypoint.error(core::ErrorClass::time, "time_s", core::number_text(time_s),
                     "later than the waypoint before");
    target.path.push_back(
        {time_s, read_spot(waypoint, "at"), waypoint.number("above_ground_m", {-100, 20000}, 0.0)});
  }
  if (table.has("swing")) target.swing = read_swing(table, target, waypoint_budget);
  if (table.has("highway")) {
    if (!waypoints.empty())
      table.error(core::ErrorClass::ref, "highway", "beside waypoints", "one of the two");
    const Spot origin = read_spot(table, "at");
    target.path = highway.path(table, origin, table.number("above_ground_m", {-100, 20000}, 0.0),
                               waypoint_budget);
  } else if (waypoints.empty()) {
    target.path.push_back(
        {0.0, read_spot(table, "at"), table.number("above_ground_m", {-100, 20000}, 0.0)});
  }
  return target;
}

InterfererDescription read_interferer(ConfigTable& table, const sensors::Waveform& own) {
  InterfererDescription other;
  other.place = table.place("");
  other.name = table.text("name", "interferer");
  other.target = table.required_text("target");
  other.eirp_W = 1e-3 * core::power_from_dB(table.required_number("eirp_dBm", {-100.0, 100.0}));
  other.centre_frequency_Hz =
      1e9 * table.number("frequency_GHz", {1e-3, 1000.0}, 1e-9 * own.frequency_Hz);
  other.bandwidth_Hz = 1e6 * table.number("bandwidth_MHz", {0.0, 1e5}, 1e-6 * own.bandwidth_Hz);
  other.falling = table.boolean("falling", false);
  other.ramp_s = 1e-6 * table.number("ramp_us", {1e-2, 1e9}, 20.0);
  other.interval_s =
      1e-6 * table.number("interval_us", {1e6 * other.ramp_s, 1e9}, 1e6 * other.ramp_s);
  other.start_s = 1e-6 * table.number("start_us", {-1e9, 1e9}, 0.0);
  if (!(other.bandwidth_Hz < 2.0 * other.centre_frequency_Hz))
    table.error(core::ErrorClass::range, "bandwidth_MHz",
                core::number_text(1e-6 * other.bandwidth_Hz), "less than twice the frequency");
  return other;
}

LineDescription read_line(ConfigTable& table, ObjectNames& objects) {
  LineDescription line;
  line.place = table.place("");
  line.name = table.text("name", "line");
  line.from = read_spot(table, "from");
  line.to = read_spot(table, "to");
  line.from_above_m = table.number("from_above_m", {-100, 2000}, 0.0);
  line.to_above_m = table.number("to_above_m", {-100, 2000}, 0.0);
  if (table.has("object")) {
    if (const materials::TypicalObject* object = objects.find(table, "object")) {
      line.object = object->rcs();
      line.swerling = object->fluctuation;
    }
    line.spacing_m = table.number("spacing_m", kSpacing_m, 3.0);
  } else if (table.choice("model", {"even", "wire"}, 0) == 1) {
    line.spacing_m = table.number("spacing_m", kSpacing_m, 0.5);
    line.wire.emplace();
    line.wire->radius_m = table.number("radius_m", kWireRadius_m, line.wire->radius_m);
    line.wire->coherence_length_m = table.number("coherence_length_m", {0.0, 100.0}, 0.0);
    if (const auto across_deg = table.optional_number("polarisation_deg", kAcrossWire_deg))
      line.wire->polarisation_rad = radians(*across_deg);
    table.only_with({"rcs_dBsm_per_m"}, "model = \"even\"");
  } else {
    line.rcs_m2_per_m = rcs_m2_from(table, "rcs_dBsm_per_m", -10.0);
    line.spacing_m = table.number("spacing_m", kSpacing_m, 1.0);
    table.only_with({"radius_m", "coherence_length_m", "polarisation_deg"}, "model = \"wire\"");
  }
  return line;
}

}  // namespace fanbeam::scenes
