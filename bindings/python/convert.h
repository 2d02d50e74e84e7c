// Between Python's objects and fanbeam's plain data: arrays that share memory with a frame, errors
// that carry their problems.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/errors.h"
#include "core/number_range.h"
#include "core/pose.h"

namespace fanbeam::bindings {

namespace py = pybind11;

// time_s, latitude_deg, longitude_deg, height_m, roll_deg, pitch_deg, heading_deg, then the velocity
// over ground north_mps, east_mps, down_mps: fanbeam.Pose and a row of Scene.trajectory.
using PoseNumbers = std::array<double, 10>;
// Of such numbers as Python told; heights -20 to 1000 km. What is wrong goes to `problems`, each
// below "pose", and then the pose is none. Throws TypeError.
core::Pose pose_of(const py::tuple& numbers, core::ProblemList& problems);
PoseNumbers numbers_of(const core::Pose& pose);

// What a value of this type is called in messages.
template <class T>
constexpr const char* words_for() {
  if constexpr (std::is_same_v<T, bool>) return "True or False";
  if constexpr (std::is_integral_v<T>) return "a whole number";
  if constexpr (std::is_same_v<T, std::string>) return "a text";
  if constexpr (std::is_same_v<T, std::filesystem::path>) return "a path";
  return "a number";
}

// As Python shows it. Of what Python has no text for, an integer above 4300 digits or an object whose
// __repr__ raises, what it is.
std::string shown(const py::handle& value);
// Throws TypeError: "seed: expected a whole number, not 'x'".
[[noreturn]] void refuse_type(const std::string& field, const char* expected,
                              const py::handle& value);
// True and False, NumPy's too. Every other object has a truth as well, and none of them is meant; nor
// are these the numbers that they can be read as.
bool is_truth(const py::handle& value);
// As Python counts: 3, numpy.int64(3), not 3.0, not True. Empty for what is no such number.
py::object whole_number(const py::handle& value);

// What Python told as `field`. Throws TypeError, which names it, for another type. A number of
// Python's that T cannot hold goes to `problems`, E-RANGE, and T() comes back.
template <class T>
T value_of(const py::handle& value, const std::string& field, core::ProblemList& problems,
           const char* expected = words_for<T>()) {
  if constexpr (std::is_same_v<T, bool>) {
    if (!is_truth(value)) refuse_type(field, expected, value);
    return value.cast<bool>();
  } else {
    auto given = py::reinterpret_borrow<py::object>(value);
    if constexpr (std::is_integral_v<T>) given = whole_number(value);
    if (!given || (std::is_arithmetic_v<T> && is_truth(value))) refuse_type(field, expected, value);
    // Bytes would be taken for a text.
    if (std::is_same_v<T, std::string> && !PyUnicode_Check(value.ptr()))
      refuse_type(field, expected, value);
    try {
      return given.cast<T>();
    } catch (const py::cast_error&) {
      if (!std::is_arithmetic_v<T> || !PyLong_Check(given.ptr()))
        refuse_type(field, expected, value);
    }
    using Limits = std::numeric_limits<T>;
    std::string range = "a finite number";
    if constexpr (std::is_integral_v<T>)
      range = std::to_string(Limits::min()) + " to " + std::to_string(Limits::max());
    problems.error(core::ErrorClass::range, {}, field, shown(given), range);
    return T();
  }
}

// The same; none where T cannot hold the number, so that nothing is said of what stands in for it.
template <class T>
std::optional<T> held_of(const py::handle& value, const std::string& field,
                         core::ProblemList& problems) {
  core::ProblemList own;
  const T held = value_of<T>(value, field, own);
  problems.append(own.all());
  return own.has_errors() ? std::nullopt : std::optional<T>(held);
}

// The same of what may be None.
template <class T>
std::optional<T> optional_of(const py::handle& value, const std::string& field,
                             core::ProblemList& problems) {
  if (value.is_none()) return std::nullopt;
  return value_of<T>(value, field, problems);
}

// The same of a number within `range`; one outside goes to `problems` too.
template <class T>
T number_of(const py::handle& value, const std::string& field, core::ProblemList& problems,
            const core::NumberRange& range, const char* unit = "") {
  using Wide = std::conditional_t<std::is_integral_v<T>, long long, T>;
  core::ProblemList own;
  const auto number = value_of<Wide>(value, field, own);
  if (own.has_errors())
    problems.error(core::ErrorClass::range, {}, field, own.all().front().value,
                   core::to_string(range) + (*unit ? " " : "") + unit);
  else
    core::check_range(problems, field, static_cast<double>(number), range, unit);
  return static_cast<T>(number);
}

// What `work` refuses goes to `problems`.
template <class Work>
void collect(core::ProblemList& problems, const Work& work) {
  try {
    work();
  } catch (const core::InputError& error) {
    problems.append(error.problems());
  }
}

// fanbeam.Problem of each.
py::list problems_list(const std::vector<core::Problem>& problems);

// core::InputError as fanbeam.InputError, core::Stopped as KeyboardInterrupt.
void translate_errors();

// Rows of `columns` values as an array that keeps `owner` alive and copies nothing; the last row
// first where `turned`.
template <class Value>
py::array rows_of(const std::vector<Value>& values, std::size_t columns, bool turned,
                  const py::object& owner) {
  const std::size_t rows = values.size() / columns;
  const auto row_bytes = static_cast<py::ssize_t>(columns * sizeof(Value));
  const Value* first = values.data() + (turned && rows > 0 ? (rows - 1) * columns : 0);
  return py::array(py::dtype::of<Value>(), {rows, columns},
                   {turned ? -row_bytes : row_bytes, static_cast<py::ssize_t>(sizeof(Value))},
                   first, owner);
}

// What an array keeps alive.
template <class Held>
py::capsule owner_of(std::shared_ptr<Held> held) {
  return py::capsule(new std::shared_ptr<Held>(std::move(held)),
                     [](void* pointer) { delete static_cast<std::shared_ptr<Held>*>(pointer); });
}

}  // namespace fanbeam::bindings
