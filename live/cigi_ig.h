// The image generator that a CIGI 3.3 host talks to: its messages become poses, weather and questions,
// and each frame is told to it with the answers. Thread-safe: messages come on the network's thread,
// frames on the channel's.
//
// Pose: entity 0, or the entity that the last View Control names, with that packet's offset and
// angles. Velocity is that of Rate Control, else what the last two places were apart, over the host's
// timestamps where it has them. Only in mode operate; standby lets the picture stand, and operate after
// it begins with the scene's own weather and ground again (reset).
// Weather: ground fog (layer 0), rain (4) and snow (5) of Weather Control with scope global. Water in
// g/m3 counts where it is above 0: of fog itself, of rain by Marshall and Palmer (1948) in the form
// W = 0.072 R^0.88 (R in mm/h). Else fog has its visibility, and rain and snow a rate by severity 1 to 5:
// rain 1, 3, 8, 20, 50, snow 0.5, 1, 2, 4, 8 mm/h. Atmosphere Control sets temperature, humidity and
// pressure. Terrestrial Surface Conditions with scope global: 0 dry, 1 wet, 2 dry snow, 3 wet snow.
// Questions (cigi_answers.h) are answered in the next frame, periodic ones again and again; at most
// what one datagram holds, the others in the frames after. Packets with no meaning here are counted by
// name.
//
// One host at a time: another one is turned away until the first was silent for five seconds. Messages that
// come twice or late are left out.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "feeds/cigi/host_packets.h"
#include "feeds/cigi/ig_packets.h"
#include "live/hub.h"
#include "live/mailbox.h"
#include "session/session.h"

namespace fanbeam::live {

class CigiIg {
 public:
  // The scene's own database is number 1; a host that asks for another is told -128. `kept`:
  // live/mailbox.h. `session` must outlive it.
  CigiIg(session::Session& session, core::VerticalDatum datum, std::size_t kept = Mailbox::kKept);

  // Any bytes. `host`: who sent them.
  void take(std::span<const std::uint8_t> datagram, const std::string& host,
            Clock::time_point arrived = Clock::now());
  // One that nobody asked for: counted.
  void turn_away();
  const Mailbox& mailbox() const { return mailbox_; }
  // Who is the host, as take() was told; empty before the first message.
  std::string host() const;

  // What the host asked for in weather and surfaces comes into force, then the message of a frame at
  // `now`: start of frame first. Call it before each frame.
  std::vector<std::uint8_t> begin_frame(Clock::time_point now = Clock::now());
  void tell(Status& status) const;

 private:
  using Question = std::variant<feeds::cigi::HeightRequest, feeds::cigi::SightRequest>;
  struct Asked {
    Question question;
    std::uint32_t host_frame = 0;
  };
  struct Entity {
    core::Pose pose;
    double time_s = 0.0;
    std::optional<glm::dvec3> v_N_mps;  // told
  };
  // What was asked of the conditions since the last frame.
  struct Wanted {
    std::optional<atmosphere::Weather> weather;
    std::optional<materials::SurfaceState> surfaces;
  };

  bool follows(const feeds::cigi::IgControl& control, const std::string& host,
               Clock::time_point arrived);
  void enter(feeds::cigi::Mode mode);
  void take(const feeds::cigi::HostPacket& packet, double time_s);
  void place(const feeds::cigi::EntityControl& packet, double time_s);
  void ask(const Question& question, std::uint8_t period);
  atmosphere::Weather& weather();
  void set(const feeds::cigi::WeatherControl& packet);
  std::optional<core::Pose> sensor_pose() const;
  std::optional<core::Pose> entity_pose(std::uint16_t entity) const;
  std::vector<std::uint8_t> answer(const scenes::Scene& scene, const Asked& asked) const;
  void apply(const Wanted& wanted);
  std::vector<std::uint8_t> start_of_frame(Clock::time_point now);

  session::Session& session_;
  core::VerticalDatum datum_;
  Wanted own_;  // of the scene
  Clock::time_point begin_ = Clock::now();
  Mailbox mailbox_;

  mutable std::mutex mutex_;
  std::string host_;
  std::optional<Clock::time_point> heard_;
  feeds::cigi::IgControl control_{};
  std::uint32_t ig_frame_ = 0;
  std::map<std::uint16_t, Entity> entities_;
  feeds::cigi::ViewControl view_{};
  std::deque<Asked> asked_;
  std::map<std::pair<std::size_t, std::uint16_t>, std::pair<Asked, std::uint8_t>> periodic_;
  Wanted wanted_;
  std::string refusal_;  // to be told
  std::uint64_t messages_ = 0, foreign_ = 0, late_ = 0, nonfinite_ = 0, unanswered_ = 0;
  std::array<std::uint64_t, 6> faults_{};
  std::array<std::uint64_t, 256> passed_over_{};
};

}  // namespace fanbeam::live
