// Looks at the arguments of a call before anything is done, and refuses all that is wrong with them
// together. What is right costs no memory: fanbeam_latest_frame is called from loops that may not wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bindings/c/fanbeam.h"
#include "bindings/c/last_call.h"
#include "core/errors.h"
#include "core/number_range.h"

namespace fanbeam::bindings {

// What a call expects as its session.
inline constexpr const char* kOpened = "what fanbeam_open gave";

class Arguments {
 public:
  // False, and refused, when it is NULL.
  bool there(const void* pointer, std::string_view name, std::string_view expected);

  // A struct that is there, and of a size that this version knows. So far each struct has had one
  // size; one that grows keeps its earlier sizes here.
  template <class Struct>
  bool sized(const Struct* given, std::string_view name) {
    return there(given, name, "a struct with its size") &&
           size_is(given->size, sizeof(Struct), name);
  }

  // Room for `needed` elements behind a pointer; NULL asks for none.
  void room(const void* buffer, std::size_t count, std::size_t needed, std::string_view name);

  void number(double value, const std::string& name, const core::NumberRange& range,
              const std::string& unit = {}) {
    core::check_range(problems_, name, value, range, unit);
  }
  // 0 so far: a later version may mean something by it.
  void reserved(std::int64_t value, const std::string& name);
  // Bits of `known` alone.
  void bits(std::uint32_t value, std::uint32_t known, const std::string& name,
            const std::string& expected);
  void refuse(core::ErrorClass error_class, const std::string& name, const std::string& value,
              const std::string& expected);

  // Of checks that other rooms make.
  core::ProblemList& problems() { return problems_; }

  // Throws when anything was refused; of several reasons the first counts.
  void done() const;

 private:
  bool size_is(std::uint32_t size, std::size_t known, std::string_view name);
  void because(fanbeam_status status);

  fanbeam_status status_ = FANBEAM_BAD_INPUT;
  core::ProblemList problems_;
};

// Every range of fanbeam.h.
void check_pose(Arguments& arguments, const fanbeam_pose* pose);
void check_place(Arguments& arguments, const std::string& name, double latitude_rad,
                 double longitude_rad, double height_m);
void check_attitude(Arguments& arguments, const std::string& name, double roll_rad,
                    double pitch_rad, double heading_rad);

// "" for NULL.
std::string text_of(const char* text);

}  // namespace fanbeam::bindings
