#include "bindings/python/convert.h"

#include "core/stop.h"
#include "core/units.h"

namespace fanbeam::bindings {
namespace {

struct PoseField {
  const char* name;
  core::NumberRange range;
  const char* unit;
};
constexpr std::array<PoseField, 10> kPoseFields = {
    {{"pose.time_s", {}, "s"},
     {"pose.latitude_deg", {-90.0, 90.0}, "deg"},
     {"pose.longitude_deg", {-540.0, 540.0}, "deg"},
     {"pose.height_m", {-20000.0, 1.0e6}, "m"},
     {"pose.roll_deg", {}, "deg"},
     {"pose.pitch_deg", {}, "deg"},
     {"pose.heading_deg", {}, "deg"},
     {"pose.north_mps", {}, "m/s"},
     {"pose.east_mps", {}, "m/s"},
     {"pose.down_mps", {}, "m/s"}}};

// Names of files may hold bytes that are no UTF-8; they become \xff.
py::str text_of(const std::string& text) {
  return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
}

void raise(const core::InputError& error) {
  const py::object type = py::module_::import("fanbeam._errors").attr("InputError");
  PyErr_SetObject(type.ptr(), problems_list(error.problems()).ptr());
}

}  // namespace

std::string shown(const py::handle& value) {
  const auto text = py::reinterpret_steal<py::object>(PyObject_Repr(value.ptr()));
  const auto bytes = py::reinterpret_steal<py::bytes>(
      text ? PyUnicode_AsEncodedString(text.ptr(), "utf-8", "backslashreplace") : nullptr);
  if (bytes) return bytes;
  if (!PyErr_ExceptionMatches(PyExc_Exception)) throw py::error_already_set();  // Ctrl-C
  PyErr_Clear();
  if (PyLong_Check(value.ptr()))
    return "a whole number of " +
           std::to_string(value.attr("bit_length")().cast<unsigned long long>()) + " bits";
  return std::string("one of type ") + Py_TYPE(value.ptr())->tp_name;
}

void refuse_type(const std::string& field, const char* expected, const py::handle& value) {
  throw py::type_error(field + ": expected " + expected + ", not " + shown(value));
}

bool is_truth(const py::handle& value) {
  return py::detail::make_caster<bool>().load(value, false);
}

py::object whole_number(const py::handle& value) {
  if (is_truth(value)) return {};
  auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  PyErr_Clear();
  return number;
}

core::Pose pose_of(const py::tuple& told, core::ProblemList& problems) {
  PoseNumbers numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = number_of<double>(told[i], kPoseFields[i].name, problems, kPoseFields[i].range,
                                   kPoseFields[i].unit);
  core::Pose pose;
  pose.time_s = numbers[0];
  pose.position = {core::radians(numbers[1]), core::radians(numbers[2]), numbers[3]};
  pose.q_NB = core::quaternion_from(
      {core::radians(numbers[4]), core::radians(numbers[5]), core::radians(numbers[6])});
  pose.v_N_mps = glm::dvec3(numbers[7], numbers[8], numbers[9]);
  return pose;
}

PoseNumbers numbers_of(const core::Pose& pose) {
  const core::Attitude attitude = core::attitude_from(pose.q_NB);
  return {pose.time_s,
          core::degrees(pose.position.latitude_rad),
          core::degrees(pose.position.longitude_rad),
          pose.position.height_m,
          core::degrees(attitude.roll_rad),
          core::degrees(attitude.pitch_rad),
          core::degrees(attitude.heading_rad),
          pose.v_N_mps.x,
          pose.v_N_mps.y,
          pose.v_N_mps.z};
}

py::list problems_list(const std::vector<core::Problem>& problems) {
  const py::object type = py::module_::import("fanbeam._errors").attr("Problem");
  py::list result;
  for (const core::Problem& problem : problems)
    result.append(type(problem.code, text_of(problem.place.file), problem.place.line,
                       problem.place.column, text_of(problem.field), text_of(problem.value),
                       text_of(problem.expected), text_of(core::to_string(problem))));
  return result;
}

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const core::InputError& error) {
      raise(error);
    } catch (const core::Stopped&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
}

}  // namespace fanbeam::bindings
