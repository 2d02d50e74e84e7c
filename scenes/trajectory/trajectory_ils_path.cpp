#include "scenes/trajectory/trajectory_ils_path.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

#include "core/errors.h"
#include "scenes/trajectory/trajectory_kinematics.h"
#include "scenes/trajectory/trajectory_transplant.h"

namespace fanbeam::scenes {
namespace {

constexpr double kNoTurn_rad = 1e-9;

// Radius of curvature of WGS 84 (NIMA TR8350.2) in a direction: Euler's theorem.
double radius_of_curvature_m(double latitude_rad, double azimuth_rad) {
  constexpr double kSemiMajorAxis_m = 6378137.0;
  constexpr double kFlattening = 1.0 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
  const double sine = std::sin(latitude_rad);
  const double w2 = 1.0 - kEccentricity2 * sine * sine;
  const double prime_vertical_m = kSemiMajorAxis_m / std::sqrt(w2);
  const double meridian_m = prime_vertical_m * (1.0 - kEccentricity2) / w2;
  const double c = std::cos(azimuth_rad);
  const double s = std::sin(azimuth_rad);
  return 1.0 / (c * c / meridian_m + s * s / prime_vertical_m);
}

}  // namespace

IlsPath::IlsPath(const IlsApproach& approach, const terrain::LocalFrame& frame)
    : approach_(approach), frame_(frame) {
  const double course_rad = approach.localiser_course_rad.value_or(approach.runway_bearing_rad);
  offset_rad_ = core::wrap_pi_rad(course_rad - approach.runway_bearing_rad);
  radius_m_ = radius_of_curvature_m(approach.threshold.latitude_rad, course_rad);
  const double from_ahead_rad = approach.wind_from_rad - approach.runway_bearing_rad;
  airspeed_mps_ = approach.speed_mps;
  if (approach.speed_kind == SpeedKind::ground)
    airspeed_mps_ =
        std::hypot(approach.speed_mps + approach.wind_speed_mps * std::cos(from_ahead_rad),
                   approach.wind_speed_mps * std::sin(from_ahead_rad));
  if (airspeed_mps_ < approach.wind_speed_mps + 5.0)
    core::throw_input_error(
        core::ErrorClass::range, "wind_speed_mps", approach.wind_speed_mps,
        "at least 5 m/s below the airspeed of " + core::number_text(airspeed_mps_) + " m/s");
  runway_speed_mps_ = ground_speed_on_m(0.0);
  decision_to_go_m_ = glide_to_go_at(approach.decision_height_m);
  lay_turn();
  lay_flare();
  if (turn_end_to_go_m_ < flare_to_go_m_)
    core::throw_input_error(core::ErrorClass::range, "crossing_distance_m",
                            approach.crossing_distance_m.value_or(decision_to_go_m_),
                            "far enough out for the turn to end before the flare");
  const double farthest_m =
      std::max({turn_end_to_go_m_ + turn_length_m_, flare_to_go_m_, decision_to_go_m_});
  if (approach.start_distance_m <= farthest_m)
    core::throw_input_error(core::ErrorClass::range, "start_distance_m", approach.start_distance_m,
                            "more than " + core::number_text(farthest_m) +
                                " m, where turn, decision height and flare lie behind");
}

// The course changes by a smooth step along the turn: the bank begins and ends at 0 and is largest
// in the middle, where the course changes 1.5 times as fast as in the mean.
void IlsPath::lay_turn() {
  turn_end_to_go_m_ = approach_.crossing_distance_m.value_or(decision_to_go_m_);
  if (std::abs(offset_rad_) < kNoTurn_rad) return;
  const double speed_mps = std::max(runway_speed_mps_, ground_speed_on_m(offset_rad_));
  turn_length_m_ = 1.5 * std::abs(offset_rad_) * speed_mps * speed_mps /
                   (kStandardGravity_mps2 * std::tan(approach_.largest_bank_rad));
  // By symmetry both lines touch the turn equally far from where they cross.
  turn_end_to_go_m_ -= -turned(turn_length_m_).right_m / std::sin(offset_rad_);
}

void IlsPath::lay_flare() {
  flare_to_go_m_ = to_go_at(approach_.flare_height_m);
  constexpr double kHalfStep_m = 1.0;
  slope_at_flare_ = (glide_wheel_height_m(flare_to_go_m_ + kHalfStep_m) -
                     glide_wheel_height_m(flare_to_go_m_ - kHalfStep_m)) /
                    (2.0 * kHalfStep_m);
  slope_at_touchdown_ = approach_.touchdown_sink_mps / runway_speed_mps_;
  if (slope_at_touchdown_ >= slope_at_flare_)
    core::throw_input_error(core::ErrorClass::range, "touchdown_sink_mps",
                            approach_.touchdown_sink_mps,
                            "less than on the glide path, " +
                                core::number_text(slope_at_flare_ * runway_speed_mps_) + " m/s");
  touchdown_to_go_m_ =
      flare_to_go_m_ - 2.0 * approach_.flare_height_m / (slope_at_flare_ + slope_at_touchdown_);
}

double IlsPath::ground_speed_on_m(double relative_course_rad) const {
  const double from_ahead_rad =
      approach_.wind_from_rad - approach_.runway_bearing_rad - relative_course_rad;
  const double cross_mps = approach_.wind_speed_mps * std::sin(from_ahead_rad);
  return std::sqrt(airspeed_mps_ * airspeed_mps_ - cross_mps * cross_mps) -
         approach_.wind_speed_mps * std::cos(from_ahead_rad);
}

double IlsPath::ground_speed_mps(double to_go_m) const {
  return ground_speed_on_m(relative_course_rad(to_go_m));
}

double IlsPath::relative_course_rad(double to_go_m) const {
  if (to_go_m <= turn_end_to_go_m_ || turn_length_m_ == 0.0) return 0.0;
  return offset_rad_ * smooth_step((to_go_m - turn_end_to_go_m_) / turn_length_m_);
}

// Displacement against the flight from the end of the turn, by Simpson's rule (error below 1e-6 m
// for the largest offset).
IlsPath::Plan IlsPath::turned(double turn_to_go_m) const {
  constexpr int kIntervals = 64;
  Plan sum;
  for (int i = 0; i <= kIntervals; ++i) {
    const double part = static_cast<double>(i) / kIntervals;
    const double course_rad = offset_rad_ * smooth_step(part * turn_to_go_m / turn_length_m_);
    const double weight = i == 0 || i == kIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum.before_threshold_m += weight * std::cos(course_rad);
    sum.right_m -= weight * std::sin(course_rad);
  }
  const double scale_m = turn_to_go_m / (3.0 * kIntervals);
  return {sum.before_threshold_m * scale_m, sum.right_m * scale_m};
}

IlsPath::Plan IlsPath::plan(double to_go_m) const {
  const double beyond_m = to_go_m - turn_end_to_go_m_;
  if (beyond_m <= 0.0 || turn_length_m_ == 0.0) return {to_go_m, 0.0};
  const double straight_m = std::max(0.0, beyond_m - turn_length_m_);
  const Plan turn = turned(beyond_m - straight_m);
  return {turn_end_to_go_m_ + turn.before_threshold_m + straight_m * std::cos(offset_rad_),
          turn.right_m - straight_m * std::sin(offset_rad_)};
}

double IlsPath::glide_height_m(double to_go_m) const {
  const double crossing_m = approach_.threshold_crossing_height_m;
  const double glide_rad = approach_.glide_path_rad;
  if (frame_.model() == terrain::EarthModel::plane)
    return crossing_m + to_go_m * std::tan(glide_rad);
  // Triangle of the Earth's centre, the beam over the threshold and the aircraft.
  const double angle_rad = to_go_m / radius_m_;
  const double from_centre_m = radius_m_ + approach_.threshold.height_m + crossing_m;
  return crossing_m + from_centre_m * 2.0 * std::sin(glide_rad + 0.5 * angle_rad) *
                          std::sin(0.5 * angle_rad) / std::cos(glide_rad + angle_rad);
}

double IlsPath::glide_wheel_height_m(double to_go_m) const {
  return glide_height_m(to_go_m) + approach_.runway_slope * to_go_m - approach_.height_on_ground_m;
}

// Newton's method on lines that are nearly straight: three steps reach rounding.
double IlsPath::glide_to_go_at(double height_m) const {
  const double slope = std::tan(approach_.glide_path_rad);
  double to_go_m = 0.0;
  for (int i = 0; i < 12; ++i) to_go_m -= (glide_height_m(to_go_m) - height_m) / slope;
  return to_go_m;
}

double IlsPath::to_go_at(double wheel_height_m) const {
  const double slope = std::tan(approach_.glide_path_rad) + approach_.runway_slope;
  double to_go_m = 0.0;
  for (int i = 0; i < 12; ++i) to_go_m -= (glide_wheel_height_m(to_go_m) - wheel_height_m) / slope;
  return to_go_m;
}

double IlsPath::wheel_height_m(double to_go_m) const {
  if (to_go_m >= flare_to_go_m_) return glide_wheel_height_m(to_go_m);
  const double left_m = to_go_m - touchdown_to_go_m_;
  if (left_m <= 0.0) return 0.0;
  const double flare_m = flare_to_go_m_ - touchdown_to_go_m_;
  return left_m *
         (slope_at_touchdown_ + (slope_at_flare_ - slope_at_touchdown_) * left_m / (2.0 * flare_m));
}

core::Geodetic IlsPath::position(double to_go_m) const {
  const Plan at = plan(to_go_m);
  const double height_m =
      wheel_height_m(to_go_m) - approach_.runway_slope * to_go_m + approach_.height_on_ground_m;
  if (frame_.model() == terrain::EarthModel::wgs84)
    return position_from({approach_.threshold, approach_.runway_bearing_rad},
                         {at.before_threshold_m, at.right_m, height_m});
  const double c = std::cos(approach_.runway_bearing_rad);
  const double s = std::sin(approach_.runway_bearing_rad);
  const glm::dvec3 from_threshold_N_m{-at.before_threshold_m * c - at.right_m * s,
                                      -at.before_threshold_m * s + at.right_m * c, -height_m};
  return frame_.to_geodetic(frame_.to_local_m(approach_.threshold) +
                            frame_.north_east_down_at(approach_.threshold) * from_threshold_N_m);
}

}  // namespace fanbeam::scenes
