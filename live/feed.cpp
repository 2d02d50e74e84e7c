#include "live/feed.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/median.h"
#include "terrain/geoid.h"

namespace fanbeam::live {
namespace {

// Heights are compared over so long, and no more often than that.
constexpr double kCompared_s = 5.0, kBetween_s = 0.05;
// Farther from one packet to the next is another flight, or too few packets to compare.
constexpr double kElsewhere_m = 2000.0;
// A packet that waits longer for the next one is no news any more.
constexpr double kTogether_s = 1.0;

using NamedCounts = std::vector<std::pair<std::string, std::uint64_t>>;

// To what other sources were counted for.
void add_count(NamedCounts& counts, const std::string& reason, std::uint64_t count) {
  if (count == 0) return;
  const auto known = std::find_if(counts.begin(), counts.end(),
                                  [&](const auto& one) { return one.first == reason; });
  if (known == counts.end())
    counts.emplace_back(reason, count);
  else
    known->second += count;
}

}  // namespace

Feed::Feed(std::shared_ptr<const scenes::Scene> scene, core::VerticalDatum datum,
           const feeds::Protocol& protocol, std::shared_ptr<Mailbox> mailbox, std::size_t source)
    : scene_(std::move(scene)),
      datum_(datum_of(scene_->description, datum)),
      protocol_(protocol),
      mailbox_(std::move(mailbox)),
      source_(source) {
  // Without the grid nothing flies: told here, not by the thread that hears the first packet.
  (void)terrain::ellipsoidal_height_m({}, datum_);
}

Feed::Heard Feed::heard(const feeds::AircraftState& state) const {
  core::Pose pose = feeds::pose_of(state);
  pose.position.height_m = terrain::ellipsoidal_height_m(pose.position, datum_);
  return {pose, protocol_.fine_clock ? std::optional(state.clock_s) : std::nullopt};
}

std::optional<Feed::Heard> Feed::heard_in(std::span<const std::uint8_t> datagram) const {
  feeds::PacketFault fault{};
  const auto state = protocol_.decode(datagram, fault);
  return state ? std::optional(heard(*state)) : std::nullopt;
}

bool Feed::take(std::span<const std::uint8_t> datagram, Clock::time_point arrived) {
  feeds::PacketFault fault{};
  const auto state = without_impossible_weather(protocol_.decode(datagram, fault));
  if (state) fault = fault_in_turn(*state, arrived);
  if (fault == feeds::PacketFault::jump) {
    settle(false);
    jumped_ = {*state, {datagram.begin(), datagram.end()}, arrived};
    return false;
  }
  count(fault);
  if (fault != feeds::PacketFault::none) return false;
  settle(jumped_ && gate_.after_jump() &&
         seconds_between(jumped_->arrived, arrived) <= kTogether_s);
  put({*state, {datagram.begin(), datagram.end()}, arrived});
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = state;
  return true;
}

feeds::PacketFault Feed::fault_in_turn(const feeds::AircraftState& state,
                                       Clock::time_point arrived) {
  const double arrived_s = std::chrono::duration<double>(arrived.time_since_epoch()).count();
  if (protocol_.fine_clock) return gate_.take(state.clock_s, arrived_s);
  const core::Pose pose = feeds::pose_of(state);
  const bool counts =
      way_gate_.take({arrived_s, scene_->frame.to_local_m(pose.position),
                      scene_->frame.north_east_down_at(pose.position) * pose.v_N_mps});
  return counts ? feeds::PacketFault::none : feeds::PacketFault::late;
}

// What waited counts, or is of no use.
void Feed::settle(bool counts) {
  if (!jumped_) return;
  count(counts ? feeds::PacketFault::none : feeds::PacketFault::jump);
  if (counts) put(*jumped_);
  jumped_.reset();
}

void Feed::put(const Taken& one) {
  const auto [pose, clock_s] = heard(one.state);
  mailbox_->put(pose, one.datagram, one.arrived, clock_s, source_);
  compare_heights(pose, one.state.height_above_ground_m, one.arrived);
}

std::optional<feeds::AircraftState> Feed::without_impossible_weather(
    std::optional<feeds::AircraftState> state) {
  const int forgotten = state ? feeds::forget_impossible_weather(*state) : 0;
  const std::lock_guard<std::mutex> lock(mutex_);
  impossible_weather_ += static_cast<std::uint64_t>(forgotten);
  return state;
}

void Feed::tell_visibility(double visibility_m) {
  feeds::AircraftState told;
  told.visibility_m = visibility_m;
  const auto possible = without_impossible_weather(told);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (possible->visibility_m) visibility_m_ = visibility_m;
}

void Feed::tell_rain(double norm) {
  feeds::AircraftState told;
  told.rain_norm = norm;
  const auto possible = without_impossible_weather(told);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (possible->rain_norm) rain_norm_ = norm;
}

void Feed::turn_away() { count(feeds::PacketFault::foreign); }

void Feed::count(feeds::PacketFault fault) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++packets_;
  ++bad_[static_cast<std::size_t>(fault)];
}

void Feed::compare_heights(const core::Pose& pose, double told_m, Clock::time_point arrived) {
  const glm::dvec3 at_m = scene_->frame.to_local_m(pose.position);
  const terrain::HeightField* const terrain = scene_->world.surfaces().terrain();
  const auto ground_m = terrain != nullptr ? terrain->height_at(at_m.x, at_m.y) : std::nullopt;
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool elsewhere = last_m_ && glm::distance(*last_m_, at_m) > kElsewhere_m;
  // One alone is a stray one.
  const bool stays = apart_m_ && glm::distance(*apart_m_, at_m) <= kElsewhere_m;
  apart_m_ = elsewhere ? std::optional(at_m) : std::nullopt;
  if (elsewhere && !stays) return;
  last_m_ = at_m;
  if (elsewhere || gate_.after_jump()) compared_.clear();
  while (!compared_.empty() && seconds_between(compared_.front().arrived, arrived) > kCompared_s)
    compared_.pop_front();
  if (!ground_m ||
      (!compared_.empty() && seconds_between(compared_.back().arrived, arrived) < kBetween_s))
    return;
  if (compared_.empty()) compared_since_ = arrived;
  compared_.push_back({arrived, told_m - (at_m.z - *ground_m)});
}

std::optional<feeds::AircraftState> Feed::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::optional<feeds::AircraftState> state = newest_;
  if (state && visibility_m_) state->visibility_m = visibility_m_;
  if (state && rain_norm_) state->rain_norm = rain_norm_;
  return state;
}

void Feed::tell(Status& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.packets += packets_;
  for (std::size_t i = 1; i < bad_.size(); ++i)
    add_count(status.bad_packets, feeds::name_of(static_cast<feeds::PacketFault>(i)), bad_[i]);
  add_count(status.unused_packets, "weather that cannot be", impossible_weather_);
}

std::optional<double> Feed::height_offset_m() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (compared_.empty() || seconds_between(compared_since_, compared_.back().arrived) < kCompared_s)
    return std::nullopt;
  std::vector<double> offsets_m;
  for (const Compared& one : compared_) offsets_m.push_back(one.offset_m);
  return core::median(std::move(offsets_m));
}

}  // namespace fanbeam::live
