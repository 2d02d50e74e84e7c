#include "live/xplane_link.h"

#include <array>
#include <cmath>
#include <string_view>

#include "feeds/xplane.h"

namespace fanbeam::live {
namespace {

constexpr std::array<std::string_view, 2> kWeatherNames{"sim/weather/visibility_reported_m",
                                                        "sim/weather/rain_percent"};
constexpr std::int32_t kVisibility = 0, kRain = 1;
constexpr int kWeather_Hz = 1;

bool silent(const std::optional<Clock::time_point>& heard, Clock::time_point now,
            Clock::duration patience) {
  return !heard || now - *heard > patience;
}

}  // namespace

XPlaneLink::XPlaneLink(std::optional<Endpoint> simulator, double rate_Hz, Feed& feed)
    : rate_Hz_(static_cast<int>(std::ceil(rate_Hz))),
      feed_(feed),
      simulator_(std::move(simulator)),
      by_beacon_(!simulator_) {}

void XPlaneLink::take(std::span<const std::uint8_t> datagram, const Sender& from,
                      Clock::time_point arrived) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!simulator_ || from.address != simulator_->address) {
      feed_.turn_away();
      return;
    }
    if (const auto values = feeds::decode_xplane_values(datagram)) {
      for (const auto& [index, value] : *values) {
        if (index == kVisibility) feed_.tell_visibility(value);
        if (index == kRain) feed_.tell_rain(value);
        weather_heard_ = arrived;
      }
      return;
    }
  }
  if (!feed_.take(datagram, arrived)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  heard_ = arrived;
}

void XPlaneLink::take_beacon(std::span<const std::uint8_t> datagram, const Sender& from,
                             Clock::time_point arrived) {
  constexpr std::chrono::seconds kSilence(5);
  const auto beacon = feeds::decode_xplane_beacon(datagram);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!by_beacon_ || !beacon || !beacon->is_simulator || beacon->port == 0) return;
  if (simulator_ && !silent(heard_, arrived, kSilence)) return;
  if (simulator_ && simulator_->address == from.address && simulator_->port == beacon->port) return;
  simulator_ = Endpoint{from.address, beacon->port, true};
  asked_.reset();
  weather_heard_.reset();
}

std::vector<XPlaneLink::Letter> XPlaneLink::ask(int position_Hz, int weather_Hz) const {
  if (!simulator_) return {};
  std::vector<Letter> letters{{*simulator_, feeds::xplane_position_request(position_Hz)}};
  for (std::size_t i = 0; i < kWeatherNames.size(); ++i)
    letters.push_back(
        {*simulator_,
         feeds::xplane_value_request(weather_Hz, static_cast<std::int32_t>(i), kWeatherNames[i])});
  return letters;
}

std::vector<XPlaneLink::Letter> XPlaneLink::requests(Clock::time_point now) {
  constexpr std::chrono::seconds kBetween(1), kOfWeather(4);
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool due = silent(heard_, now, kBetween) || silent(weather_heard_, now, kOfWeather);
  if (!due || !silent(asked_, now, kBetween)) return {};
  asked_ = now;
  return ask(rate_Hz_, kWeather_Hz);
}

std::vector<XPlaneLink::Letter> XPlaneLink::farewell() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return ask(0, 0);
}

}  // namespace fanbeam::live
