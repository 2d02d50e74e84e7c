#include "scenes/trajectory/trajectory_turbulence.h"

#include <cmath>

namespace fanbeam::scenes {

GustResponse::Disturbance GustResponse::next(const glm::dvec3& gust_mps, double airspeed_mps,
                                             double step_s) {
  constexpr double kAirframe_s = 1.5;
  constexpr double kAutopilot_rad_per_s = 0.5;
  constexpr double kAngles_s = 0.8;
  const glm::dvec3 not_taken_mps = gust_mps - rate_mps_;
  const glm::dvec3 pull_mps2 = kAutopilot_rad_per_s * kAutopilot_rad_per_s * now_.offset_m;
  rate_mps_ += step_s * (not_taken_mps / kAirframe_s - pull_mps2);
  now_.offset_m += step_s * rate_mps_;

  const double follow = -std::expm1(-step_s / kAngles_s);
  const glm::dvec3 angle_rad = not_taken_mps / airspeed_mps;
  now_.angles.pitch_rad += follow * (angle_rad.z - now_.angles.pitch_rad);
  now_.angles.heading_rad += follow * (-angle_rad.y - now_.angles.heading_rad);
  now_.angles.roll_rad += follow * (angle_rad.y - now_.angles.roll_rad);
  return now_;
}

}  // namespace fanbeam::scenes
