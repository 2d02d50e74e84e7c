#include "datasets/run_conditions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/units.h"

namespace fanbeam::datasets {
namespace {

struct Landing {
  glm::dvec3 threshold_m{0.0};
  glm::dvec2 along{0.0, 1.0};
};

// Where the flight's last kilometre leads, of length 1; 0 where it stands still. Neither the way from its
// beginning, which a circuit ends against, nor its last heading, which may be that of a taxiway.
glm::dvec2 last_course(const scenes::Scene& scene) {
  constexpr double kFar_m = 1000.0, kStep_s = 1.0;
  const scenes::Trajectory& flight = *scene.trajectory;
  const auto at_m = [&](double time_s) {
    return glm::dvec2(scene.frame.to_local_m(flight.at(time_s).position));
  };
  const glm::dvec2 last_m = at_m(flight.end_s());
  glm::dvec2 way_m = last_m - at_m(flight.begin_s());
  for (double time_s = flight.end_s(); time_s > flight.begin_s(); time_s -= kStep_s) {
    const glm::dvec2 from_there_m = last_m - at_m(time_s);
    if (glm::length(from_there_m) < kFar_m) continue;
    way_m = from_there_m;
    break;
  }
  const double length_m = glm::length(way_m);
  return length_m < 1.0 ? glm::dvec2(0.0) : way_m / length_m;
}

// The end of a runway that the scene's flight lands on: of those that lie along its course the one whose
// runway its last pose is nearest to, which may have rolled out beyond the middle. Where none does, because
// the flight stands still or ends in a turn, the threshold that is nearest.
Landing landing_of(const scenes::Scene& scene) {
  if (scene.runways.empty() || !scene.trajectory)
    core::throw_input_error(core::ErrorClass::ref, "traffic", "a scene without runway or flight",
                            "a scene with both: " + scene.description.name + " has not");
  constexpr double kLeastCosine = 0.7071;  // of a course along a runway: 45 deg
  const glm::dvec2 last_m(
      scene.frame.to_local_m(scene.trajectory->at(scene.trajectory->end_s()).position));
  const glm::dvec2 course = last_course(scene);
  Landing landing;
  std::pair<bool, double> least{true, 1e300};  // not along the course, metres away
  for (const scenes::RunwayPlace& runway : scene.runways)
    for (const int end : {0, 1}) {
      const glm::dvec3 threshold_m = runway.ends[end].threshold_m;
      const glm::dvec2 whole_m =
          glm::dvec2(runway.ends[1 - end].threshold_m) - glm::dvec2(threshold_m);
      const glm::dvec2 along = glm::normalize(whole_m), from_m = last_m - glm::dvec2(threshold_m);
      const bool lands = glm::dot(along, course) > kLeastCosine;
      const double behind_m =
          lands ? std::clamp(glm::dot(from_m, along), 0.0, glm::length(whole_m)) : 0.0;
      const std::pair<bool, double> off{!lands, glm::length(from_m - behind_m * along)};
      if (off >= least) continue;
      least = off;
      landing = {threshold_m, along};
    }
  return landing;
}

// Such traffic would move the scene's target, and leave it where it is in runs without.
void check_traffic_names(const Campaign& campaign, const scenes::Scene& scene,
                         core::ProblemList& problems) {
  for (const std::string& name : campaign.traffic) {
    const auto has_name = [&](const renderer::PointTarget& target) { return target.name == name; };
    const auto& targets = scene.world.targets;
    if (std::any_of(targets.begin(), targets.end(), has_name))
      problems.error(core::ErrorClass::ref, {}, "traffic.name", "\"" + name + "\"",
                     "another name than the targets of " + scene.description.name + " have");
  }
}

std::vector<session::TargetState> traffic_of(const Campaign& campaign, const Draw& draw,
                                             const scenes::Scene& scene) {
  std::vector<session::TargetState> targets;
  for (const std::string& name : campaign.traffic) {
    const auto told = [&](const char* key) {
      return draw.number("traffic." + name + "." + key).value();
    };
    if (told("present") < 0.5) continue;
    const Landing landing = landing_of(scene);
    const glm::dvec2 right(landing.along.y, -landing.along.x);
    const glm::dvec2 at_m = glm::dvec2(landing.threshold_m) + told("along_m") * landing.along +
                            told("across_m") * right;
    const terrain::HeightField* ground = scene.world.surfaces().terrain();
    const double up_m =
        (ground == nullptr ? landing.threshold_m.z : ground->nearest_height(at_m.x, at_m.y)) +
        told("height_m");
    session::TargetState target;
    target.name = name;
    target.position = scene.frame.to_geodetic({at_m, up_m});
    target.rcs = materials::ConstantRcs{told("rcs_m2")};
    targets.push_back(std::move(target));
  }
  return targets;
}

}  // namespace

atmosphere::Weather weather_of(const Draw& draw, const atmosphere::Weather& own) {
  atmosphere::Weather weather = own;
  if (const auto visibility_m = draw.number("weather.visibility_m")) {
    weather.visibility_m = visibility_m;
    weather.liquid_water_g_per_m3.reset();
  }
  if (const auto water = draw.number("weather.liquid_water_g_per_m3")) {
    weather.liquid_water_g_per_m3 = water;
    weather.visibility_m.reset();
  }
  const auto set = [&](const char* name, auto& place) {
    if (const auto told = draw.number(std::string("weather.") + name)) place = *told;
  };
  set("fog_top_m", weather.fog_top_m);
  set("rain_rate_mm_per_h", weather.rain_rate_mm_per_h);
  set("snow_rate_mm_per_h", weather.snow_rate_mm_per_h);
  set("temperature_C", weather.temperature_C);
  set("pressure_hPa", weather.pressure_hPa);
  set("humidity", weather.humidity);
  return weather;
}

core::ProblemList set_conditions(session::Session& session, const Campaign& campaign,
                                 const Draw& draw, const scenes::Scene& own) {
  core::ProblemList problems, warnings;
  const auto tried = [&](const auto& set) {
    try {
      warnings = set();
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  };
  tried([&] { return session.set(weather_of(draw, own.weather)); });
  tried([&] {
    const auto word = draw.word("surface");
    return session.set(word ? materials::surface_state_of(*word, "surface")
                            : own.description.surface_state);
  });
  tried([&] {
    session::SensorSettings settings;
    if (const auto tilt_deg = draw.number("sensor.tilt_deg"))
      settings.boresight_elevation_rad = core::radians(*tilt_deg);
    if (const auto figure_dB = draw.number("sensor.noise_figure_dB"))
      settings.noise_figure = std::pow(10.0, *figure_dB / 10.0);
    return session.set(settings);
  });
  check_traffic_names(campaign, own, problems);
  tried([&] {
    const std::vector<session::TargetState> targets = traffic_of(campaign, draw, own);
    return session.set(std::span<const session::TargetState>(targets));
  });
  problems.throw_if_errors();
  return warnings;  // of the last, when all were set
}

}  // namespace fanbeam::datasets
