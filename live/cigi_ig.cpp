#include "live/cigi_ig.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "feeds/aircraft_state.h"
#include "live/cigi_answers.h"
#include "live/feed.h"
#include "terrain/geoid.h"

namespace fanbeam::live {
namespace {

namespace cigi = feeds::cigi;

constexpr std::int8_t kOwnDatabase = 1, kNoDatabase = -128;
constexpr std::size_t kMostEntities = 4096, kMostAsked = 1024, kMostPeriodic = 1024;
constexpr std::size_t kDatagram_bytes = 1400;  // stays whole on any network
constexpr std::chrono::seconds kPatience(5);   // with a host that is silent

// Of severity 0 to 5.
constexpr std::array<double, 6> kRain_mm_per_h{0.0, 1.0, 3.0, 8.0, 20.0, 50.0};
constexpr std::array<double, 6> kSnow_mm_per_h{0.0, 0.5, 1.0, 2.0, 4.0, 8.0};

double by_severity(const std::array<double, 6>& rates, std::uint8_t severity) {
  return rates[std::min<std::size_t>(severity, rates.size() - 1)];
}

double marshall_palmer_mm_per_h(double water_g_per_m3) {
  return std::pow(water_g_per_m3 / 0.072, 1.0 / 0.88);
}

// Later, in numbers that begin again after the largest.
bool is_later(std::uint32_t frame, std::uint32_t than) {
  return static_cast<std::int32_t>(frame - than) > 0;
}

core::Attitude enabled(const cigi::ViewControl& view) {
  const auto part = [&](unsigned bit, double angle_rad) {
    return (view.enables >> bit & 1U) != 0U ? angle_rad : 0.0;
  };
  return {part(3, view.attitude.roll_rad), part(4, view.attitude.pitch_rad),
          part(5, view.attitude.heading_rad)};
}

glm::dvec3 enabled_offset_m(const cigi::ViewControl& view) {
  glm::dvec3 offset_m{0.0};
  for (int axis = 0; axis < 3; ++axis)
    if ((view.enables >> axis & 1) != 0) offset_m[axis] = view.offset_m[axis];
  return offset_m;
}

}  // namespace

CigiIg::CigiIg(session::Session& session, core::VerticalDatum datum, std::size_t kept)
    : session_(session),
      datum_(datum_of(session.scene()->description, datum)),
      own_{session.scene()->weather, session.scene()->description.surface_state},
      mailbox_(kept) {}

void CigiIg::turn_away() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++messages_;
  ++foreign_;
}

std::string CigiIg::host() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return host_;
}

// Whether a message is of the host and the next one; a host that was silent may begin anywhere.
bool CigiIg::follows(const cigi::IgControl& control, const std::string& host,
                     Clock::time_point arrived) {
  const bool silent = !heard_ || arrived - *heard_ > kPatience;
  if (!silent && host != host_) {
    ++foreign_;
    return false;
  }
  constexpr std::chrono::seconds kRestart(1);
  if (!silent && !is_later(control.host_frame, control_.host_frame) &&
      arrived - *heard_ < kRestart) {
    ++late_;
    return false;
  }
  host_ = host;
  heard_ = arrived;
  return true;
}

void CigiIg::take(std::span<const std::uint8_t> datagram, const std::string& host,
                  Clock::time_point arrived) {
  cigi::MessageFault fault{};
  const auto message = cigi::decode_host_message(datagram, fault);
  std::optional<core::Pose> pose;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++messages_;
    if (!message) {
      ++faults_[static_cast<std::size_t>(fault)];
      return;
    }
    if (!follows(message->control, host, arrived)) return;
    enter(message->control.mode);
    control_ = message->control;
    nonfinite_ += message->nonfinite;
    for (const std::uint8_t id : message->passed_over) ++passed_over_[id];
    const double time_s = control_.timestamp_valid ? 1e-5 * control_.timestamp_10us
                                                   : seconds_between(begin_, arrived);
    for (const cigi::HostPacket& packet : message->packets) take(packet, time_s);
    if (control_.mode == cigi::Mode::operate) pose = sensor_pose();
  }
  if (pose) mailbox_.put(*pose, {datagram.begin(), datagram.end()}, arrived);
}

void CigiIg::enter(cigi::Mode mode) {
  if (mode == cigi::Mode::operate && control_.mode == cigi::Mode::standby) wanted_ = own_;
  if (mode != cigi::Mode::standby || control_.mode == cigi::Mode::standby) return;
  entities_.clear();
  periodic_.clear();
  asked_.clear();
}

void CigiIg::take(const cigi::HostPacket& packet, double time_s) {
  if (const auto* entity = std::get_if<cigi::EntityControl>(&packet)) {
    place(*entity, time_s);
  } else if (const auto* rate = std::get_if<cigi::RateControl>(&packet)) {
    const auto known = entities_.find(rate->entity);
    if (rate->of_part || known == entities_.end()) return;
    known->second.v_N_mps = rate->body_axes ? known->second.pose.q_NB * rate->v_mps : rate->v_mps;
  } else if (const auto* view = std::get_if<cigi::ViewControl>(&packet)) {
    view_ = *view;
  } else if (const auto* layer = std::get_if<cigi::WeatherControl>(&packet)) {
    set(*layer);
  } else if (const auto* air = std::get_if<cigi::AtmosphereControl>(&packet)) {
    if (!air->enabled) return;
    weather().temperature_C = air->temperature_C;
    weather().humidity = 0.01 * air->humidity_percent;
    weather().pressure_hPa = air->pressure_hPa;
  } else if (const auto* ground = std::get_if<cigi::SurfaceConditions>(&packet)) {
    if (ground->scope == 0 && ground->condition <= 3)
      wanted_.surfaces =
          ground->enabled ? static_cast<materials::SurfaceState>(ground->condition) : own_.surfaces;
  } else if (const auto* height = std::get_if<cigi::HeightRequest>(&packet)) {
    ask(*height, height->update_period);
  } else if (const auto* sight = std::get_if<cigi::SightRequest>(&packet)) {
    ask(*sight, sight->update_period);
  }
}

void CigiIg::place(const cigi::EntityControl& packet, double time_s) {
  constexpr std::uint8_t kActive = 1;
  if (packet.state != kActive) {
    entities_.erase(packet.entity);
    return;
  }
  const bool possible = feeds::is_on_earth(packet.place.x, packet.place.y, packet.place.z);
  // What is attached to another entity is no aircraft.
  if (packet.attached || !possible || entities_.size() >= kMostEntities) return;
  Entity now;
  now.time_s = time_s;
  now.pose.position = {packet.place.x, packet.place.y, packet.place.z};
  now.pose.position.height_m = terrain::ellipsoidal_height_m(now.pose.position, datum_);
  now.pose.q_NB = core::quaternion_from(packet.attitude);
  const auto before = entities_.find(packet.entity);
  constexpr double kMostApart_s = 1.0, kFastest_mps = 2000.0;
  if (before != entities_.end()) {
    const double apart_s = time_s - before->second.time_s;
    const auto scene = session_.scene();
    const glm::dvec3 moved_m = scene->frame.to_local_m(now.pose.position) -
                               scene->frame.to_local_m(before->second.pose.position);
    if (apart_s > 0.0 && apart_s < kMostApart_s && glm::length(moved_m) < kFastest_mps * apart_s)
      now.pose.v_N_mps = moved_m / apart_s * scene->frame.north_east_down_at(now.pose.position);
  }
  entities_[packet.entity] = now;
}

void CigiIg::ask(const Question& question, std::uint8_t period) {
  const std::uint16_t number = std::visit([](const auto& one) { return one.request; }, question);
  const Asked asked{question, control_.host_frame};
  const auto key = std::pair(question.index(), number);
  if (period == 0) {
    periodic_.erase(key);
    if (asked_.size() < kMostAsked)
      asked_.push_back(asked);
    else
      ++unanswered_;
  } else if (periodic_.size() < kMostPeriodic || periodic_.count(key) > 0) {
    periodic_[key] = {asked, period};
  } else {
    ++unanswered_;
  }
}

atmosphere::Weather& CigiIg::weather() {
  if (!wanted_.weather) wanted_.weather = session_.scene()->weather;
  return *wanted_.weather;
}

void CigiIg::set(const cigi::WeatherControl& packet) {
  constexpr std::uint8_t kFog = 0, kRain = 4, kSnow = 5;
  if (packet.scope != 0 ||
      (packet.layer != kFog && packet.layer != kRain && packet.layer != kSnow)) {
    ++passed_over_[12];
    return;
  }
  atmosphere::Weather& now = weather();
  const double water = packet.enabled ? std::max(packet.aerosol_g_per_m3, 0.0) : 0.0;
  const std::uint8_t severity = packet.enabled ? packet.severity : std::uint8_t{0};
  if (packet.layer == kRain) {
    now.rain_rate_mm_per_h =
        water > 0.0 ? marshall_palmer_mm_per_h(water) : by_severity(kRain_mm_per_h, severity);
  } else if (packet.layer == kSnow) {
    now.snow_rate_mm_per_h = by_severity(kSnow_mm_per_h, severity);
  } else {
    now.visibility_m.reset();
    now.liquid_water_g_per_m3.reset();
    if (water > 0.0)
      now.liquid_water_g_per_m3 = water;
    else if (packet.enabled)
      now.visibility_m = packet.visibility_m;
    if (packet.enabled && packet.thickness_m > 0.0)
      now.fog_top_m =
          packet.base_m + packet.thickness_m - session_.scene()->weather.origin_height_m;
  }
}

std::optional<core::Pose> CigiIg::entity_pose(std::uint16_t entity) const {
  const auto known = entities_.find(entity);
  if (known == entities_.end()) return std::nullopt;
  core::Pose pose = known->second.pose;
  if (known->second.v_N_mps) pose.v_N_mps = *known->second.v_N_mps;
  return pose;
}

std::optional<core::Pose> CigiIg::sensor_pose() const {
  std::optional<core::Pose> pose = entity_pose(view_.entity);
  if (!pose) return std::nullopt;
  const glm::dvec3 offset_m = enabled_offset_m(view_);
  if (offset_m != glm::dvec3(0.0)) {
    const auto scene = session_.scene();
    pose->position = scene->frame.to_geodetic(scene->frame.to_local_m(pose->position) +
                                              scene->frame.north_east_down_at(pose->position) *
                                                  (pose->q_NB * offset_m));
  }
  pose->q_NB = pose->q_NB * core::quaternion_from(enabled(view_));
  return pose;
}

std::vector<std::uint8_t> CigiIg::answer(const scenes::Scene& scene, const Asked& asked) const {
  if (const auto* height = std::get_if<cigi::HeightRequest>(&asked.question))
    return cigi::height_response(height_answer(scene, datum_, *height, entity_pose(height->entity)),
                                 asked.host_frame);
  const auto& sight = std::get<cigi::SightRequest>(asked.question);
  return cigi::sight_response(sight_answer(scene, datum_, sight, entity_pose(sight.entity)),
                              asked.host_frame);
}

void CigiIg::apply(const Wanted& wanted) {
  try {
    if (wanted.weather) session_.set(*wanted.weather);
    if (wanted.surfaces) session_.set(*wanted.surfaces);
  } catch (const core::InputError& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    refusal_ = core::to_string(error.problems().front());
  }
}

std::vector<std::uint8_t> CigiIg::start_of_frame(Clock::time_point now) {
  cigi::StartOfFrame told;
  const bool ours = control_.database == 0 || control_.database == kOwnDatabase;
  told.database = ours ? kOwnDatabase : kNoDatabase;
  told.mode = control_.mode;
  told.minor_version = std::min<std::uint8_t>(control_.minor_version, 3);
  told.ig_frame = ++ig_frame_;
  told.timestamp_10us = static_cast<std::uint32_t>(
      static_cast<std::uint64_t>(1e5 * seconds_between(begin_, now)) & 0xffffffffU);
  told.last_host_frame = control_.host_frame;
  return cigi::start_of_frame(told);
}

std::vector<std::uint8_t> CigiIg::begin_frame(Clock::time_point now) {
  Wanted wanted;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::swap(wanted, wanted_);
  }
  apply(wanted);
  const auto scene = session_.scene();
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::uint8_t> message = start_of_frame(now);
  const auto append = [&](const std::vector<std::uint8_t>& packet) {
    message.insert(message.end(), packet.begin(), packet.end());
  };
  if (!refusal_.empty()) append(cigi::ig_message(1, refusal_));
  refusal_.clear();
  for (auto& [key, periodic] : periodic_)
    if (ig_frame_ % periodic.second == 0 && asked_.size() < kMostAsked)
      asked_.push_back({periodic.first.question, control_.host_frame});
  constexpr std::size_t kLargestAnswer_bytes = 56;
  while (!asked_.empty() && message.size() + kLargestAnswer_bytes <= kDatagram_bytes) {
    append(answer(*scene, asked_.front()));
    asked_.pop_front();
  }
  return message;
}

void CigiIg::tell(Status& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.packets = messages_;
  status.bad_packets.clear();
  const auto add = [&](std::string reason, std::uint64_t count) {
    if (count > 0) status.bad_packets.emplace_back(std::move(reason), count);
  };
  for (std::size_t i = 1; i < faults_.size(); ++i)
    add(cigi::name_of(static_cast<cigi::MessageFault>(i)), faults_[i]);
  add("from no peer, or a second host", foreign_);
  add("late, or come twice", late_);
  status.unused_packets.clear();
  const auto unused = [&](std::string name, std::uint64_t count) {
    if (count > 0) status.unused_packets.emplace_back(std::move(name), count);
  };
  for (std::size_t id = 0; id < passed_over_.size(); ++id)
    unused(std::string(cigi::packet_name(static_cast<std::uint8_t>(id))) + " (" +
               std::to_string(id) + ")",
           passed_over_[id]);
  unused("with a number that is not finite", nonfinite_);
  unused("questions beyond 1024 at a time", unanswered_);
}

}  // namespace fanbeam::live
