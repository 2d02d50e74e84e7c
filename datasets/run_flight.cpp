#include "datasets/run_flight.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/random.h"
#include "core/units.h"
#include "terrain/local_frame.h"

namespace fanbeam::datasets {
namespace {

// What wanders; each has waves of its own.
enum class Wander : std::uint32_t { aside, up, roll, pitch, heading };

// RMS 1 over long times.
double wandering(std::uint64_t seed, int run, Wander what, double time_s) {
  constexpr double kShortest_s = 3.0, kLongest_s = 20.0;
  double sum = 0.0;
  for (std::uint32_t wave = 0; wave < kWaves; ++wave) {
    const auto words =
        core::random_words({seed, core::kStreamCampaignFlight, static_cast<std::uint64_t>(run)},
                           static_cast<std::uint64_t>(what), wave);
    const double period_s =
        kShortest_s * std::pow(kLongest_s / kShortest_s, core::uniform_from(words[0]));
    sum += std::sin(2 * core::kPi * (time_s / period_s + core::uniform_from(words[1])));
  }
  return sum * std::sqrt(2.0 / kWaves);
}

}  // namespace

std::vector<int> frames_of(const FrameSpread& spread, int frame_count) {
  std::vector<int> frames;
  for (int i = 0; i < spread.count; ++i) {
    const double share = spread.count == 1
                             ? (spread.from + spread.to) / 2
                             : spread.from + (spread.to - spread.from) * i / (spread.count - 1);
    const int frame = static_cast<int>(std::lround(share * (frame_count - 1)));
    if (frames.empty() || frames.back() != frame) frames.push_back(frame);
  }
  return frames;
}

core::Pose run_pose(const Draw& draw, std::uint64_t seed, const core::Pose& flown, double begin_s) {
  const auto of_flight = [&](const char* name) {
    return draw.number(std::string("flight.") + name).value_or(0.0);
  };
  const double speed_factor = draw.number("flight.speed_factor").value_or(1.0);
  const double time_s = begin_s + (flown.time_s - begin_s) / speed_factor;
  const double rms_m = of_flight("turbulence_m"),
               rms_rad = core::radians(of_flight("turbulence_deg"));
  const auto wander = [&](Wander what) { return wandering(seed, draw.run, what, time_s); };

  core::Pose pose = flown;
  pose.time_s = time_s + of_flight("time_s");
  pose.v_N_mps *= speed_factor;
  const double aside_m = of_flight("lateral_m") + rms_m * wander(Wander::aside);
  const double up_m = of_flight("vertical_m") + rms_m * wander(Wander::up);
  const bool moves = std::hypot(flown.v_N_mps.x, flown.v_N_mps.y) > 0.1;
  const double track_rad = moves ? std::atan2(flown.v_N_mps.y, flown.v_N_mps.x)
                                 : core::attitude_from(flown.q_NB).heading_rad;
  if (aside_m != 0.0)
    pose.position = terrain::geodesic_point(
        flown.position, track_rad + (aside_m > 0.0 ? 0.5 : -0.5) * core::kPi, std::abs(aside_m));
  pose.position.height_m = flown.position.height_m + up_m;
  const core::Attitude turn{
      core::radians(of_flight("roll_deg")) + rms_rad * wander(Wander::roll),
      core::radians(of_flight("pitch_deg")) + rms_rad * wander(Wander::pitch),
      core::radians(of_flight("heading_deg")) + rms_rad * wander(Wander::heading)};
  pose.q_NB = flown.q_NB * core::quaternion_from(turn);
  return pose;
}

}  // namespace fanbeam::datasets
