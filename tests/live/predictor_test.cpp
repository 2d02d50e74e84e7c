// Poses at the middle of frames: closed forms, a recorded flight, and sources that jump.
#include "live/predictor.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "core/units.h"
#include "feeds/native_fdm.h"
#include "live/clock_gate.h"
#include "live/pose_source.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using live::Predictor;

namespace {

const core::Geodetic kOrigin{0.9, 0.2, 100.0};
const terrain::LocalFrame kFrame(kOrigin);

// A level turn to the right at 70 m/s.
core::Pose turning(double time_s, double rate_radps = 0.05) {
  const double radius_m = 70.0 / rate_radps, phase_rad = rate_radps * time_s;
  core::Pose pose;
  pose.time_s = time_s;
  pose.position = kFrame.to_geodetic(
      {radius_m * (1.0 - std::cos(phase_rad)), radius_m * std::sin(phase_rad), 300.0});
  const glm::dmat3 axes = kFrame.north_east_down_at(pose.position);
  pose.v_N_mps = 70.0 * glm::dvec3(std::sin(phase_rad), std::cos(phase_rad), 0.0) * axes;
  pose.q_NB = core::quaternion_from({0.3, 0.05, std::atan2(pose.v_N_mps.y, pose.v_N_mps.x)});
  return pose;
}

double apart_m(const core::Pose& a, const core::Pose& b) {
  return glm::distance(kFrame.to_local_m(a.position), kFrame.to_local_m(b.position));
}

double turned_rad(const core::Pose& a, const core::Pose& b) {
  const double w = std::abs((glm::conjugate(a.q_NB) * b.q_NB).w);
  return 2.0 * std::acos(std::min(w, 1.0));
}

struct Sent {
  double arrived_s = 0.0;
  core::Pose pose;
};

// Datagrams of port 5501, and what the simulator's own table says of its poses over its time.
std::vector<Sent> sent_in(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<Sent> sent;
  char head[12];
  while (stream.read(head, sizeof head)) {
    double time_s = 0.0;
    std::uint16_t length = 0;
    std::memcpy(&time_s, head, 8);
    std::memcpy(&length, head + 10, 2);
    std::vector<std::uint8_t> payload(length);
    stream.read(reinterpret_cast<char*>(payload.data()), length);
    feeds::PacketFault fault{};
    const auto packet = feeds::decode_native_fdm(payload, fault);
    REQUIRE(packet.has_value());
    sent.push_back({time_s, feeds::pose_of(*packet)});
  }
  return sent;
}

std::vector<core::Pose> table_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line, cell;
  std::getline(stream, line);
  std::vector<core::Pose> poses;
  while (std::getline(stream, line)) {
    std::vector<double> cells;
    for (std::istringstream text(line); std::getline(text, cell, ',');)
      cells.push_back(std::stod(cell));
    core::Pose pose;
    pose.time_s = cells[0];
    pose.position = {core::radians(cells[1]), core::radians(cells[2]), cells[3] * core::kFoot_m};
    pose.q_NB = core::quaternion_from(
        {core::radians(cells[6]), core::radians(cells[7]), core::radians(cells[8])});
    poses.push_back(pose);
  }
  return poses;
}

// Between two rows 1/60 s apart.
core::Pose truth_at(const std::vector<core::Pose>& table, double time_s) {
  const auto above =
      std::lower_bound(table.begin(), table.end(), time_s,
                       [](const core::Pose& pose, double time) { return pose.time_s < time; });
  REQUIRE(above != table.begin());
  REQUIRE(above != table.end());
  const core::Pose &a = *(above - 1), &b = *above;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  core::Pose pose;
  const auto mix = [share](double x, double y) { return x + share * (y - x); };
  pose.position = {mix(a.position.latitude_rad, b.position.latitude_rad),
                   mix(a.position.longitude_rad, b.position.longitude_rad),
                   mix(a.position.height_m, b.position.height_m)};
  pose.q_NB = core::interpolate(a.q_NB, b.q_NB, share);
  return pose;
}

}  // namespace

// Clocks of two simulators may look alike.
TEST_CASE("Where another source takes over, and back, the aircraft flies by that one's clock",
          "[predictor]") {
  constexpr double kSpeed_mps = 80.0, kLag_s[] = {0.01, 0.2}, kClock_s[] = {0.0, 0.1};
  live::Mailbox mailbox;
  const auto begin = live::Clock::now();
  const live::PoseSource where = live::source_of(mailbox, kFrame, begin);
  const auto put = [&](std::size_t source, double now_s) {
    const double flown_s = now_s - kLag_s[source];
    core::Pose pose;
    pose.position = kFrame.to_geodetic({0.0, kSpeed_mps * flown_s, 500.0});
    pose.v_N_mps = {kSpeed_mps, 0.0, 0.0};
    mailbox.put(pose, {},
                begin + std::chrono::duration_cast<live::Clock::duration>(
                            std::chrono::duration<double>(now_s)),
                flown_s + kClock_s[source], source);
  };
  for (int step = 1; step < 160; ++step) {
    const double now_s = 0.05 * step;
    const bool first = now_s < 3.0 || now_s > 5.0;
    if (first) put(0, now_s);
    put(1, now_s + 1e-3);
    const auto seen = where(now_s + 2e-3, now_s);
    REQUIRE(seen);
    if (now_s >= 3.0 && now_s < 3.6) continue;  // silent for half a second, then the other leads
    if (now_s >= 5.0 && now_s < 5.1) continue;  // one packet may be a stray one
    const double expected_m = kSpeed_mps * (now_s - kLag_s[first ? 0 : 1]);
    INFO(now_s);
    CHECK(kFrame.to_local_m(seen->pose.position).y == Approx(expected_m).epsilon(0.0).margin(0.3));
  }
}

TEST_CASE("Between and after two poses a steady turn goes on", "[predictor]") {
  Predictor predictor(kFrame);
  CHECK_FALSE(predictor.at(0.0).has_value());
  predictor.take(turning(0.0), 10.0);
  CHECK(apart_m(*predictor.at(10.1), turning(0.0)) == Approx(7.0).epsilon(0.01));
  predictor.take(turning(0.0625), 10.0625);
  for (const double time_s : {0.0, 0.01, 0.04, 0.0625}) {
    CHECK(apart_m(*predictor.at(10.0 + time_s), turning(time_s)) < 1e-5);
    CHECK(turned_rad(*predictor.at(10.0 + time_s), turning(time_s)) < 1e-4);
  }
  for (const double ahead_s : {0.03, 0.1, 0.25}) {
    // Constant acceleration instead of a turning one: a w t^3 / 6, a = 3.5 m/s2, w = 0.05 rad/s.
    CHECK(apart_m(*predictor.at(10.0625 + ahead_s), turning(0.0625 + ahead_s)) < 0.01);
    CHECK(turned_rad(*predictor.at(10.0625 + ahead_s), turning(0.0625 + ahead_s)) < 1e-4);
  }
  // Then it stands.
  CHECK(apart_m(*predictor.at(20.0), *predictor.at(10.0625 + Predictor::kCarriedOn_s)) == 0.0);
}

TEST_CASE("Frames of the recorded flight follow it within 0.3 m and 0.1 deg", "[predictor]") {
  const auto recording = tests::shared_data("flightgear/bikf10.bin");
  const auto file = tests::shared_data("flightgear/bikf10.csv");
  if (!recording || !file) return;
  const std::vector<Sent> sent = sent_in(*recording);
  const std::vector<core::Pose> table = table_in(*file);
  constexpr double kTouchdown_s = 124.07, kPeriod_s = 1.0 / 16.0;
  Predictor predictor(terrain::LocalFrame(sent.front().pose.position));
  const terrain::LocalFrame frame(sent.front().pose.position);

  // Frames begin at their rate, know what has arrived by then, and ask for their middle.
  std::vector<core::Pose> frames;
  std::size_t next = 0;
  for (double begin_s = sent.front().arrived_s + 1.0; begin_s < sent.back().arrived_s - 1.0;
       begin_s += kPeriod_s) {
    for (; next < sent.size() && sent[next].arrived_s <= begin_s; ++next)
      predictor.take(sent[next].pose, sent[next].arrived_s);
    frames.push_back(*predictor.at(begin_s + kPeriod_s / 2));
  }
  // One constant between the two clocks, the best of steps of a millisecond.
  const auto rms_at = [&](double delay_s) {
    double square_m2 = 0.0, square_rad2 = 0.0;
    int count = 0;
    for (const core::Pose& pose : frames) {
      const double time_s = pose.time_s + delay_s;
      if (time_s > kTouchdown_s) break;
      const core::Pose truth = truth_at(table, time_s);
      const double off_m =
          glm::distance(frame.to_local_m(pose.position), frame.to_local_m(truth.position));
      square_m2 += off_m * off_m;
      square_rad2 += std::pow(turned_rad(pose, truth), 2);
      ++count;
    }
    return std::array{std::sqrt(square_m2 / count), std::sqrt(square_rad2 / count),
                      static_cast<double>(count)};
  };
  const auto nearest =
      std::min_element(table.begin(), table.end(), [&](const core::Pose& a, const core::Pose& b) {
        const glm::dvec3 first_m = frame.to_local_m(sent.front().pose.position);
        return glm::distance(frame.to_local_m(a.position), first_m) <
               glm::distance(frame.to_local_m(b.position), first_m);
      });
  const double guess_s = nearest->time_s - sent.front().arrived_s;
  double best_s = guess_s;
  for (double delay_s = guess_s - 0.03; delay_s <= guess_s + 0.03; delay_s += 0.001)
    if (rms_at(delay_s)[0] < rms_at(best_s)[0]) best_s = delay_s;
  const auto [position_m, attitude_rad, count] = rms_at(best_s);
  UNSCOPED_INFO("delay " << best_s - guess_s << " s, " << count << " frames");
  CHECK(count > 1700);
  CHECK(position_m < 0.3);
  CHECK(core::degrees(attitude_rad) < 0.1);
}

TEST_CASE("F13 one stray pose moves nothing; a reset is followed on its second packet",
          "[predictor]") {
  Predictor predictor(kFrame);
  for (int i = 0; i < 10; ++i) predictor.take(turning(0.0625 * i), 0.0625 * i);
  core::Pose stray = turning(0.625);
  stray.position.latitude_rad += 0.01;  // 60 km
  predictor.take(stray, 0.625);
  CHECK(apart_m(*predictor.at(0.65), turning(0.65)) < 0.1);
  CHECK(*predictor.newest_s() == 0.5625);
  CHECK(predictor.strays() == 0);
  predictor.take(turning(0.6875), 0.6875);
  CHECK(apart_m(*predictor.at(0.7), turning(0.7)) < 0.1);
  CHECK(predictor.strays() == 1);

  // The simulator is put back to its start, 50 s on.
  predictor.take(turning(-40.0), 0.75);
  CHECK(apart_m(*predictor.at(0.76), turning(0.76)) < 0.1);
  predictor.take(turning(-40.0 + 0.0625), 0.8125);
  CHECK(apart_m(*predictor.at(0.8125), turning(-40.0 + 0.0625)) < 1e-6);
  CHECK(predictor.strays() == 1);

  // Alternating strays never win against each other.
  for (int i = 1; i <= 20; ++i) {
    core::Pose far = turning(-40.0);
    far.position.longitude_rad += i % 2 == 0 ? 0.02 : -0.02;
    predictor.take(far, 0.8125 + 0.01 * i);
  }
  CHECK(apart_m(*predictor.at(1.0), turning(-40.0 + 0.0625 + 0.1875)) < 0.1);
  CHECK(predictor.strays() == 1 + 19);  // the last one waits

  // No pose lies between the two sides of the jump.
  for (double time_s = 0.5; time_s < 1.1; time_s += 0.01)
    CHECK(apart_m(*predictor.at(time_s), turning(-40.0)) < 30.0);

  // 20 km/s between two packets is a jump too.
  Predictor fast(kFrame);
  fast.take(turning(0.0), 0.0);
  core::Pose thrown = turning(0.0625);
  thrown.position.height_m += 1250.0;
  fast.take(thrown, 0.0625);
  CHECK(*fast.newest_s() == 0.0);

  // A pause is a pose that stands, and going on is no jump.
  Predictor paused(kFrame);
  core::Pose still = turning(0.0);
  for (int i = 0; i < 100; ++i) paused.take(still, 0.0625 * i);
  paused.take(turning(0.0625), 6.25);
  CHECK(*paused.newest_s() == 6.25);
}

// It crept ahead by the speed that was told, and back with the next packet.
TEST_CASE("A simulator that is paused stands, whatever speed it goes on telling", "[predictor]") {
  for (const bool tells_clock : {true, false}) {
    INFO("clock " << tells_clock);
    Predictor predictor(kFrame);
    const auto take = [&](int flown, double arrived_s) {
      predictor.take(turning(0.0625 * flown), arrived_s,
                     tells_clock ? std::optional(50.0 + 0.0625 * flown) : std::nullopt);
    };
    for (int i = 0; i < 20; ++i) take(i, 0.0625 * i);
    const core::Pose still = turning(0.0625 * 19);
    for (int i = 20; i < 60; ++i) {
      take(19, 0.0625 * i);
      for (const double ahead_s : {0.0, 0.031, 0.1, 0.4}) {
        CHECK(apart_m(*predictor.at(0.0625 * i + ahead_s), still) < 1e-6);
        CHECK(turned_rad(*predictor.at(0.0625 * i + ahead_s), still) < 1e-6);
      }
      if (i > 21) CHECK(apart_m(*predictor.at(0.0625 * i - 0.03), still) < 1e-6);
    }
    // Goes on, without a leap.
    take(20, 0.0625 * 60);
    CHECK(apart_m(*predictor.at(0.0625 * 60 + 0.03), turning(0.0625 * 20 + 0.03)) < 0.05);
    take(21, 0.0625 * 61);
    CHECK(apart_m(*predictor.at(0.0625 * 61 + 0.03), turning(0.0625 * 21 + 0.03)) < 0.05);
  }
}

namespace {

struct Worst {
  double position_m = 0.0, attitude_deg = 0.0;
};

// Of frames at 16 Hz, the pose of a packet arriving `late_s` after it was so; the first second left out.
Worst worst_of(const std::function<double(int)>& late_s, bool tells_clock) {
  constexpr double kPeriod_s = 1.0 / 16.0, kClock_s = 1000.0;
  Predictor predictor(kFrame);
  Worst worst;
  int next = 0;
  for (int frame = 0; frame < 320; ++frame) {
    const double begin_s = (frame + 0.9996) * kPeriod_s;  // just after packets are due
    for (;; ++next) {
      const double sent_s = next * kPeriod_s, arrives_s = sent_s + late_s(next);
      if (arrives_s > begin_s) break;
      predictor.take(turning(sent_s), arrives_s,
                     tells_clock ? std::optional(kClock_s + sent_s) : std::nullopt);
    }
    if (frame < 16) continue;
    const double at_s = begin_s + 0.5 * kPeriod_s;
    worst.position_m = std::max(worst.position_m, apart_m(*predictor.at(at_s), turning(at_s)));
    worst.attitude_deg =
        std::max(worst.attitude_deg, core::degrees(turned_rad(*predictor.at(at_s), turning(at_s))));
  }
  return worst;
}

}  // namespace

// Packets that count as of their arrival threw the aircraft 21 m away, and by 183 deg.
TEST_CASE("Packets that are held back or bunched move the aircraft by no more than even ones",
          "[predictor]") {
  const auto bunched = [](int i) { return i % 8 == 3 ? 1.0 / 16.0 - 0.0005 : 0.0; };
  const auto jitter = [](int i) { return 0.015 * std::abs(std::sin(12.9898 * i * i)); };
  const auto stalls = [](int i) { return i % 40 >= 38 ? (40 - i % 40) / 16.0 : 0.0; };
  for (const bool tells_clock : {true, false}) {
    INFO("clock " << tells_clock);
    CHECK(worst_of(bunched, tells_clock).position_m < 0.1);
    CHECK(worst_of(bunched, tells_clock).attitude_deg < 0.05);
    // The quickest of two seconds set the clock: what is left is how late they were.
    CHECK(worst_of(jitter, tells_clock).position_m < 0.1 + 70.0 * 0.001);
    CHECK(worst_of(jitter, tells_clock).attitude_deg < 0.05);
    // Nothing for 0.19 s, then three at once.
    CHECK(worst_of(stalls, tells_clock).position_m < 0.1);
    CHECK(worst_of(stalls, tells_clock).attitude_deg < 0.05);
  }
}

namespace {

using Late = std::function<double(int)>;
using Sends = std::function<double(int)>;

constexpr double kFrame_s = 1.0 / 16.0, kStraight_mps = 70.0;

double on_time(int) { return 0.0; }
double held_back(int i) { return i % 8 == 3 ? kFrame_s - 0.0005 : 0.0; }

Sends evenly(double packets_Hz) {
  return [packets_Hz](int i) { return i / packets_Hz; };
}

// FlightGear, asked for 15 Hz, sends after three, four or five of its own frames.
double as_flightgear(int i) {
  constexpr int kFrames[] = {0, 3, 7, 12, 15, 20}, kRound = 24;
  return (i / 6 * kRound + kFrames[i % 6]) / 60.0;
}

// Metres along a straight flight at kStraight_mps of a simulator of which `flown_s` of our time has passed, at the
// middles of frames at 16 Hz. Packets are sent when `sends` says and come `late_s` late.
std::vector<double> places_m(const std::function<double(double)>& flown_s, bool tells_clock,
                             const Sends& sends, const Late& late_s = on_time) {
  Predictor predictor(kFrame);
  std::vector<double> places_m;
  int next = 0;
  for (int frame = 0; frame < 320; ++frame) {
    const double begin_s = (frame + 0.3) * kFrame_s;
    for (; sends(next) + late_s(next) <= begin_s; ++next) {
      const double sent_s = sends(next);
      core::Pose pose;
      pose.position = kFrame.to_geodetic({0.0, kStraight_mps * flown_s(sent_s), 500.0});
      pose.v_N_mps = {kStraight_mps, 0.0, 0.0};
      predictor.take(pose, sent_s + late_s(next),
                     tells_clock ? std::optional(1000.0 + flown_s(sent_s)) : std::nullopt);
    }
    places_m.push_back(kFrame.to_local_m(predictor.at(begin_s + kFrame_s / 2)->position).y);
  }
  return places_m;
}

// From one frame to the next, of a simulator that runs `rate` times as fast as time, from two seconds on.
std::vector<double> steps_m(double rate, bool tells_clock, const Sends& sends,
                            const Late& late_s = on_time) {
  const std::vector<double> places =
      places_m([rate](double time_s) { return rate * time_s; }, tells_clock, sends, late_s);
  std::vector<double> steps_m;
  for (std::size_t frame = 33; frame < places.size(); ++frame)
    steps_m.push_back(places[frame] - places[frame - 1]);
  return steps_m;
}

}  // namespace

// It went back a quarter of a second's flight every eight frames; fast ones stood, kilometres behind.
TEST_CASE("A simulator that runs slower than time, or faster, moves on evenly at its own pace",
          "[predictor]") {
  struct Sender {
    Sends sends;
    double longest_s;  // from a packet to the next
  };
  for (const Sender& sender : {Sender{evenly(4.0), 1.0 / 4.0}, Sender{evenly(10.0), 1.0 / 10.0},
                               Sender{evenly(16.0), 1.0 / 16.0}, Sender{evenly(60.0), 1.0 / 60.0},
                               Sender{as_flightgear, 5.0 / 60.0}})
    for (const double rate : {0.1, 0.11, 0.3, 0.5, 0.8, 1.0, 1.5, 2.0, 4.0, 6.0, 8.0, 9.5, 10.0})
      for (const bool tells_clock : {true, false}) {
        // Without a clock a packet tells no more than a second's flight.
        if (!tells_clock && rate * sender.longest_s > 0.99) continue;
        INFO("rate " << rate << ", clock " << tells_clock << ", packets " << sender.longest_s
                     << " s apart at most");
        const double step_m = kStraight_mps * rate / 16.0;
        const std::vector<double> steps = steps_m(rate, tells_clock, sender.sends);
        const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
        CHECK(*least > 0.8 * step_m);
        CHECK(*most < 1.2 * step_m);
        // As fast as time: to the millimetre.
        if (rate == 1.0) CHECK(*most - *least < 1e-3);
      }
}

// It was a second and a half on the way back to time's own pace.
TEST_CASE("A simulator that changes its pace is off by a quarter of a second's flight at most",
          "[predictor]") {
  struct Change {
    double before, after, even_within_s;
  };
  constexpr double kChanges_s = 4.0;
  for (const Change change : {Change{2.0, 1.0, 0.9}, Change{4.0, 1.0, 0.9}, Change{0.5, 1.0, 0.9},
                              Change{1.0, 0.5, 1.6}, Change{1.0, 2.0, 1.6}})
    for (const bool tells_clock : {true, false})
      for (const Late& late_s : {Late(on_time), Late(held_back)}) {
        INFO(change.before << " to " << change.after << ", clock " << tells_clock << ", late "
                           << late_s(3));
        const auto flown_s = [&](double time_s) {
          return change.before * std::min(time_s, kChanges_s) +
                 change.after * std::max(0.0, time_s - kChanges_s);
        };
        const std::vector<double> places = places_m(flown_s, tells_clock, evenly(16.0), late_s);
        const double step_m = kStraight_mps * change.after / 16.0;
        for (std::size_t frame = 64; frame < places.size(); ++frame) {
          const double at_s = (static_cast<double>(frame) + 0.8) * kFrame_s;
          const double off_m = places[frame] - kStraight_mps * flown_s(at_s);
          REQUIRE(std::abs(off_m) <
                  Predictor::kCarriedOn_s * kStraight_mps * std::max(change.before, change.after));
          if (at_s < kChanges_s + change.even_within_s) continue;
          REQUIRE(places[frame] - places[frame - 1] == Approx(step_m).epsilon(0.2));
        }
      }
}

TEST_CASE("Packets that are held back change no pace", "[predictor]") {
  // Nothing for 0.19 s, then three within a millisecond.
  const auto bunched = [](int i) {
    return i % 40 >= 38 ? (40 - i % 40) * (1.0 / 16.0 - 0.0002) : 0.0;
  };
  for (const double rate : {0.5, 0.8, 1.0})
    for (const bool tells_clock : {true, false})
      for (const Late& late_s : {Late(held_back), Late(bunched)}) {
        INFO("rate " << rate << ", clock " << tells_clock);
        const double step_m = kStraight_mps * rate / 16.0;
        const std::vector<double> steps = steps_m(rate, tells_clock, evenly(16.0), late_s);
        const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
        CHECK(*least > 0.8 * step_m);
        CHECK(*most < 1.2 * step_m);
      }
}

TEST_CASE("A source's clock counts from its quickest packets, and anew after a pause or a restart",
          "[predictor]") {
  live::SourceClock clock;
  for (int i = 0; i < 100; ++i)
    CHECK(clock.time_of(0.05 * i, 7.0 + 0.05 * i) == Approx(7.0 + 0.05 * i));
  CHECK(clock.time_of(5.0, 12.2) == Approx(12.0));     // 0.2 s late
  CHECK(clock.time_of(5.05, 12.45) == Approx(12.05));  // and 0.4 s: perhaps the network
  CHECK(clock.time_of(5.1, 12.5) == Approx(12.5));     // no: a pause of 0.4 s
  CHECK(clock.time_of(5.15, 15.5) == Approx(15.5));    // of 3 s
  CHECK(clock.time_of(0.0, 15.55) == Approx(15.55));   // begun anew
  CHECK(clock.time_of(0.05, 15.6) == Approx(15.6));
  CHECK(clock.time_of(0.05, 15.7) == Approx(15.7));  // it stands
  CHECK(clock.time_of(0.05, 15.8) == Approx(15.8));
  // Two clocks that drift by 1e-3 stay together.
  live::SourceClock slow;
  for (int i = 0; i < 10000; ++i)
    REQUIRE(slow.time_of(0.05 * 0.999 * i, 0.05 * i) ==
            Approx(0.05 * i).epsilon(0.0).margin(2.1e-3));
}

// It stayed the quickest for two seconds, and each pose counted as of so much before it was so.
TEST_CASE("A stray packet from ahead moves no pose once the clock is back", "[predictor]") {
  constexpr double kPeriod_s = 1.0 / 16.0, kClock_s = 50.0, kAhead_s = 0.2;
  Predictor predictor(kFrame);
  live::ClockGate gate;
  const auto take = [&](double flown_s, double clock_s, double arrived_s) {
    if (gate.take(clock_s, arrived_s) == feeds::PacketFault::none)
      predictor.take(turning(flown_s), arrived_s, clock_s);
  };
  for (int i = 0; i < 20; ++i) take(kPeriod_s * i, kClock_s + kPeriod_s * i, kPeriod_s * i);
  take(kPeriod_s * 19 + kAhead_s, kClock_s + kPeriod_s * 19 + kAhead_s, kPeriod_s * 19.5);
  for (int i = 20; i < 40; ++i) {
    take(kPeriod_s * i, kClock_s + kPeriod_s * i, kPeriod_s * i);
    const double at_s = kPeriod_s * (i + 0.5);
    if (i >= 24) CHECK(apart_m(*predictor.at(at_s), turning(at_s)) < 0.5);
  }
}

TEST_CASE("Time in lockstep is that of the packets", "[predictor]") {
  live::LockstepTime told(0.0625), counted(0.0625);
  CHECK(told.next(50.0) == 0.0);
  CHECK(told.next(50.05) == Approx(0.05));
  CHECK(told.next(50.05) == Approx(0.05));  // paused
  CHECK(told.next(3.0) == Approx(0.1125));  // begun anew: a period
  CHECK(told.next(3.1) == Approx(0.2125));
  for (int i = 0; i < 5; ++i) CHECK(counted.next({}) == Approx(0.0625 * i));
}
