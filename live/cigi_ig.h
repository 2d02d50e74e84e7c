// The image generator that a CIGI 3.3 host talks to: its messages become poses, weather and questions,
// and each frame is told to it with the answers. Thread-safe: messages come on the network's thread,
// frames on the channel's.
//
// Pose: entity 0, or the entity that the last View Control names, with that packet's offset and
// angles. Velocity is that of the last Rate Control, wherever it stood in its message, else what the last two
// places were apart, over the host's timestamps where it has them. Only in mode operate; standby lets the picture
// stand, and going there forgets what the host said: entities, questions, weather, ground, sensor and view are the
// scene's own.
// Date and time of its world go into the status; the radar sees no sun.
// Weather, ground, sensor and view: live/cigi_conditions.h. In force with the next frame; in lockstep with
// that of their own message, whatever has come behind it.
// Questions (cigi_answers.h) are answered in the next frame, periodic ones again and again; at most
// what one datagram holds, the others in the frames after, by turns (cigi_questions.h). Packets with no meaning
// here are counted by name.
//
// An entity whose place cannot be, or is not finite, gives no pose: what was told of it before is no news.
//
// One host at a time: another one is turned away until the first was silent for five seconds. Messages that
// come twice or late are left out. One whose frame number is far from the last one's waits, and counts when the
// next follows from it; so no single message, whatever its number, locks out those that follow. After a second
// of silence any number counts.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "feeds/cigi/host_packets.h"
#include "feeds/cigi/ig_packets.h"
#include "live/cigi_conditions.h"
#include "live/cigi_entities.h"
#include "live/cigi_questions.h"
#include "live/cigi_view.h"
#include "live/hub.h"
#include "live/mailbox.h"
#include "session/session.h"

namespace fanbeam::live {

// What stays while a host switches scenes.
struct CigiStation {
  std::int8_t database = 1;           // that is open
  std::vector<std::int8_t> others{};  // that may be asked for
  std::uint32_t ig_frame = 0;
  Clock::time_point begin = Clock::now();  // of timestamps
  // Whom we talk to, when it was heard, and what it said last: it may be waiting for us.
  std::string host{};
  std::optional<Clock::time_point> heard{};
  feeds::cigi::IgControl control{};
};

class CigiIg {
 public:
  // A host that asks for one of the station's other databases is told its number, negative, until it
  // is open; for any other -128. `session` must outlive it.
  CigiIg(session::Session& session, core::VerticalDatum datum, bool lockstep = false,
         const CigiStation& station = {});

  // Any bytes. `host`: who sent them.
  void take(std::span<const std::uint8_t> datagram, const std::string& host,
            Clock::time_point arrived = Clock::now());
  // One that nobody asked for: counted.
  void turn_away();
  const Mailbox& mailbox() const { return mailbox_; }
  // Who is the host, as take() was told; empty before the first message.
  std::string host() const;

  // In lockstep, before the frame of a letter of the mailbox: what the host asked for up to that one's message
  // comes into force.
  void begin_letter(std::uint64_t number);
  // What the host asked for in weather, surfaces, sensor and view comes into force, in lockstep what lies before
  // the letters that have no frame yet; then the message of a frame at `now`: start of frame first. Call it
  // before each frame, in lockstep behind it.
  std::vector<std::uint8_t> begin_frame(Clock::time_point now = Clock::now());
  // The number that the host asks for; the open one's where it leaves the choice to us, or asks for one
  // that was refused and for no other since.
  std::int8_t wanted_database() const;
  // It cannot be opened: the host is told so, and why.
  void refuse_database(std::int8_t number, const std::string& why);
  CigiStation station() const;
  // What the host wants to see of a frame, before it is shown: what came into force before the frame began, with
  // the last begin_frame() or begin_letter(). It has its scene.
  void dress(LiveFrame& frame) const;
  void tell(Status& status) const;

 private:
  struct Heard {
    feeds::cigi::HostMessage message;
    std::vector<std::uint8_t> datagram;
    Clock::time_point arrived;
  };
  // What a message asks for in conditions, until it comes into force.
  struct Said {
    std::uint64_t letters = 0;  // that came before the message's own
    std::uint32_t host_frame = 0;
    bool reset = false;  // first
    std::vector<CigiConditions::Packet> packets{};
  };
  bool is_of_host(const std::string& host, Clock::time_point arrived);
  void take(Heard heard);
  void heed(const Heard& heard);
  void place(const feeds::cigi::EntityControl& packet, double time_s,
             const terrain::LocalFrame& frame);
  bool enter(feeds::cigi::Mode mode);
  void take(const feeds::cigi::HostPacket& packet, double time_s, const terrain::LocalFrame& frame,
            Said& said);
  void count_unless(bool means_something, std::uint8_t id);
  void heed(const Said& said, const scenes::Scene& scene);
  void heed_said(const scenes::Scene& scene);
  void come_into_force();
  bool set(const feeds::cigi::CelestialControl& packet);
  std::vector<std::uint8_t> answer(const scenes::Scene& scene,
                                   const CigiQuestions::Asked& asked) const;
  void apply(CigiConditions::Changes& changes);
  std::vector<std::uint8_t> answers(const scenes::Scene& scene, std::size_t room_bytes);
  std::int8_t told_database() const;
  void refuse(const std::string& why);
  std::vector<std::uint8_t> start_of_frame(Clock::time_point now);

  session::Session& session_;
  core::VerticalDatum datum_;
  Mailbox mailbox_;

  mutable std::mutex mutex_;
  CigiStation station_;
  CigiEntities entities_;
  feeds::cigi::ViewControl view_{};
  std::optional<Heard> jumped_;          // waits
  std::vector<std::uint16_t> unplaced_;  // entities, of the message that is being heeded
  CigiQuestions questions_;
  std::deque<Said> said_;        // oldest first
  std::uint64_t letter_, made_;  // the newest whose frame was begun, and made; free-running: any
  CigiConditions conditions_;
  CigiView in_force_;                         // of the frame that is being made
  std::vector<feeds::cigi::Event> events_{};  // in force, to be told
  std::string host_time_;                     // that it says it is there, ISO 8601
  std::int8_t refused_ = 0;                   // database that cannot be opened; 0: none
  std::vector<std::string> refusals_;         // to be told
  std::uint64_t messages_ = 0, foreign_ = 0, late_ = 0, jumps_ = 0, nonfinite_ = 0;
  std::uint64_t impossible_ = 0, too_many_ = 0;
  std::array<std::uint64_t, 6> faults_{};
  std::array<std::uint64_t, 256> passed_over_{};
};

}  // namespace fanbeam::live
