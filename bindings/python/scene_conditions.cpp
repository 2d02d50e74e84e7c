#include "bindings/python/scene_conditions.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bindings/python/convert.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/weather_fields.h"
#include "core/number_range.h"
#include "core/units.h"
#include "terrain/local_frame.h"

namespace fanbeam::bindings {
namespace {

// None for None, and for a number outside `range`, which goes to `problems`.
std::optional<double> within(const py::handle& told, const std::string& field,
                             core::ProblemList& problems, const core::NumberRange& range,
                             const char* unit) {
  if (told.is_none()) return std::nullopt;
  core::ProblemList own;
  const auto number = number_of<double>(told, field, own, range, unit);
  problems.append(own.all());
  return own.has_errors() ? std::nullopt : std::optional(number);
}

// Of three angles in degrees, None for none, and where one is wrong: that goes to `problems`, below
// `field`.
std::optional<glm::dquat> attitude_of(const py::handle& told, const std::string& field,
                                      core::ProblemList& problems) {
  if (told.is_none()) return std::nullopt;
  constexpr std::array<const char*, 3> kAngles = {".roll_deg", ".pitch_deg", ".heading_deg"};
  const py::ssize_t size = PySequence_Size(told.ptr());  // -1 of an array without dimensions too
  PyErr_Clear();
  if (!py::isinstance<py::sequence>(told) || size != std::ssize(kAngles))
    refuse_type(field + ".attitude_deg", "roll, pitch and heading", told);
  const auto angles = py::reinterpret_borrow<py::sequence>(told);
  std::array<double, 3> angles_rad{};
  core::ProblemList own;
  for (std::size_t i = 0; i < kAngles.size(); ++i)
    angles_rad[i] = core::radians(number_of<double>(angles[i], field + kAngles[i], own, {}, "deg"));
  problems.append(own.all());
  if (own.has_errors()) return std::nullopt;
  return core::quaternion_from({angles_rad[0], angles_rad[1], angles_rad[2]});
}

// What is wrong goes to `problems`, below `field`; nothing is wrong with what stands in for it.
session::TargetState target_of(const py::handle& target, const std::string& field,
                               core::ProblemList& problems) {
  session::TargetState state;
  const auto number = [&](const char* name) {
    return value_of<double>(target.attr(name), field + "." + name, problems);
  };
  state.name = value_of<std::string>(target.attr("name"), field + ".name", problems);
  state.position = {core::radians(number("latitude_deg")), core::radians(number("longitude_deg")),
                    number("height_m")};
  const std::size_t errors = problems.errors();
  collect(problems, [&] { terrain::check_geodetic(state.position, field.c_str()); });
  if (problems.errors() > errors) state.position = {};
  state.q_NB = attitude_of(target.attr("attitude_deg"), field, problems);
  if (const py::object rcs_m2 = target.attr("rcs_m2"); !rcs_m2.is_none())
    state.rcs = materials::ConstantRcs{
        within(rcs_m2, field + ".rcs_m2", problems, {0.0, 1.0e9}, "m2").value_or(0.0)};
  return state;
}

py::list set_targets(const Scene& scene, const py::sequence& targets) {
  std::vector<session::TargetState> states;
  core::ProblemList problems;
  const py::object type = py::module_::import("fanbeam._scene").attr("Target");
  for (const py::handle target : targets) {
    const std::string field = "target[" + std::to_string(states.size()) + "]";
    if (!py::isinstance(target, type)) refuse_type(field, "a fanbeam.Target", target);
    states.push_back(target_of(target, field, problems));
  }
  const std::span<const session::TargetState> all(states);
  if (problems.has_errors()) problems.append(scene.session().problems_in(all).all());
  problems.throw_if_errors();
  return problems_list(scene.session().set(all).all());
}

py::list set_weather(const Scene& scene, const py::dict& changes) {
  session::Session& session = scene.session();
  const std::shared_ptr<const scenes::Scene> now = session.scene();
  return problems_list(session
                           .set(changed_weather(now->weather, changes,
                                                now->description.sensor.waveform.frequency_Hz))
                           .all());
}

py::list set_surface(const Scene& scene, const py::handle& state) {
  core::ProblemList problems;
  const auto word = value_of<std::string>(state, "surface", problems);
  return problems_list(scene.session().set(materials::surface_state_of(word, "surface")).all());
}

// All of them; what is None is the scene's own.
py::list set_sensor(const Scene& scene, const py::handle& tilt_deg, const py::handle& stabilised,
                    const py::handle& low_dB, const py::handle& high_dB,
                    const py::handle& cscope_mode, const py::handle& noise_figure_dB) {
  core::ProblemList problems;
  session::SensorSettings settings;
  if (const auto tilt = within(tilt_deg, "tilt_deg", problems, {-90.0, 90.0}, "deg"))
    settings.boresight_elevation_rad = core::radians(*tilt);
  settings.stabilised = optional_of<bool>(stabilised, "stabilised", problems);
  const std::size_t errors = problems.errors();
  settings.low_dB = within(low_dB, "low_dB", problems, session::SensorSettings::kLevels_dB, "dB");
  settings.high_dB =
      within(high_dB, "high_dB", problems, session::SensorSettings::kLevels_dB, "dB");
  // Nothing is said of a window that one of them alone stands for.
  if (problems.errors() > errors) {
    settings.low_dB = 0.0;
    settings.high_dB = 1.0;
  }
  if (const auto figure_dB =
          within(noise_figure_dB, "noise_figure_dB", problems, {0.0, 60.0}, "dB"))
    settings.noise_figure = std::pow(10.0, *figure_dB / 10.0);
  if (const auto word = optional_of<std::string>(cscope_mode, "cscope_mode", problems)) {
    const auto& modes = sensors::Display::kCScopeModes;
    const auto* const mode = std::find(modes.begin(), modes.end(), *word);
    if (mode == modes.end())
      problems.error(core::ErrorClass::ref, {}, "cscope_mode", "\"" + *word + "\"",
                     "true_elevation, flat_earth or shadow");
    else
      settings.cscope_mode = static_cast<sensors::Display::CScopeMode>(mode - modes.begin());
  }
  if (problems.has_errors()) problems.append(scene.session().problems_in(settings).all());
  problems.throw_if_errors();
  return problems_list(scene.session().set(settings).all());
}

session::SamplingWish wish_of(const Scene& scene, const std::string& kind, double value,
                              core::ProblemList& problems) {
  if (kind == "samples") {
    core::check_range(problems, "samples_per_cell", value, renderer::kSamplesOrDefault);
    return session::Samples{value};
  }
  if (kind == "accuracy") {
    core::check_range(problems, "accuracy_grey", value, renderer::kAccuracies_grey, "grey levels");
    return session::Accuracy{value};
  }
  if (kind == "time_budget") {
    core::check_range(problems, "time_budget_ms", value, renderer::kTimeBudgets_ms, "ms");
    return session::TimeBudget{value};
  }
  return renderer::reference_sampling(scene.session().seed());
}

// The warnings, and the kind and value that give another process the same: a time budget depends on
// the machine and the moment, the samples that it came to do not.
py::tuple set_sampling(const Scene& scene, const std::string& kind, const py::handle& told) {
  core::ProblemList problems;
  const char* const field = kind == "accuracy"      ? "accuracy_grey"
                            : kind == "time_budget" ? "time_budget_ms"
                                                    : "samples_per_cell";
  const auto value = value_of<double>(told, field, problems);
  problems.throw_if_errors();
  const session::SamplingWish wish = wish_of(scene, kind, value, problems);
  problems.throw_if_errors();
  without_lock([&](const core::StopToken& stop) {
    const core::StopScope scope(stop);
    problems.append(scene.session().set(wish).all());
  });
  if (kind == "time_budget")
    return py::make_tuple(problems_list(problems.all()), "samples", scene.session().samples());
  return py::make_tuple(problems_list(problems.all()), kind, value);
}

}  // namespace

void add_conditions(py::class_<Scene>& scene) {
  scene.def("set_weather", &set_weather, py::arg("changes"))
      .def("weather",
           [](const Scene& held) { return weather_dict(held.session().scene()->weather); })
      .def("set_surface", &set_surface, py::arg("state"))
      .def("set_sensor", &set_sensor, py::arg("tilt_deg"), py::arg("stabilised"), py::arg("low_dB"),
           py::arg("high_dB"), py::arg("cscope_mode"), py::arg("noise_figure_dB"))
      .def("set_targets", &set_targets, py::arg("targets"))
      .def("set_sampling", &set_sampling, py::arg("kind"), py::arg("value"));
}

}  // namespace fanbeam::bindings
