#include "bindings/python/scene.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "bindings/python/convert.h"
#include "bindings/python/frame.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/scene_handle.h"
#include "bindings/python/weather_fields.h"
#include "core/number_range.h"
#include "core/units.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"
#include "scenes/ground_below.h"
#include "sensors/display/grey_scale.h"
#include "session/labels/labels_json.h"
#include "session/records/run_record.h"
#include "session/sampling_choice.h"
#include "terrain/local_frame.h"

namespace fanbeam::bindings {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<Scene> open(const fs::path& scene, const fs::path& shipped,
                            const std::vector<fs::path>& data, const fs::path& sensor,
                            const std::string& effects, const std::string& caster,
                            std::optional<bool> sample, std::uint64_t seed, int threads,
                            py::list& warnings) {
  refuse_in_fork();
  session::Setup setup;
  setup.shipped = shipped;
  setup.data_folders = data;
  setup.sensor = sensor;
  setup.build.read = {.power = true, .labels = true};  // any frame may be asked for both
  if (!effects.empty()) setup.build.wishes = renderer::parse_effect_wishes(effects);
  if (!caster.empty()) {
    const auto& words = renderer::kCasterWishes;
    if (std::find(words.begin(), words.end(), caster) == words.end())
      core::throw_input_error(core::ErrorClass::ref, "caster", "\"" + caster + "\"",
                              "rays, profile or auto");
    setup.build.caster = renderer::caster_wish(caster);
  }
  setup.sample = sample;
  setup.keeps_time_budget = true;
  setup.seed = seed;
  core::require_range("threads", threads, {0, 1024});
  setup.threads = threads;
  core::ProblemList problems;
  std::unique_ptr<Scene> opened;
  without_lock([&](const core::StopToken& stop) {
    const core::StopScope scope(stop);
    opened = std::make_unique<Scene>(scene, setup, problems);
  });
  for (const py::handle warning : problems_list(problems.all())) warnings.append(warning);
  return opened;
}

// What is wrong goes to `problems`, below `field`.
session::TargetState target_of(const py::handle& target, const std::string& field,
                               core::ProblemList& problems) {
  session::TargetState state;
  const auto number = [&](const char* name) {
    return value_of<double>(target.attr(name), field + "." + name);
  };
  state.name = value_of<std::string>(target.attr("name"), field + ".name");
  state.position = {core::radians(number("latitude_deg")), core::radians(number("longitude_deg")),
                    number("height_m")};
  try {
    terrain::check_geodetic(state.position, field.c_str());
  } catch (const core::InputError& error) {
    problems.append(error.problems());
  }
  const auto attitude = value_of<std::optional<std::array<double, 3>>>(
      target.attr("attitude_deg"), field + ".attitude_deg", "roll, pitch and heading");
  if (attitude) {
    constexpr std::array<const char*, 3> kAngles = {".roll_deg", ".pitch_deg", ".heading_deg"};
    for (std::size_t i = 0; i < kAngles.size(); ++i)
      core::check_range(problems, field + kAngles[i], (*attitude)[i], {}, "deg");
    state.q_NB =
        core::quaternion_from({core::radians((*attitude)[0]), core::radians((*attitude)[1]),
                               core::radians((*attitude)[2])});
  }
  const auto rcs_m2 =
      value_of<std::optional<double>>(target.attr("rcs_m2"), field + ".rcs_m2", "a number or None");
  if (rcs_m2) {
    core::check_range(problems, field + ".rcs_m2", *rcs_m2, {0.0, 1.0e9}, "m2");
    state.rcs = materials::ConstantRcs{*rcs_m2};
  }
  return state;
}

py::list set_targets(const Scene& scene, const py::sequence& targets) {
  std::vector<session::TargetState> states;
  core::ProblemList problems;
  for (const py::handle target : targets)
    states.push_back(target_of(target, "target[" + std::to_string(states.size()) + "]", problems));
  problems.throw_if_errors();
  return problems_list(scene.session().set(std::span<const session::TargetState>(states)).all());
}

py::list set_weather(const Scene& scene, const py::dict& changes) {
  session::Session& session = scene.session();
  return problems_list(session.set(changed_weather(session.scene()->weather, changes)).all());
}

py::list set_surface(const Scene& scene, const std::string& word) {
  return problems_list(scene.session().set(materials::surface_state_of(word, "surface")).all());
}

// All of them; what is None is the scene's own.
py::list set_sensor(const Scene& scene, std::optional<double> tilt_deg,
                    std::optional<bool> stabilised, std::optional<double> low_dB,
                    std::optional<double> high_dB, const std::optional<std::string>& cscope_mode,
                    std::optional<double> noise_figure_dB) {
  session::SensorSettings settings;
  if (tilt_deg) {
    core::require_range("tilt_deg", *tilt_deg, {-90.0, 90.0}, "deg");
    settings.boresight_elevation_rad = core::radians(*tilt_deg);
  }
  settings.stabilised = stabilised;
  settings.low_dB = low_dB;
  settings.high_dB = high_dB;
  if (noise_figure_dB) {
    core::require_range("noise_figure_dB", *noise_figure_dB, {0.0, 60.0}, "dB");
    settings.noise_figure = std::pow(10.0, *noise_figure_dB / 10.0);
  }
  if (cscope_mode) {
    const auto& modes = sensors::Display::kCScopeModes;
    const auto* const mode = std::find(modes.begin(), modes.end(), *cscope_mode);
    if (mode == modes.end())
      core::throw_input_error(core::ErrorClass::ref, "cscope_mode", "\"" + *cscope_mode + "\"",
                              "true_elevation, flat_earth or shadow");
    settings.cscope_mode = static_cast<sensors::Display::CScopeMode>(mode - modes.begin());
  }
  return problems_list(scene.session().set(settings).all());
}

py::list set_sampling(const Scene& scene, const std::string& kind, double value) {
  session::SamplingWish wish;
  if (kind == "samples") {
    if (value != 0.0) core::require_range("samples_per_cell", value, renderer::kSamplesPerCell);
    wish = session::Samples{value};
  } else if (kind == "accuracy") {
    core::require_range("accuracy_grey", value, renderer::kAccuracies_grey, "grey levels");
    wish = session::Accuracy{value};
  } else if (kind == "time_budget") {
    core::require_range("time_budget_ms", value, renderer::kTimeBudgets_ms, "ms");
    wish = session::TimeBudget{value, {}};
  } else {
    wish = renderer::reference_sampling(scene.session().seed());
  }
  core::ProblemList problems;
  without_lock([&](const core::StopToken& stop) {
    const core::StopScope scope(stop);
    problems.append(scene.session().set(wish).all());
  });
  return problems_list(problems.all());
}

py::dict render(const Scene& scene, const PoseNumbers& pose, std::uint64_t frame_index, bool bscope,
                bool cscope, bool layers, bool cscope_layers, bool labels) {
  const session::Session& session = scene.session();
  renderer::Products wanted;
  wanted.bscope = bscope || labels;
  wanted.cscope = cscope;
  wanted.cscope_layers = cscope_layers || labels;
  wanted.layers = layers || wanted.cscope_layers;
  const core::Pose at = pose_of(pose);
  const session::Session::Moment now = session.now();
  const auto frame = std::make_shared<renderer::Frame>();
  const std::shared_ptr<const scenes::Scene> under = session.scene(now);
  std::string text;
  without_lock([&](const core::StopToken& stop) {
    *frame = session.render(now, at, frame_index, wanted, stop);
    if (!labels) return;
    const session::FrameLabels found = scene.labeller(under)->labels(*under, at, *frame);
    text = session::labels_json(found, *under, frame_index, at, {});
  });
  wanted.bscope = bscope;
  wanted.layers = layers;
  wanted.cscope_layers = cscope_layers;
  py::dict result = frame_dict(frame, wanted, under->description.sensor);
  result["labels"] = labels ? py::object(py::str(text)) : py::object(py::none());
  result["sampling"] = session::caster_text(session.sampling(now));
  return result;
}

// Of the scene's flight; counted from its end where negative, as Python does.
int frame_number(const Scene& scene, long long index) {
  const int frames = scene.session().scene()->frame_count();
  if (index >= -frames && index < frames)
    return static_cast<int>(index < 0 ? index + frames : index);
  const std::string last = std::to_string(frames - 1);
  core::throw_input_error(core::ErrorClass::range, "frame", std::to_string(index),
                          frames == 0 ? "a pose: the scene has no flight"
                                      : "0 to " + last + ", or -1 to -" + std::to_string(frames) +
                                            " from the end: a frame of the flight");
}

// A row for each frame of the scene's flight.
py::array_t<double> trajectory(const Scene& scene) {
  const std::shared_ptr<const scenes::Scene> now = scene.session().scene();
  const int frames = now->frame_count();
  py::array_t<double> rows({static_cast<std::size_t>(frames), std::tuple_size_v<PoseNumbers>});
  auto to = rows.mutable_unchecked<2>();
  for (int frame = 0; frame < frames; ++frame) {
    const PoseNumbers numbers = numbers_of(now->trajectory->at(
        now->trajectory->frame_time_s(frame, now->description.sensor.scan.frame_rate_Hz)));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      to(frame, static_cast<py::ssize_t>(i)) = numbers[i];
  }
  return rows;
}

// Above the ellipsoid; None where there is no ground.
std::optional<double> ground_height_m(const Scene& scene, double latitude_deg,
                                      double longitude_deg) {
  const core::Geodetic at =
      pose_of({0.0, latitude_deg, longitude_deg, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}).position;
  const auto ground = scenes::ground_below(*scene.session().scene(), at);
  if (!ground) return std::nullopt;
  return ground->height_m;
}

py::list plan(const Scene& scene) {
  py::list rows;
  for (const core::EffectDecision& decision : scene.session().scene()->plan.decisions)
    rows.append(py::make_tuple(core::name_of(decision.effect), decision.on, decision.reason,
                               decision.bound_grey, decision.bound_dB));
  return rows;
}

py::dict facts(const Scene& scene) {
  const std::shared_ptr<const scenes::Scene> now = scene.session().scene();
  const sensors::Sensor& sensor = now->description.sensor;
  const renderer::Geometry& geometry = *now->world.geometry;
  std::vector<std::string> objects = geometry.object_names;
  for (const renderer::PointTarget& target : now->world.targets) objects.push_back(target.name);
  const sensors::GreyScale grey(sensor);
  py::dict result;
  result["name"] = now->description.name;
  result["sensor"] = sensor.name;
  result["frequency_Hz"] = sensor.waveform.frequency_Hz;
  result["frame_rate_Hz"] = sensor.scan.frame_rate_Hz;
  result["columns"] = sensor.scan.columns;
  result["field_of_view_rad"] = sensor.scan.field_of_view_rad;
  result["range_minimum_m"] = sensor.range.minimum_m;
  result["range_cell_m"] = sensor.range.cell_m;
  result["range_cells"] = sensor.range.cells;
  result["cscope_rows"] = sensor.display.cscope_rows;
  result["cscope_top_rad"] = sensor.display.cscope_top_rad;
  result["cscope_span_rad"] = sensor.display.cscope_span_rad;
  result["window_dB"] = py::make_tuple(grey.low_dB(), grey.high_dB());
  result["noise_W"] = sensor.noise_power_W();
  result["caster"] = renderer::name_of(now->caster.chosen);
  result["caster_reason"] = now->caster.reason;
  result["surface"] = name_of(now->description.surface_state);
  result["materials"] = geometry.material_names;
  result["objects"] = objects;
  return result;
}

}  // namespace

void add_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene", "Of fanbeam.Scene, which documents it.")
      .def(py::init(&open), py::arg("scene"), py::arg("shipped"), py::arg("data"),
           py::arg("sensor"), py::arg("effects"), py::arg("caster"), py::arg("sample"),
           py::arg("seed"), py::arg("threads"), py::arg("warnings"))
      .def("set_weather", &set_weather, py::arg("changes"))
      .def("weather",
           [](const Scene& scene) { return weather_dict(scene.session().scene()->weather); })
      .def("set_surface", &set_surface, py::arg("state"))
      .def("set_sensor", &set_sensor, py::arg("tilt_deg"), py::arg("stabilised"), py::arg("low_dB"),
           py::arg("high_dB"), py::arg("cscope_mode"), py::arg("noise_figure_dB"))
      .def("set_targets", &set_targets, py::arg("targets"))
      .def("set_sampling", &set_sampling, py::arg("kind"), py::arg("value"))
      .def("render", &render, py::arg("pose"), py::arg("frame_index"), py::arg("bscope"),
           py::arg("cscope"), py::arg("layers"), py::arg("cscope_layers"), py::arg("labels"))
      .def("frame_number", &frame_number, py::arg("index"))
      .def("ground_height_m", &ground_height_m, py::arg("latitude_deg"), py::arg("longitude_deg"))
      .def("trajectory", &trajectory)
      .def("plan", &plan)
      .def("facts", &facts);
}

}  // namespace fanbeam::bindings
