// fanbeam's side of a talk with X-Plane: asks for its position and weather, again when the simulator was
// started anew, finds it by its beacon, and hands what comes to a Feed. Thread-safe.
//
// Weather: `sim/weather/visibility_reported_m` and `sim/weather/rain_percent` (0 to 1; there is no
// snow apart from it), as live/simulator_weather.h takes them. Datagrams of others than the simulator
// are counted as foreign. Written to the vendor's description and tried with a stand-in alone.
#pragma once

#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "live/feed.h"
#include "live/network.h"

namespace fanbeam::live {

class XPlaneLink {
 public:
  // `simulator`: nothing where its beacon is to tell. `feed` must outlive it.
  XPlaneLink(std::optional<Endpoint> simulator, double rate_Hz, Feed& feed);

  // Any bytes, from one thread.
  void take(std::span<const std::uint8_t> datagram, const Sender& from,
            Clock::time_point arrived = Clock::now());
  // A beacon's, the same. Another simulator is taken when the one before was silent for five seconds.
  void take_beacon(std::span<const std::uint8_t> datagram, const Sender& from,
                   Clock::time_point arrived = Clock::now());

  struct Letter {
    Endpoint to;
    std::vector<std::uint8_t> datagram;
  };
  // What is to be sent at `now`: requests, each second while nothing comes.
  std::vector<Letter> requests(Clock::time_point now = Clock::now());
  // That nothing more be sent here.
  std::vector<Letter> farewell() const;

 private:
  std::vector<Letter> ask(int position_Hz, int weather_Hz) const;

  int rate_Hz_;
  Feed& feed_;
  mutable std::mutex mutex_;
  std::optional<Endpoint> simulator_;
  bool by_beacon_;
  std::optional<Clock::time_point> asked_, heard_, weather_heard_;
};

}  // namespace fanbeam::live
