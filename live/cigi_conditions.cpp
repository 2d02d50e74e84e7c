#include "live/cigi_conditions.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "core/units.h"

namespace fanbeam::live {
namespace {

namespace cigi = feeds::cigi;
using Settings = session::SensorSettings;

// Components of class sensor.
constexpr std::uint16_t kTilt = 1, kStabilisation = 2, kHeights = 3;

// Of severity 0 to 5.
constexpr std::array<double, 6> kRain_mm_per_h{0.0, 1.0, 3.0, 8.0, 20.0, 50.0};
constexpr std::array<double, 6> kSnow_mm_per_h{0.0, 0.5, 1.0, 2.0, 4.0, 8.0};

double marshall_palmer_mm_per_h(double water_g_per_m3) {
  return std::pow(water_g_per_m3 / 0.072, 1.0 / 0.88);
}

bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

}  // namespace

CigiConditions::CigiConditions(const scenes::Scene& own)
    : own_weather_(own.weather),
      own_surfaces_(own.description.surface_state),
      own_sensor_(own.description.sensor) {}

void CigiConditions::reset() {
  sensor_ = sensor_in_force_ = {};
  view_ = {};
  response_.reset();
  weather_.reset();
  edits_.clear();
  changes_ = {own_weather_, own_surfaces_, sensor_, {}, sensor_in_force_, true};
}

CigiConditions::Changes CigiConditions::changes() {
  changes_.sensor_in_force = sensor_in_force_;
  return std::exchange(changes_, {});
}

std::vector<std::string> CigiConditions::try_sensor(Changes& changes, const TrySensor& try_to) {
  std::vector<std::string> refusals;
  if (!changes.sensor) return refusals;
  const Settings& asked = *changes.sensor;
  Settings& in_force = changes.sensor_in_force;
  if (!try_to(asked)) {
    in_force = asked;
    return refusals;
  }
  if (changes.is_reset)
    if (const auto why = try_to(in_force)) refusals.push_back(*why);
  // Packet by packet, as the weather is.
  const auto take = [&](std::optional<std::uint16_t> component, auto... members) {
    if (((in_force.*members == asked.*members) && ...)) return;
    Settings made = in_force;
    ((made.*members = asked.*members), ...);
    const auto why = try_to(made);
    if (!why) {
      in_force = made;
      return;
    }
    refusals.push_back(*why);
    std::erase_if(changes.events,
                  [&](const cigi::Event& event) { return event.event == component; });
  };
  take(kTilt, &Settings::boresight_elevation_rad);
  take(kStabilisation, &Settings::stabilised);
  take(kHeights, &Settings::cscope_mode);
  take(std::nullopt, &Settings::low_dB, &Settings::high_dB, &Settings::noise_figure);
  return refusals;
}

void CigiConditions::settle(const Changes& tried) {
  // Where the host was reset meanwhile, that is tried next.
  if (!tried.sensor || changes_.is_reset) return;
  sensor_in_force_ = tried.sensor_in_force;
  // What came meanwhile stays.
  const auto take_back = [&](auto member) {
    if (sensor_.*member == (*tried.sensor).*member) sensor_.*member = sensor_in_force_.*member;
  };
  take_back(&Settings::boresight_elevation_rad);
  take_back(&Settings::stabilised);
  take_back(&Settings::low_dB);
  take_back(&Settings::high_dB);
  take_back(&Settings::cscope_mode);
  take_back(&Settings::noise_figure);
  if (changes_.sensor) changes_.sensor = sensor_;
}

bool CigiConditions::take(const cigi::WeatherControl& packet) {
  constexpr std::uint8_t kFog = 0, kRain = 4, kSnow = 5;
  if (packet.scope != 0 || (packet.layer != kFog && packet.layer != kRain && packet.layer != kSnow))
    return false;
  if (packet.enabled && (packet.severity >= kRain_mm_per_h.size() || packet.aerosol_g_per_m3 < 0.0))
    return false;
  const double water = packet.enabled ? packet.aerosol_g_per_m3 : 0.0;
  const std::uint8_t severity = packet.enabled ? packet.severity : std::uint8_t{0};
  if (packet.layer == kRain) {
    const double rate_mm_per_h =
        water > 0.0 ? marshall_palmer_mm_per_h(water) : kRain_mm_per_h[severity];
    edits_.emplace_back([=](atmosphere::Weather& now) { now.rain_rate_mm_per_h = rate_mm_per_h; });
  } else if (packet.layer == kSnow) {
    const double rate_mm_per_h = kSnow_mm_per_h[severity];
    edits_.emplace_back([=](atmosphere::Weather& now) { now.snow_rate_mm_per_h = rate_mm_per_h; });
  } else {
    edits_.emplace_back([=](atmosphere::Weather& now) {
      now.visibility_m.reset();
      now.liquid_water_g_per_m3.reset();
      if (water > 0.0)
        now.liquid_water_g_per_m3 = water;
      else if (packet.enabled)
        now.visibility_m = packet.visibility_m;
      if (packet.enabled && packet.thickness_m > 0.0)
        now.fog_top_m = packet.base_m + packet.thickness_m - now.origin_height_m;
    });
  }
  return true;
}

bool CigiConditions::take(const cigi::AtmosphereControl& packet) {
  if (!packet.enabled) return false;
  edits_.emplace_back([=](atmosphere::Weather& now) {
    now.temperature_C = packet.temperature_C;
    now.humidity = 0.01 * packet.humidity_percent;
    now.pressure_hPa = packet.pressure_hPa;
  });
  return true;
}

std::vector<std::string> CigiConditions::settle(const scenes::Scene& now) {
  std::vector<std::string> refusals;
  if (edits_.empty()) return refusals;
  // Taken over where it can be; else why not.
  const auto try_with = [&](std::span<const Edit> edits) -> std::optional<std::string> {
    atmosphere::Weather made = *weather_;
    for (const Edit& edit : edits) edit(made);
    const core::ProblemList problems =
        atmosphere::problems_in(made, own_sensor_.waveform.frequency_Hz);
    for (const core::Problem& problem : problems.all())
      if (problem.is_error()) return core::to_string(problem);
    weather_ = made;
    return std::nullopt;
  };
  if (!weather_) weather_ = now.weather;
  if (try_with(edits_))
    for (const Edit& edit : edits_)
      if (const auto why = try_with({&edit, 1})) refusals.push_back(*why);
  edits_.clear();
  changes_.weather = weather_;
  return refusals;
}

bool CigiConditions::take(const cigi::SurfaceConditions& packet) {
  constexpr std::uint16_t kLast = 3;
  if (packet.scope != 0 || packet.condition > kLast) return false;
  changes_.surfaces =
      packet.enabled ? static_cast<materials::SurfaceState>(packet.condition) : own_surfaces_;
  return true;
}

bool CigiConditions::set_levels(double gain, double level) {
  constexpr double kOwn = 0.5;
  const sensors::Display& own = own_sensor_.display;
  if (own.mapping == sensors::Display::Mapping::seed) return gain == kOwn && level == kOwn;
  const double own_span_dB = own.high_dB - own.low_dB;
  const double span_dB = own_span_dB * std::pow(4.0, kOwn - gain);
  const double middle_dB = (own.low_dB + own.high_dB) / 2 + (kOwn - level) * own_span_dB;
  sensor_.low_dB = middle_dB - span_dB / 2;
  sensor_.high_dB = middle_dB + span_dB / 2;
  return true;
}

bool CigiConditions::take(const cigi::SensorControl& packet) {
  if (!is_share(packet.gain) || !is_share(packet.level) || !is_share(packet.noise)) return false;
  view_.on = packet.on;
  view_.black_hot = packet.black_hot;
  response_.reset();
  if (packet.on && packet.track_mode != 0)
    response_ = {packet.view, packet.sensor, packet.extended_response};
  sensor_.noise_figure = own_sensor_.receiver.noise_figure * std::pow(10.0, 2.0 * packet.noise);
  const bool has_levels = set_levels(packet.gain, packet.level);
  changes_.sensor = sensor_;
  return has_levels && !packet.line_dropout && !packet.automatic_gain;
}

bool CigiConditions::take(const cigi::ComponentControl& packet, std::uint32_t host_frame) {
  constexpr std::uint8_t kSensorClass = 3;
  using CScopeMode = sensors::Display::CScopeMode;
  if (packet.of != kSensorClass) return false;
  if (packet.component == kTilt && packet.state <= 1) {
    const auto tilt_deg = static_cast<double>(std::bit_cast<float>(packet.words[0]));
    if (packet.state == 1 && !(std::abs(tilt_deg) <= 90.0)) return false;
    sensor_.boresight_elevation_rad.reset();
    if (packet.state == 1) sensor_.boresight_elevation_rad = core::radians(tilt_deg);
  } else if (packet.component == kStabilisation && packet.state <= 1) {
    sensor_.stabilised = packet.state == 1;
  } else if (packet.component == kHeights && packet.state <= 2) {
    sensor_.cscope_mode = static_cast<CScopeMode>(packet.state);
  } else {
    return false;
  }
  changes_.sensor = sensor_;
  // What another one takes back before it was in force is not told; so there is one of each component at most.
  std::erase_if(changes_.events,
                [&](const cigi::Event& event) { return event.event == packet.component; });
  changes_.events.push_back({packet.component, {packet.instance, packet.state, host_frame}});
  return true;
}

void CigiConditions::take(const cigi::ViewDefinition& packet) { view_.window = packet; }

}  // namespace fanbeam::live
