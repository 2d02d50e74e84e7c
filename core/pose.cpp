#include "core/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "core/errors.h"
#include "core/units.h"

namespace fanbeam::core {
namespace {

glm::dquat checked_unit(const glm::dquat& q) {
  const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!std::isfinite(norm))
    throw_input_error(ErrorClass::nonfinite, "quaternion length", norm, "a finite quaternion");
  if (norm < 1e-12)
    throw_input_error(ErrorClass::range, "quaternion length", norm, "a length above 1e-12");
  return {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
}

}  // namespace

glm::dquat quaternion_from(const Attitude& attitude) {
  const double cr = std::cos(attitude.roll_rad / 2), sr = std::sin(attitude.roll_rad / 2);
  const double cp = std::cos(attitude.pitch_rad / 2), sp = std::sin(attitude.pitch_rad / 2);
  const double ch = std::cos(attitude.heading_rad / 2), sh = std::sin(attitude.heading_rad / 2);
  return {cr * cp * ch + sr * sp * sh, sr * cp * ch - cr * sp * sh, cr * sp * ch + sr * cp * sh,
          cr * cp * sh - sr * sp * ch};
}

Attitude attitude_from(const glm::dquat& q_NB) {
  const glm::dmat3 m = glm::mat3_cast(checked_unit(q_NB));  // m[column][row]
  Attitude attitude;
  const double sin_pitch = std::clamp(-m[0][2], -1.0, 1.0);
  attitude.pitch_rad = std::atan2(sin_pitch, std::hypot(m[0][0], m[0][1]));
  if (std::hypot(m[0][0], m[0][1]) < 1e-9) {
    attitude.heading_rad = std::atan2(-m[1][0], m[1][1]);
  } else {
    attitude.roll_rad = std::atan2(m[1][2], m[2][2]);
    attitude.heading_rad = std::atan2(m[0][1], m[0][0]);
  }
  if (attitude.heading_rad < 0.0) attitude.heading_rad += 2.0 * kPi;
  if (attitude.heading_rad >= 2.0 * kPi) attitude.heading_rad = 0.0;
  return attitude;
}

glm::dquat interpolate(const glm::dquat& from, const glm::dquat& to, double s) {
  const glm::dquat a = checked_unit(from);
  glm::dquat b = checked_unit(to);
  double cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  if (cosine < 0.0) {
    b = {-b.w, -b.x, -b.y, -b.z};
    cosine = -cosine;
  }
  double wa = 1.0 - s;
  double wb = s;
  if (cosine < 1.0 - 1e-10) {  // beyond that the chord equals the arc to 1e-15
    const double angle = std::acos(cosine);
    wa = std::sin((1.0 - s) * angle) / std::sin(angle);
    wb = std::sin(s * angle) / std::sin(angle);
  }
  return checked_unit(
      {wa * a.w + wb * b.w, wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z});
}

}  // namespace fanbeam::core
