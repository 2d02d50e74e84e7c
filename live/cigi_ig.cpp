#include "live/cigi_ig.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>
#include <variant>

#include "core/errors.h"
#include "live/cigi_answers.h"
#include "live/feed.h"

namespace fanbeam::live {
namespace {

namespace cigi = feeds::cigi;

constexpr std::int8_t kNoDatabase = -128;
// Messages whose conditions wait: as many as poses do. Those beyond are in force early.
constexpr std::size_t kMostSaid = Mailbox::kKeptInLockstep;
constexpr std::size_t kDatagram_bytes = 1400;  // stays whole on any network
constexpr std::chrono::seconds kPatience(5);   // with a host that is silent
constexpr double kAnyNumber_s = 1.0;           // of silence, after which any frame number counts
// A message's number is at most so far ahead of the last one's, or as far as goes with the time since; one that
// is farther back was not late, its host began anew.
constexpr double kMostAhead = 60.0, kMostFrames_Hz = 1000.0;
constexpr std::int64_t kMostLate = 60;

template <class... Each>
struct Overloaded : Each... {
  using Each::operator()...;
};
template <class... Each>
Overloaded(Each...) -> Overloaded<Each...>;  // clang 14 asks for it

void append(std::vector<std::uint8_t>& message, const std::vector<std::uint8_t>& packet) {
  message.insert(message.end(), packet.begin(), packet.end());
}

// How many frames later, in numbers that begin again after the largest.
std::int64_t frames_ahead(std::uint32_t frame, std::uint32_t than) {
  return static_cast<std::int32_t>(frame - than);
}

// Whether a host sends that number next, so many seconds after the other: it may have left some out.
bool is_next(std::uint32_t frame, std::uint32_t than, double waited_s) {
  const std::int64_t frames = frames_ahead(frame, than);
  return frames > 0 &&
         static_cast<double>(frames) <= std::max(kMostAhead, kMostFrames_Hz * waited_s);
}

}  // namespace

CigiIg::CigiIg(session::Session& session, core::VerticalDatum datum, bool lockstep,
               const CigiStation& station)
    : session_(session),
      datum_(datum_of(session.scene()->description, datum)),
      mailbox_(lockstep),
      station_(station),
      entities_(datum_),
      letter_(lockstep ? 0 : std::numeric_limits<std::uint64_t>::max()),
      made_(letter_),
      conditions_(*session.scene()) {}

void CigiIg::turn_away() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++messages_;
  ++foreign_;
}

std::string CigiIg::host() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return station_.host;
}

// One that was silent leaves its place to any other.
bool CigiIg::is_of_host(const std::string& host, Clock::time_point arrived) {
  if (!station_.heard || arrived - *station_.heard > kPatience) station_.host = host;
  if (host == station_.host) return true;
  ++foreign_;
  return false;
}

void CigiIg::take(std::span<const std::uint8_t> datagram, const std::string& host,
                  Clock::time_point arrived) {
  cigi::MessageFault fault{};
  auto message = cigi::decode_host_message(datagram, fault);
  const std::lock_guard<std::mutex> lock(mutex_);
  ++messages_;
  if (!message)
    ++faults_[static_cast<std::size_t>(fault)];
  else if (is_of_host(host, arrived))
    take({std::move(*message), {datagram.begin(), datagram.end()}, arrived});
}

// The next message, one that waits, or none.
void CigiIg::take(Heard heard) {
  const std::uint32_t frame = heard.message.control.host_frame, last = station_.control.host_frame;
  const double waited_s =
      station_.heard ? seconds_between(*station_.heard, heard.arrived) : kAnyNumber_s;
  const bool goes_on = waited_s >= kAnyNumber_s || is_next(frame, last, waited_s);
  if (!goes_on && frames_ahead(frame, last) <= 0 && frames_ahead(frame, last) >= -kMostLate) {
    ++late_;
    return;
  }
  const double jumped_for_s =
      jumped_ ? seconds_between(jumped_->arrived, heard.arrived) : kAnyNumber_s;
  const bool after_jump = jumped_for_s < kAnyNumber_s &&
                          is_next(frame, jumped_->message.control.host_frame, jumped_for_s);
  if (!goes_on && !after_jump) {
    if (jumped_) ++jumps_;
    jumped_ = std::move(heard);
    return;
  }
  if (after_jump)
    heed(*jumped_);
  else if (jumped_)
    ++jumps_;
  jumped_.reset();
  heed(heard);
}

void CigiIg::heed(const Heard& heard) {
  const cigi::HostMessage& message = heard.message;
  station_.heard = heard.arrived;
  Said said{mailbox_.count(), message.control.host_frame, enter(message.control.mode)};
  station_.control = message.control;
  if (station_.control.database != refused_) refused_ = 0;
  nonfinite_ += message.nonfinite;
  unplaced_ = message.unplaced;
  for (const std::uint8_t id : message.passed_over) ++passed_over_[id];
  std::optional<double> clock_s;
  if (station_.control.timestamp_valid) clock_s = 1e-5 * station_.control.timestamp_10us;
  const double time_s = clock_s.value_or(seconds_between(station_.begin, heard.arrived));
  const auto scene = session_.scene();
  for (const cigi::HostPacket& packet : message.packets) take(packet, time_s, scene->frame, said);
  // Also where it stands before the Entity Control that makes its entity known.
  for (const cigi::HostPacket& packet : message.packets)
    if (const auto* const rate = std::get_if<cigi::RateControl>(&packet)) entities_.move(*rate);
  if (said.reset || !said.packets.empty()) said_.push_back(std::move(said));
  heed_said(*scene);
  if (station_.control.mode != cigi::Mode::operate ||
      std::find(unplaced_.begin(), unplaced_.end(), view_.entity) != unplaced_.end())
    return;
  if (const auto pose = entities_.pose(view_, scene->frame))
    mailbox_.put(*pose, heard.datagram, heard.arrived, clock_s);
}

void CigiIg::place(const cigi::EntityControl& packet, double time_s,
                   const terrain::LocalFrame& frame) {
  const CigiEntities::Placed placed = entities_.place(packet, time_s, frame);
  if (placed == CigiEntities::Placed::impossible) ++impossible_;
  if (placed == CigiEntities::Placed::too_many) ++too_many_;
  if (placed != CigiEntities::Placed::yes) unplaced_.push_back(packet.entity);
}

// Gives whether conditions are to be reset too. What the host says from then on counts, in standby too.
bool CigiIg::enter(cigi::Mode mode) {
  if (mode != cigi::Mode::standby || station_.control.mode == cigi::Mode::standby) return false;
  entities_.clear();
  questions_.clear();
  view_ = {};
  host_time_.clear();
  return true;
}

void CigiIg::count_unless(bool means_something, std::uint8_t id) {
  if (!means_something) ++passed_over_[id];
}

void CigiIg::take(const cigi::HostPacket& packet, double time_s, const terrain::LocalFrame& frame,
                  Said& said) {
  std::visit(Overloaded{
                 [&](const cigi::EntityControl& one) { place(one, time_s, frame); },
                 [](const cigi::RateControl&) {},  // behind the others
                 [&](const cigi::ViewControl& one) { view_ = one; },
                 [&](const cigi::CelestialControl& one) { count_unless(set(one), 9); },
                 [&](const cigi::HeightRequest& one) { questions_.ask(one, said.host_frame); },
                 [&](const cigi::SightRequest& one) { questions_.ask(one, said.host_frame); },
                 [&](const auto& of_conditions) { said.packets.emplace_back(of_conditions); },
             },
             packet);
}

void CigiIg::heed(const Said& said, const scenes::Scene& scene) {
  if (said.reset) conditions_.reset();
  for (const CigiConditions::Packet& packet : said.packets)
    std::visit(
        Overloaded{
            [&](const cigi::ViewDefinition& one) { conditions_.take(one); },
            [&](const cigi::AtmosphereControl& one) { count_unless(conditions_.take(one), 10); },
            [&](const cigi::WeatherControl& one) { count_unless(conditions_.take(one), 12); },
            [&](const cigi::SurfaceConditions& one) { count_unless(conditions_.take(one), 15); },
            [&](const cigi::SensorControl& one) { count_unless(conditions_.take(one), 17); },
            [&](const cigi::ComponentControl& one) {
              count_unless(conditions_.take(one, said.host_frame), one.brief ? 5 : 4);
            },
        },
        packet);
  for (const std::string& why : conditions_.settle(scene)) refuse(why);
}

bool CigiIg::set(const cigi::CelestialControl& packet) {
  const std::uint32_t month = packet.date / 1'000'000, day = packet.date / 10'000 % 100,
                      year = packet.date % 10'000;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(month), std::chrono::day(day)};
  constexpr std::uint8_t kHours = 24, kMinutes = 60;
  constexpr std::uint32_t kMonths = 12;  // more would wrap around in std::chrono
  if (!packet.valid || month > kMonths || !date.ok() || packet.hour >= kHours ||
      packet.minute >= kMinutes)
    return false;
  host_time_ =
      fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}Z", year, month, day, packet.hour, packet.minute);
  return true;
}

std::vector<std::uint8_t> CigiIg::answer(const scenes::Scene& scene,
                                         const CigiQuestions::Asked& asked) const {
  if (const auto* height = std::get_if<cigi::HeightRequest>(&asked.question))
    return cigi::height_response(
        height_answer(scene, datum_, *height, entities_.pose(height->entity)), asked.host_frame);
  const auto& sight = std::get<cigi::SightRequest>(asked.question);
  return cigi::sight_response(sight_answer(scene, datum_, sight, entities_.pose(sight.entity),
                                           entities_.pose(sight.end_entity)),
                              asked.host_frame);
}

// Of what is refused the host is told; what came with it is in force all the same.
void CigiIg::apply(CigiConditions::Changes& changes) {
  const auto try_to = [&](const auto& conditions) -> std::optional<std::string> {
    try {
      session_.set(conditions);
      return std::nullopt;
    } catch (const core::InputError& error) {
      return core::to_string(error.problems().front());
    }
  };
  std::vector<std::string> refusals;
  const auto put = [&](const auto& conditions) {
    if (!conditions) return;
    if (const auto why = try_to(*conditions)) refusals.push_back(*why);
  };
  put(changes.weather);
  put(changes.surfaces);
  const auto of_sensor = CigiConditions::try_sensor(changes, try_to);
  refusals.insert(refusals.end(), of_sensor.begin(), of_sensor.end());
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const std::string& why : refusals) refuse(why);
  conditions_.settle(changes);
  events_.insert(events_.end(), changes.events.begin(), changes.events.end());
}

// Those whose letters before are made: free-running, all.
void CigiIg::heed_said(const scenes::Scene& scene) {
  while (!said_.empty() && (said_.front().letters <= made_ || said_.size() > kMostSaid)) {
    heed(said_.front(), scene);
    said_.pop_front();
  }
}

void CigiIg::come_into_force() {
  const auto scene = session_.scene();
  CigiConditions::Changes changes;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    heed_said(*scene);
    changes = conditions_.changes();
    in_force_ = conditions_.view();
  }
  apply(changes);
}

void CigiIg::begin_letter(std::uint64_t number) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    letter_ = number;
    made_ = number - 1;  // those left out too
  }
  come_into_force();
}

std::int8_t CigiIg::wanted_database() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::int8_t wanted = station_.control.database;
  return wanted == 0 || wanted == refused_ ? station_.database : wanted;
}

void CigiIg::refuse_database(std::int8_t number, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  refused_ = number;
  refuse(why);
}

void CigiIg::refuse(const std::string& why) {
  constexpr std::size_t kMost = 8;  // a frame
  if (refusals_.size() < kMost) refusals_.push_back(why);
}

CigiStation CigiIg::station() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return station_;
}

std::int8_t CigiIg::told_database() const {
  const std::int8_t wanted = station_.control.database;
  if (wanted == 0 || wanted == station_.database) return station_.database;
  const auto& others = station_.others;
  const bool opens =
      wanted != refused_ && std::find(others.begin(), others.end(), wanted) != others.end();
  return opens ? static_cast<std::int8_t>(-wanted) : kNoDatabase;
}

std::vector<std::uint8_t> CigiIg::start_of_frame(Clock::time_point now) {
  cigi::StartOfFrame told;
  told.database = told_database();
  told.mode = station_.control.mode;
  told.minor_version = std::min<std::uint8_t>(station_.control.minor_version, 3);
  told.ig_frame = ++station_.ig_frame;
  told.timestamp_10us = static_cast<std::uint32_t>(
      static_cast<std::uint64_t>(1e5 * seconds_between(station_.begin, now)) & 0xffffffffU);
  told.last_host_frame = station_.control.host_frame;
  return cigi::start_of_frame(told);
}

std::vector<std::uint8_t> CigiIg::answers(const scenes::Scene& scene, std::size_t room_bytes) {
  constexpr std::size_t kLargestAnswer_bytes = 56;
  questions_.begin_frame(station_.ig_frame);
  std::vector<std::uint8_t> all;
  while (all.size() + kLargestAnswer_bytes <= room_bytes) {
    const auto asked = questions_.next(station_.control.host_frame);
    if (!asked) break;
    append(all, answer(scene, *asked));
  }
  return all;
}

std::vector<std::uint8_t> CigiIg::begin_frame(Clock::time_point now) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    made_ = letter_;
  }
  come_into_force();
  const auto scene = session_.scene();
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::uint8_t> message = start_of_frame(now);
  for (const std::string& why : std::exchange(refusals_, {}))
    append(message, cigi::ig_message(1, why));
  for (const cigi::Event& event : std::exchange(events_, {}))
    append(message, cigi::event_notification(event));
  if (conditions_.response())
    append(message, cigi::sensor_response(*conditions_.response(), station_.control.host_frame));
  append(message, answers(*scene, kDatagram_bytes - std::min(kDatagram_bytes, message.size())));
  return message;
}

void CigiIg::dress(LiveFrame& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  show(in_force_, frame.scene->description.sensor, frame);
}

void CigiIg::tell(Status& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.packets = messages_;
  status.host_time = host_time_;
  status.bad_packets.clear();
  const auto add = [&](std::string reason, std::uint64_t count) {
    if (count > 0) status.bad_packets.emplace_back(std::move(reason), count);
  };
  for (std::size_t i = 1; i < faults_.size(); ++i)
    add(cigi::name_of(static_cast<cigi::MessageFault>(i)), faults_[i]);
  add("from no peer, or a second host", foreign_);
  add("late, or come twice", late_);
  add("a jump of the host's frame number", jumps_);
  status.unused_packets.clear();
  const auto unused = [&](std::string name, std::uint64_t count) {
    if (count > 0) status.unused_packets.emplace_back(std::move(name), count);
  };
  for (std::size_t id = 0; id < passed_over_.size(); ++id)
    unused(std::string(cigi::packet_name(static_cast<std::uint8_t>(id))) + " (" +
               std::to_string(id) + ")",
           passed_over_[id]);
  unused("with a number that is not finite", nonfinite_);
  unused("with a position that cannot be", impossible_);
  unused("entities beyond 4096 at a time", too_many_);
  unused("questions beyond 1024 at a time", questions_.too_many());
  unused("periods of questions that still waited", questions_.periods_left_out());
}

}  // namespace fanbeam::live
