#include "bindings/c/arguments.h"

#include "core/constants.h"

namespace fanbeam::bindings {

void Arguments::because(fanbeam_status status) {
  if (!problems_.has_errors()) status_ = status;
}

bool Arguments::there(const void* pointer, std::string_view name, std::string_view expected) {
  if (pointer != nullptr) return true;
  refuse(core::ErrorClass::ref, std::string(name), "NULL", std::string(expected));
  return false;
}

bool Arguments::size_is(std::uint32_t size, std::size_t known, std::string_view name) {
  if (size == known) return true;
  because(FANBEAM_BAD_SIZE);
  problems_.error(core::ErrorClass::unsupported, {}, std::string(name) + ".size",
                  std::to_string(size),
                  std::to_string(known) + ", as of version " + fanbeam_version_text());
  return false;
}

void Arguments::room(const void* buffer, std::size_t count, std::size_t needed,
                     std::string_view name) {
  if (buffer == nullptr || count >= needed) return;
  because(FANBEAM_SHORT_BUFFER);
  problems_.error(core::ErrorClass::limit, {}, std::string(name),
                  "room for " + std::to_string(count), "room for " + std::to_string(needed));
}

void Arguments::reserved(std::int64_t value, const std::string& name) {
  if (value != 0) refuse(core::ErrorClass::range, name, std::to_string(value), "0");
}

void Arguments::bits(std::uint32_t value, std::uint32_t known, const std::string& name,
                     const std::string& expected) {
  if ((value & ~known) != 0) refuse(core::ErrorClass::range, name, std::to_string(value), expected);
}

void Arguments::refuse(core::ErrorClass error_class, const std::string& name,
                       const std::string& value, const std::string& expected) {
  because(FANBEAM_BAD_INPUT);
  problems_.error(error_class, {}, name, value, expected);
}

void Arguments::done() const {
  if (problems_.has_errors()) throw RefusedCall(status_, problems_.all());
}

void check_place(Arguments& arguments, const std::string& name, double latitude_rad,
                 double longitude_rad, double height_m) {
  arguments.number(latitude_rad, name + ".latitude_rad", {-core::kPi / 2, core::kPi / 2});
  arguments.number(longitude_rad, name + ".longitude_rad", {-3 * core::kPi, 3 * core::kPi});
  arguments.number(height_m, name + ".height_m", {-20000.0, 1.0e6}, "m");
}

void check_attitude(Arguments& arguments, const std::string& name, double roll_rad,
                    double pitch_rad, double heading_rad) {
  arguments.number(roll_rad, name + ".roll_rad", {});
  arguments.number(pitch_rad, name + ".pitch_rad", {});
  arguments.number(heading_rad, name + ".heading_rad", {});
}

void check_pose(Arguments& arguments, const fanbeam_pose* pose) {
  if (!arguments.sized(pose, "pose")) return;
  arguments.reserved(pose->reserved, "pose.reserved");
  arguments.number(pose->time_s, "pose.time_s", {});
  check_place(arguments, "pose", pose->latitude_rad, pose->longitude_rad, pose->height_m);
  check_attitude(arguments, "pose", pose->roll_rad, pose->pitch_rad, pose->heading_rad);
  arguments.number(pose->north_mps, "pose.north_mps", {});
  arguments.number(pose->east_mps, "pose.east_mps", {});
  arguments.number(pose->down_mps, "pose.down_mps", {});
}

std::string text_of(const char* text) { return text == nullptr ? std::string() : text; }

}  // namespace fanbeam::bindings
