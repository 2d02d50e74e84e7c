#include "datasets/run_conditions.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/units.h"

namespace fanbeam::datasets {
namespace {

// The end of a runway that the scene's flight lands on: the one that its last pose is nearest to.
struct Landing {
  glm::dvec3 threshold_m{0.0};
  glm::dvec2 along{0.0, 1.0};
};

Landing landing_of(const scenes::Scene& scene) {
  if (scene.runways.empty() || !scene.trajectory)
    core::throw_input_error(core::ErrorClass::ref, "traffic", "a scene without runway or flight",
                            "a scene with both: " + scene.description.name + " has not");
  const glm::dvec3 last_m =
      scene.frame.to_local_m(scene.trajectory->at(scene.trajectory->end_s()).position);
  Landing landing;
  double nearest_m = 1e300;
  for (const scenes::RunwayPlace& runway : scene.runways)
    for (const int end : {0, 1}) {
      const glm::dvec3 threshold_m = runway.ends[end].threshold_m;
      const double away_m = glm::length(threshold_m - last_m);
      if (away_m >= nearest_m) continue;
      nearest_m = away_m;
      landing.threshold_m = threshold_m;
      landing.along =
          glm::normalize(glm::dvec2(runway.ends[1 - end].threshold_m) - glm::dvec2(threshold_m));
    }
  return landing;
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

void set_conditions(session::Session& session, const Campaign& campaign, const Draw& draw,
                    const scenes::Scene& own) {
  core::ProblemList problems;
  const auto tried = [&](const auto& set) {
    try {
      set();
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  };
  tried([&] { session.set(weather_of(draw, own.weather)); });
  tried([&] {
    const auto word = draw.word("surface");
    session.set(word ? materials::surface_state_of(*word, "surface")
                     : own.description.surface_state);
  });
  tried([&] {
    session::SensorSettings settings;
    if (const auto tilt_deg = draw.number("sensor.tilt_deg"))
      settings.boresight_elevation_rad = core::radians(*tilt_deg);
    if (const auto figure_dB = draw.number("sensor.noise_figure_dB"))
      settings.noise_figure = std::pow(10.0, *figure_dB / 10.0);
    session.set(settings);
  });
  tried([&] {
    const std::vector<session::TargetState> targets = traffic_of(campaign, draw, own);
    session.set(std::span<const session::TargetState>(targets));
  });
  problems.throw_if_errors();
}

}  // namespace fanbeam::datasets
