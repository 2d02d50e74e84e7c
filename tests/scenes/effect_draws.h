// Scenes drawn at random: weather, relief, walls, targets, flight and sensor, every effect with
// magnitudes around the ones that matter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/random.h"
#include "tests/scenes/effect_scene.h"

namespace fanbeam::tests {

// The n-th number of a seed.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : key_{seed, 77, 0} {}

  double uniform() { return core::uniform_from(core::random_words(key_, count_++, 0)[0]); }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  // Even over the logarithm.
  double scaled(double low, double high) { return low * std::pow(high / low, uniform()); }
  int whole(int low, int high) { return low + static_cast<int>((high - low + 1) * uniform()); }
  bool chance(double share) { return uniform() < share; }

 private:
  core::RandomKey key_;
  std::uint64_t count_ = 0;
};

namespace detail {

inline void draw_beam(Draws& draws, double low_deg, double high_deg, double lobes,
                      sensors::BeamCut& cut) {
  cut.half_power_width_rad = core::radians(draws.between(low_deg, high_deg));
  cut.cut_rad = cut.half_power_width_rad * draws.between(0.8, 1.6);
  if (draws.chance(0.1)) cut.shape = sensors::BeamCut::Shape::sinc_squared;
  if (!draws.chance(lobes)) return;
  // Two-way -61 dB: a cell on the edge of the cut does not show which rays it got.
  cut.cut_rad = 1.6 * cut.half_power_width_rad;
  cut.side_lobe_gain = draws.scaled(1e-11, 1e-2);
  cut.side_lobe_extent_rad = core::radians(draws.between(20.0, 90.0));
}

inline void draw_display(Draws& draws, sensors::Sensor& sensor) {
  using sensors::Display;
  Display& display = sensor.display;
  const double kind = draws.uniform();
  display.mapping = kind < 0.7   ? Display::Mapping::stc
                    : kind < 0.9 ? Display::Mapping::log
                                 : Display::Mapping::seed;
  if (display.mapping == Display::Mapping::stc) {
    display.low_dB = draws.between(-70.0, -35.0);
    display.high_dB = display.low_dB + draws.between(20.0, 80.0);
  } else {
    display.low_dB = draws.between(-170.0, -120.0);
    display.high_dB = display.low_dB + draws.between(30.0, 100.0);
  }
  const double mode = draws.uniform();
  display.cscope_mode = mode < 0.55  ? Display::CScopeMode::true_elevation
                        : mode < 0.9 ? Display::CScopeMode::flat_earth
                                     : Display::CScopeMode::shadow;
  display.cscope_rows = draws.whole(10, 60);
}

inline void draw_sensor(Draws& draws, sensors::Sensor& sensor) {
  using sensors::Waveform;
  Waveform& wave = sensor.waveform;
  wave.frequency_Hz = draws.scaled(24e9, 94e9);
  wave.transmit_power_W = draws.scaled(1e-2, 1e4);
  sensor.scan.columns = draws.whole(3, 8);
  sensor.scan.field_of_view_rad = core::radians(draws.between(0.3, 1.0)) * sensor.scan.columns;
  sensor.scan.stabilised = draws.chance(0.8);
  if (draws.chance(0.15)) sensor.scan.surface = sensors::ScanSurface::cone;
  draw_beam(draws, 0.5, 2.0, 0.3, sensor.antenna.azimuth);
  draw_beam(draws, 4.0, 15.0, 0.15, sensor.antenna.elevation);
  sensor.antenna.boresight_elevation_rad = core::radians(draws.between(-10.0, 8.0));
  sensor.range.minimum_m = draws.between(60.0, 300.0);
  sensor.range.cell_m = draws.between(5.0, 40.0);
  sensor.range.cells = draws.whole(30, 90);
  const double finest_Hz = core::kSpeedOfLight_mps / (2.0 * sensor.range.cell_m);
  wave.bandwidth_Hz = finest_Hz * draws.scaled(1.0, 90.0);
  if (draws.chance(0.3))
    wave.window = draws.chance(0.5) ? Waveform::Window::hann : Waveform::Window::taylor;
  sensor.receiver.noise_figure = draws.scaled(2.0, 20.0);
  sensor.receiver.looks = draws.whole(1, 4);
  sensor.receiver.dwell_s /= sensor.receiver.looks;
  draw_display(draws, sensor);
}

inline scenes::Spot draw_spot(Draws& draws, double reach_m) {
  const double range_m = reach_m * draws.between(0.1, 0.9);
  scenes::Spot spot;
  spot.latitude_rad = core::radians(52.0 + range_m / 111267.0);
  spot.longitude_rad = core::radians(10.0 + range_m * draws.between(-0.04, 0.04) / 68677.0);
  return spot;
}

// Without its side lobes such an antenna looks along other rays: over relief, walls, runways and
// the borders of rain cells these differ by more than the lobes do. Its scenes have none of them.
inline bool lobes_move_rays(const sensors::Antenna& antenna) {
  constexpr auto kSinc = sensors::BeamCut::Shape::sinc_squared;
  return antenna.elevation.side_lobe_gain > 0.0 || antenna.elevation.shape == kSinc ||
         antenna.azimuth.shape == kSinc;
}

inline void draw_weather(Draws& draws, EffectScene& scene) {
  atmosphere::Weather& weather = scene.weather();
  weather.humidity = draws.chance(0.3) ? 0.0 : draws.uniform();
  weather.pressure_hPa = draws.chance(0.3) ? 300.0 : draws.between(300.0, 1050.0);
  weather.temperature_C = draws.between(-20.0, 25.0);
  if (draws.chance(0.5)) {
    weather.liquid_water_g_per_m3 = draws.scaled(1e-5, 1.0);
    weather.fog_top_m = draws.between(-20.0, 500.0);
  }
  if (draws.chance(0.2)) {
    atmosphere::FogLayer cloud;
    cloud.liquid_water_g_per_m3 = draws.scaled(1e-4, 1.0);
    cloud.base_m = draws.between(0.0, 800.0);
    cloud.top_m = cloud.base_m + draws.between(10.0, 500.0);
    weather.fog_layers = {cloud};
  }
  const double falls = draws.uniform();
  const bool rain = falls > 0.4 && falls<0.8, snow = falls> 0.7;
  if (rain) weather.rain_rate_mm_per_h = draws.scaled(1e-6, 20.0);
  if (snow) {
    weather.snow_rate_mm_per_h = draws.scaled(1e-6, 5.0);
    // Beyond 40 GHz the law of its echo ends.
    double& frequency_Hz = scene.sensor().waveform.frequency_Hz;
    frequency_Hz = std::min(frequency_Hz, 39e9);
  }
  if (rain && snow) {
    weather.melting_layer = true;
    weather.melting_height_m = draws.between(0.0, 600.0);
  } else {
    weather.rain_top_m = draws.between(50.0, 2000.0);
  }
  if (!lobes_move_rays(scene.sensor().antenna) && draws.chance(0.2)) {
    scenes::RainCellDescription shower;
    shower.at = draw_spot(draws, scene.sensor().range.maximum_m());
    shower.cell.radius_m = draws.between(50.0, 1000.0);
    shower.cell.rain_rate_mm_per_h = draws.scaled(1e-5, 20.0);
    scene.description.rain_cells = {shower};
  }
  scene.description.surface_state = static_cast<materials::SurfaceState>(draws.whole(0, 1));
}

// Of a scene whose weather and sensor are drawn.
inline void draw_ground(Draws& draws, EffectScene& scene) {
  scenes::SceneDescription& to = scene.description;
  const double reach_m = to.sensor.range.maximum_m();
  scenes::TerrainDescription& terrain = to.terrain;
  terrain.spacing_m = std::max(reach_m / 30.0, 10.0);
  terrain.east_m = terrain.north_m = terrain.spacing_m * 36.0;
  terrain.west_m = terrain.south_m = -terrain.east_m;
  if (draws.chance(0.1)) terrain.material = "pool";
  const bool level = lobes_move_rays(to.sensor.antenna);
  if (!level && draws.chance(0.7)) {
    terrain.source = scenes::TerrainDescription::Source::rolling;
    terrain.relief_m = draws.between(0.0, 80.0);
    terrain.fields = {"moor"};
    terrain.wood_material = draws.chance(0.3) ? "slab" : "moor";
    terrain.airfield_material = "moor";
    terrain.wood_share = draws.between(0.0, 0.4);
    terrain.field_size_m = 1000.0;
    terrain.seed = static_cast<std::uint64_t>(draws.whole(1, 1000000));
  }
  for (int i = !level && draws.chance(0.4) ? draws.whole(1, 3) : 0; i > 0; --i) {
    scenes::BoxDescription box;
    box.at = draw_spot(draws, reach_m);
    box.length_m = draws.between(5.0, 60.0);
    box.width_m = draws.between(5.0, 60.0);
    box.height_m = draws.between(3.0, 60.0);
    box.heading_rad = draws.between(0.0, 3.0);
    box.wall_material = draws.chance(0.3) ? "pool" : "slab";
    box.roof_material = "slab";
    to.boxes.push_back(box);
  }
  for (int i = draws.chance(0.3) ? draws.whole(1, 2) : 0; i > 0; --i) {
    scenes::TargetDescription target;
    target.rcs = materials::ConstantRcs{draws.scaled(1e-6, 1e3)};
    target.swerling = static_cast<core::Swerling>(draws.whole(0, 4));
    const double up_m = draws.between(0.5, 40.0);
    target.path = {{0.0, draw_spot(draws, reach_m), up_m}};
    if (draws.chance(0.5)) target.path.push_back({2.0, draw_spot(draws, reach_m), up_m});
    to.targets.push_back(target);
  }
}

// A standing sensor, or an approach at some speed.
inline void draw_flight(Draws& draws, EffectScene& scene) {
  scenes::SceneDescription& to = scene.description;
  const double reach_m = to.sensor.range.maximum_m();
  // The decision height of an approach is a kilometre before the threshold.
  if (lobes_move_rays(to.sensor.antenna) || reach_m < 2000.0 || draws.chance(0.4)) {
    to.trajectory.above_ground_m = draws.between(20.0, 300.0);
    to.trajectory.pitch_rad = core::radians(draws.between(-5.0, 5.0));
    to.trajectory.roll_rad = core::radians(draws.between(-15.0, 15.0));
    return;
  }
  const double metre_rad = core::radians(1.0) / 111267.0;
  scenes::RunwayDescription runway;
  for (const int end : {0, 1}) {
    runway.ends[end].name = end == 0 ? "36" : "18";
    runway.ends[end].pavement_end = {core::radians(52.0) + end * 0.4 * reach_m * metre_rad,
                                     core::radians(10.0), 0.0};
  }
  runway.surface = runway.shoulder_material = runway.marking_material = "slab";
  runway.markings = runway.edge_lights = false;
  runway.strip_half_width_m = runway.width_m;
  to.runways = {runway};
  to.trajectory.kind = scenes::TrajectoryDescription::Kind::ils;
  to.trajectory.ils_end = "36";
  to.trajectory.ils.start_distance_m = reach_m * draws.between(0.75, 0.9);
  to.trajectory.ils.speed_mps = draws.between(40.0, 110.0);
  to.trajectory.ils.end = scenes::ApproachEnd::decision_height;
}

}  // namespace detail

inline void draw_scene(std::uint64_t seed, EffectScene& scene) {
  Draws draws(seed);
  detail::draw_sensor(draws, scene.sensor());
  detail::draw_weather(draws, scene);
  detail::draw_ground(draws, scene);
  detail::draw_flight(draws, scene);
  scene.description.sample = draws.chance(0.25);
}

}  // namespace fanbeam::tests
