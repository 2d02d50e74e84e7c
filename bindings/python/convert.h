// Between Python's objects and fanbeam's plain data: arrays that share memory with a frame, errors
// that carry their problems.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "core/errors.h"
#include "core/pose.h"

namespace fanbeam::bindings {

namespace py = pybind11;

// time_s, latitude_deg, longitude_deg, height_m, roll_deg, pitch_deg, heading_deg, then the velocity
// over ground north_mps, east_mps, down_mps: fanbeam.Pose and a row of Scene.trajectory.
using PoseNumbers = std::array<double, 10>;
// Throws InputError E-NONFINITE and E-RANGE, every problem; heights -20 to 1000 km.
core::Pose pose_of(const PoseNumbers& numbers);
PoseNumbers numbers_of(const core::Pose& pose);

// What a value of this type is called in messages.
template <class T>
constexpr const char* words_for() {
  if constexpr (std::is_same_v<T, bool>) return "True or False";
  if constexpr (std::is_integral_v<T>) return "a whole number in its range";
  if constexpr (std::is_same_v<T, std::string>) return "a text";
  return "a number";
}

// What Python told as `field`. Throws TypeError, which names it, for another type.
template <class T>
T value_of(const py::handle& value, const std::string& field,
           const char* expected = words_for<T>()) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(field + ": expected " + expected + ", not " +
                         py::repr(value).cast<std::string>());
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
