// What a CIGI host says of weather, ground, sensor and view, until it comes into force with the next
// frame.
//
// Weather Control with scope global: ground fog (layer 0), rain (4) and snow (5). Water in g/m3 counts
// where it is above 0: of fog itself, of rain by Marshall and Palmer (1948) in the form W = 0.072 R^0.88
// (R in mm/h). Else fog has its visibility, and rain and snow a rate by severity 1 to 5: rain 1, 3, 8,
// 20, 50, snow 0.5, 1, 2, 4, 8 mm/h. Atmosphere Control sets temperature, humidity and pressure.
// Terrestrial Surface Conditions with scope global: 0 dry, 1 wet, 2 dry snow, 3 wet snow.
// Sensor Control: the scene's own levels are gain 0.5 and level 0.5. Gain g gives the display a span of
// 4^(0.5 - g) times its own, level l moves it by (0.5 - l) of it: brighter above 0.5; a display of mapping
// "seed" has no levels to set. Noise n multiplies the noise figure by 10^(2 n): 0 to 20 dB.
// Components of class sensor (3): 1 tilt, state 1 with the angle in degrees as a float in the first
// word, state 0 the scene's own; 2 stabilisation, state 1 on and 0 off; 3 the C-scope's heights,
// state 0 true elevation, 1 flat earth, 2 shadow. Event Notification tells each that is in force, of
// several of one component between two frames the last: the component as event, its instance, state and the host's
// frame as data.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "feeds/cigi/host_packets.h"
#include "feeds/cigi/ig_packets.h"
#include "live/cigi_view.h"
#include "scenes/scene.h"
#include "session/session.h"

namespace fanbeam::live {

class CigiConditions {
 public:
  // What was asked for since the last time.
  struct Changes {
    std::optional<atmosphere::Weather> weather;
    std::optional<materials::SurfaceState> surfaces;
    std::optional<session::SensorSettings> sensor;
    std::vector<feeds::cigi::Event> events;     // to be told once it is in force
    session::SensorSettings sensor_in_force{};  // of the host's
    bool is_reset = false;                      // sensor_in_force is not set yet
  };
  // Those that ask for conditions.
  using Packet = std::variant<feeds::cigi::ViewDefinition, feeds::cigi::AtmosphereControl,
                              feeds::cigi::WeatherControl, feeds::cigi::SurfaceConditions,
                              feeds::cigi::SensorControl, feeds::cigi::ComponentControl>;
  // Gives why not, where it is refused.
  using TrySensor = std::function<std::optional<std::string>(const session::SensorSettings&)>;

  // `own`: the scene as it was opened.
  explicit CigiConditions(const scenes::Scene& own);

  // The scene's own, all of it.
  void reset();
  // Each gives false for a packet that means nothing here, or tells what the protocol has not: severity beyond 5,
  // water below 0, gain, level and noise beyond 0 to 1. That changes nothing.
  bool take(const feeds::cigi::WeatherControl& packet);
  bool take(const feeds::cigi::AtmosphereControl& packet);
  bool take(const feeds::cigi::SurfaceConditions& packet);
  bool take(const feeds::cigi::SensorControl& packet);
  bool take(const feeds::cigi::ComponentControl& packet, std::uint32_t host_frame);
  void take(const feeds::cigi::ViewDefinition& packet);

  // Behind the packets of a message: the weather that they make together. Where that cannot be, they are
  // taken one by one, and those left out that it cannot be with; why is returned. A host's first packet
  // changes the weather of `now`, later ones what the host made of it.
  std::vector<std::string> settle(const scenes::Scene& now);

  Changes changes();
  // The sensor of what changes() gave, all at once, or what of it can be: then sensor_in_force and the events
  // are those that came into force. Gives why the rest was refused.
  static std::vector<std::string> try_sensor(Changes& changes, const TrySensor& try_to);
  // Behind try_sensor(). What was refused is forgotten, or it would be refused again with all that comes later.
  void settle(const Changes& tried);
  // As it was asked for last: in force with the next frame, as changes() are.
  const CigiView& view() const { return view_; }
  // Of a sensor whose host asked for its tracker.
  const std::optional<feeds::cigi::SensorResponse>& response() const { return response_; }

 private:
  using Edit = std::function<void(atmosphere::Weather&)>;

  // Gives false where the display has none to set and they are not its own.
  bool set_levels(double gain, double level);

  atmosphere::Weather own_weather_;
  materials::SurfaceState own_surfaces_;
  sensors::Sensor own_sensor_;
  std::vector<Edit> edits_;                     // of the message
  std::optional<atmosphere::Weather> weather_;  // the host's, once it said anything
  Changes changes_;
  session::SensorSettings sensor_, sensor_in_force_;  // the host's
  CigiView view_;
  std::optional<feeds::cigi::SensorResponse> response_;
};

}  // namespace fanbeam::live
