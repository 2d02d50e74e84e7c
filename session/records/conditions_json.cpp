#include "session/records/conditions_json.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/decibel.h"
#include "core/units.h"

namespace fanbeam::session {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json fog_layers_json(const std::vector<atmosphere::FogLayer>& layers) {
  Json json = Json::array();
  for (const atmosphere::FogLayer& layer : layers)
    json.push_back({{"visibility_m", number_or_null(layer.visibility_m)},
                    {"liquid_water_g_per_m3", number_or_null(layer.liquid_water_g_per_m3)},
                    {"fog_type", name_of(layer.water_model)},
                    {"fog_law", name_of(layer.law)},
                    {"base_m", layer.base_m},
                    {"top_m", layer.top_m}});
  return json;
}

Json rain_cells_json(const std::vector<atmosphere::RainCell>& cells) {
  Json json = Json::array();
  for (const atmosphere::RainCell& cell : cells)
    json.push_back({{"east_m", cell.centre_m.x},
                    {"north_m", cell.centre_m.y},
                    {"rain_rate_mm_per_h", cell.rain_rate_mm_per_h},
                    {"radius_m", cell.radius_m},
                    {"length_m", cell.length_m},
                    {"width_m", cell.width_m},
                    {"heading_deg", core::degrees(cell.heading_rad)},
                    {"base_m", cell.base_m},
                    {"top_m", cell.top_m}});
  return json;
}

Json air_levels_json(const std::vector<atmosphere::AirLevel>& levels) {
  Json json = Json::array();
  for (const atmosphere::AirLevel& level : levels)
    json.push_back({{"height_m", level.height_m},
                    {"temperature_C", level.temperature_C},
                    {"humidity", level.humidity},
                    {"pressure_hPa", number_or_null(level.pressure_hPa)}});
  return json;
}

// Without what the plan decides of it.
Json weather_set_json(const scenes::Scene& scene) {
  constexpr const char* kGasParts[] = {"whole", "oxygen", "vapour"};
  const atmosphere::Weather& weather = scene.weather;
  return {{"visibility_m", number_or_null(weather.visibility_m)},
          {"liquid_water_g_per_m3", number_or_null(weather.liquid_water_g_per_m3)},
          {"fog_type", name_of(weather.fog_water_model)},
          {"fog_law", name_of(weather.fog_law)},
          {"fog_top_m", weather.fog_top_m},
          {"fog_layer", fog_layers_json(weather.fog_layers)},
          {"rain_rate_mm_per_h", weather.rain_rate_mm_per_h},
          {"rain_law", name_of(weather.rain_law)},
          {"rain_echo_law", name_of(weather.rain_echo_law)},
          {"drop_sizes", name_of(weather.drop_sizes)},
          {"rain_top_m", weather.rain_top_m},
          {"polarisation_tilt_deg", core::degrees(weather.polarisation_tilt_rad)},
          {"rain_path_elevation_deg", core::degrees(weather.rain_path_elevation_rad)},
          {"rain_cell", rain_cells_json(weather.rain_cells)},
          {"melting_layer", weather.melting_layer},
          {"melting_height_m", number_or_null(weather.melting_height_m)},
          {"snow_rate_mm_per_h", weather.snow_rate_mm_per_h},
          {"snow_top_m", weather.snow_top_m},
          {"surface", name_of(scene.description.surface_state)},
          {"origin_height_m", weather.origin_height_m},
          {"temperature_C", number_or_null(weather.temperature_C)},
          {"pressure_hPa", number_or_null(weather.pressure_hPa)},
          {"humidity", number_or_null(weather.humidity)},
          {"level", air_levels_json(weather.levels)},
          {"gas_part", kGasParts[static_cast<std::size_t>(weather.gas_part)]}};
}

Json sensor_set_json(const sensors::Sensor& sensor) {
  const sensors::Display& display = sensor.display;
  return {{"boresight_elevation_deg", core::degrees(sensor.antenna.boresight_elevation_rad)},
          {"stabilised", sensor.scan.stabilised},
          {"display_low_dB", display.low_dB},
          {"display_high_dB", display.high_dB},
          {"cscope_mode",
           sensors::Display::kCScopeModes[static_cast<std::size_t>(display.cscope_mode)]},
          {"noise_figure_dB", core::dB_from_power(sensor.receiver.noise_figure, -400.0)}};
}

// Shapes and sizes as scene files name them.
struct RcsWriter {
  Json operator()(const materials::ConstantRcs& rcs) const {
    return {{"shape", "constant"}, {"rcs_m2", rcs.rcs_m2}};
  }
  Json operator()(const materials::Sphere& rcs) const {
    return {{"shape", "sphere"}, {"radius_m", rcs.radius_m}};
  }
  Json operator()(const materials::TriangularTrihedral& rcs) const {
    return {{"shape", "trihedral"}, {"edge_m", rcs.edge_m}};
  }
  Json operator()(const materials::SquareTrihedral& rcs) const {
    return {{"shape", "square_trihedral"}, {"edge_m", rcs.edge_m}};
  }
  Json operator()(const materials::Dihedral& rcs) const {
    return {{"shape", "dihedral"}, {"width_m", rcs.width_m}, {"height_m", rcs.height_m}};
  }
  Json operator()(const materials::RectangularPlate& rcs) const {
    return {{"shape", "plate"}, {"width_m", rcs.width_m}, {"height_m", rcs.height_m}};
  }
  Json operator()(const materials::Cylinder& rcs) const {
    return {{"shape", "cylinder"}, {"radius_m", rcs.radius_m}, {"length_m", rcs.length_m}};
  }
  Json operator()(const materials::RoundWire& rcs) const {
    return {{"shape", "wire"},
            {"radius_m", rcs.radius_m},
            {"length_m", rcs.length_m},
            {"polarisation_deg", core::degrees(rcs.polarisation_rad)},
            {"coherence_length_m", rcs.coherence_length_m}};
  }
  Json operator()(const materials::LobedRcs& rcs) const {
    Json lobes = Json::array();
    for (const materials::AspectLobe& lobe : rcs.lobes)
      lobes.push_back({{"azimuth_deg", core::degrees(lobe.azimuth_rad)},
                       {"azimuth_width_deg", core::degrees(lobe.azimuth_width_rad)},
                       {"elevation_deg", core::degrees(lobe.elevation_rad)},
                       {"elevation_width_deg", core::degrees(lobe.elevation_width_rad)},
                       {"peak_m2", lobe.peak_m2}});
    return {{"shape", "lobed"}, {"floor_m2", rcs.floor_m2}, {"lobes", lobes}};
  }
};

bool is_same(const renderer::PointTarget& a, const renderer::PointTarget& b) {
  using Waypoint = renderer::PointTarget::Waypoint;
  const auto alike = [](const Waypoint& one, const Waypoint& other) {
    return one.time_s == other.time_s && one.position_m == other.position_m;
  };
  return a.name == b.name && a.swerling == b.swerling && a.axes == b.axes &&
         std::equal(a.path.begin(), a.path.end(), b.path.begin(), b.path.end(), alike) &&
         std::visit(RcsWriter{}, a.rcs) == std::visit(RcsWriter{}, b.rcs);
}

Json target_json(const renderer::PointTarget& target, const terrain::LocalFrame& frame) {
  Json path = Json::array();
  for (const renderer::PointTarget::Waypoint& waypoint : target.path) {
    const core::Geodetic at = frame.to_geodetic(waypoint.position_m);
    path.push_back({{"time_s", waypoint.time_s},
                    {"latitude_deg", core::degrees(at.latitude_rad)},
                    {"longitude_deg", core::degrees(at.longitude_rad)},
                    {"height_m", at.height_m}});
  }
  Json axes = Json::array();
  for (int i = 0; i < 3; ++i)
    axes.push_back(Json::array({target.axes[i].x, target.axes[i].y, target.axes[i].z}));
  return {{"name", target.name},
          {"rcs", std::visit(RcsWriter{}, target.rcs)},
          {"swerling", static_cast<int>(target.swerling)},
          {"path", path},
          {"axes", axes}};
}

// A session leaves the scene's own targets first, in their order.
Json targets_set_json(const scenes::Scene& opened, const scenes::Scene& now) {
  const std::vector<renderer::PointTarget>& own = opened.world.targets;
  const std::vector<renderer::PointTarget>& targets = now.world.targets;
  Json json = Json::array();
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (i >= own.size() || !is_same(own[i], targets[i]))
      json.push_back(target_json(targets[i], now.frame));
  return json;
}

Json members_changed(const Json& own, const Json& now) {
  Json json = Json::object();
  for (const auto& [key, value] : now.items())
    if (own.at(key) != value) json[key] = value;
  return json;
}

}  // namespace

std::string changed_conditions_json(const scenes::Scene& opened, const scenes::Scene& now) {
  Json json = Json::object();
  const auto add = [&](const char* name, Json changed) {
    if (!changed.empty()) json[name] = std::move(changed);
  };
  add("weather", members_changed(weather_set_json(opened), weather_set_json(now)));
  add("sensor", members_changed(sensor_set_json(opened.description.sensor),
                                sensor_set_json(now.description.sensor)));
  add("targets", targets_set_json(opened, now));
  return json.empty() ? std::string() : json.dump();
}

}  // namespace fanbeam::session
