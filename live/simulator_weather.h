// The simulator's weather for the radar: fog, rain and snow.
//
// Simulators tell how thick rain and snow are drawn, from 0 to 1: thirds are light, moderate and heavy.
// These become rates by a power law through the classes of WMO-No. 8 (2018), part I, chapter 14
// (rain: light below 2.5 mm/h, moderate to 10, heavy to 50; snow, as water: below 1, to 5, more):
//   rain 22 n^2.7 mm/h (light 1.1, moderate 7.4, heavy 22), snow 7 n^2.2 mm/h (0.6, 2.9, 7)
// What cannot be (n beyond 0 to 1, say) is not told: feeds/aircraft_state.h. So a rate is good to its class, a factor of two or more.
// Fog is there below 1000 m of visibility (WMO's definition), with the water that the scene's fog
// model gives it; haze and what rain takes of the view is none. Where both fall, what falls more
// counts: dry snow has no rain beside it, unless the scene has a melting layer between them (atmosphere/weather.h).
// What a protocol does not tell stays as it is, but for rain or snow that cannot be beside what it tells to fall.
#pragma once

#include <optional>
#include <string>

#include "atmosphere/weather.h"
#include "feeds/aircraft_state.h"
#include "live/desk.h"
#include "live/feed.h"

namespace fanbeam::live {

// The body of a POST to /api/weather, numbers to two digits: what changes less changes no picture. What
// the state does not tell is as in `now`, or nothing.
std::string weather_body(const feeds::AircraftState& state, const atmosphere::Weather& now = {});

// Sets what `feed` says through `desk`, as often as a person would: at most every two seconds, and
// only what the simulator changed, so that what is set by hand stands until then. The scene's own
// weather counts before the first packet. Both must outlive it.
class SimulatorWeather {
 public:
  SimulatorWeather(const Desk& desk, const Feed& feed) : desk_(desk), feed_(feed) {}
  void follow(Clock::time_point now = Clock::now());
  // Why the scene cannot have what the simulator says now (fog in too cold an air); it keeps what it had.
  const std::string& refusal() const { return refusal_; }

 private:
  const Desk& desk_;
  const Feed& feed_;
  std::string told_, refusal_;
  std::optional<Clock::time_point> last_;
};

}  // namespace fanbeam::live
