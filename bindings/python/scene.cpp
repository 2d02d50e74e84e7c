#include "bindings/python/scene.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>
#include <utility>

#include "bindings/python/convert.h"
#include "bindings/python/frame.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/scene_conditions.h"
#include "bindings/python/scene_handle.h"
#include "core/parallel.h"
#include "core/units.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/stages/frame_layers.h"
#include "scenes/ground_below.h"
#include "sensors/display/grey_scale.h"
#include "session/labels/labels_json.h"
#include "session/opening_words.h"
#include "session/records/run_record.h"
#include "session/sampling_choice.h"
#include "session/shipped.h"

namespace fanbeam::bindings {
namespace {

namespace fs = std::filesystem;

// What Scene is opened with, but for the folders of data: looked up and checked, all that is wrong
// told together.
py::dict checked_setup(const py::handle& scene, const py::handle& sensor, const py::handle& data,
                       const py::handle& effects, const py::handle& caster,
                       const py::handle& sample, const py::handle& cscope, const py::handle& seed,
                       const py::handle& threads, const fs::path& shipped) {
  core::ProblemList problems;
  py::dict setup;
  setup["shipped"] = shipped;
  const auto name = value_of<fs::path>(scene, "scene", problems);
  collect(problems, [&] { setup["scene"] = fs::absolute(session::find_scene(name, shipped)); });
  setup["sensor"] = "";
  if (const auto file = optional_of<fs::path>(sensor, "sensor", problems))
    collect(problems, [&] {
      setup["sensor"] = fs::absolute(session::find_sensor(*file, shipped, "sensor"));
    });
  if (const auto folder = optional_of<fs::path>(data, "data", problems))
    session::check_data_folder(*folder, "data", problems);
  const auto wishes = value_of<std::string>(effects, "effects", problems);
  const auto drawn = optional_of<bool>(sample, "sample", problems);
  const auto word = value_of<std::string>(caster, "caster", problems);
  session::Setup taken;
  taken.sample = drawn;
  session::take_words(wishes, word, "", taken, problems);
  setup["effects"] = wishes;
  setup["caster"] = word;
  setup["sample"] = drawn;
  setup["cscope"] = value_of<bool>(cscope, "cscope", problems);
  setup["seed"] = value_of<std::uint64_t>(seed, "seed", problems);
  setup["threads"] = number_of<int>(threads, "threads", problems, {0, 1024});
  problems.throw_if_errors();
  return setup;
}

// Of what checked_setup gave. A scene's time budget is measured where `keeps_time_budget`.
std::unique_ptr<Scene> open(const fs::path& scene, const fs::path& shipped,
                            const std::vector<fs::path>& data, const fs::path& sensor,
                            const std::string& effects, const std::string& caster,
                            std::optional<bool> sample, bool cscope, std::uint64_t seed,
                            int threads, bool keeps_time_budget, py::list& warnings) {
  refuse_in_fork();
  session::Setup setup;
  setup.shipped = shipped;
  setup.data_folders = data;
  setup.sensor = sensor;
  setup.build.read = {.power = true, .labels = true};  // any frame may be asked for both
  setup.build.heights_shown = cscope;
  setup.sample = sample;
  setup.keeps_time_budget = keeps_time_budget;
  setup.seed = seed;
  setup.threads = threads;
  core::ProblemList problems;
  session::take_words(effects, caster, "", setup, problems);
  problems.throw_if_errors();
  std::unique_ptr<Scene> opened;
  without_lock([&](const core::StopToken& stop) {
    const core::StopScope scope(stop);
    opened = std::make_unique<Scene>(scene, setup, problems);
  });
  for (const py::handle warning : problems_list(problems.all())) warnings.append(warning);
  return opened;
}

// What set_sampling gives of the scene's own time budget, for a scene that was just opened with it;
// None without one.
std::optional<std::pair<std::string, double>> own_budget(const Scene& scene) {
  const std::shared_ptr<const scenes::Scene> now = scene.session().scene();
  if (!(now->description.time_budget_ms > 0.0) || now->frame_count() == 0) return std::nullopt;
  return std::pair("samples", scene.session().samples());
}

py::dict render(const Scene& scene, const py::tuple& pose, const py::handle& frame_index,
                const py::handle& bscope, const py::handle& cscope, const py::handle& layers,
                const py::handle& cscope_layers, const py::handle& labels) {
  const session::Session& session = scene.session();
  core::ProblemList problems;
  const core::Pose at = pose_of(pose, problems);
  const auto number = value_of<std::uint64_t>(frame_index, "frame_index", problems);
  renderer::Products shown;
  shown.bscope = value_of<bool>(bscope, "bscope", problems);
  shown.cscope = value_of<bool>(cscope, "cscope", problems);
  shown.layers = value_of<bool>(layers, "layers", problems);
  shown.cscope_layers = value_of<bool>(cscope_layers, "cscope_layers", problems);
  const bool labelled = value_of<bool>(labels, "labels", problems);
  const std::pair<const char*, bool> with_heights[] = {
      {"cscope", shown.cscope}, {"cscope_layers", shown.cscope_layers}, {"labels", labelled}};
  for (const auto& [field, asked] : with_heights)
    if (asked && !session.opened()->options.heights_shown)
      problems.error(core::ErrorClass::ref, {}, field, "True",
                     "False, as the scene was opened with cscope=False");
  if (!shown.bscope && !shown.cscope && !shown.layers && !shown.cscope_layers && !labelled)
    problems.error(core::ErrorClass::ref, {}, "bscope, cscope, layers, cscope_layers, labels",
                   "all False", "True for at least one of them");
  problems.throw_if_errors();
  renderer::Products wanted = shown;
  wanted.bscope = shown.bscope || labelled;
  wanted.cscope_layers = shown.cscope_layers || labelled;
  wanted.layers = shown.layers || wanted.cscope_layers;
  const session::Session::Moment now = session.now();
  const auto frame = std::make_shared<renderer::Frame>();
  const std::shared_ptr<const scenes::Scene> under = session.scene(now);
  std::string text;
  without_lock([&](const core::StopToken& stop) {
    *frame = session.render(now, at, number, wanted, stop);
    if (!labelled) return;
    const core::ThreadLimit limit(session.threads());
    const session::FrameLabels found = scene.labeller(under)->labels(*under, at, *frame);
    text = session::labels_json(found, *under, number, at, {});
  });
  py::dict result = frame_dict(frame, shown, under->description.sensor);
  result["labels"] = labelled ? py::object(py::str(text)) : py::object(py::none());
  result["sampling"] = session::caster_text(session.sampling(now));
  return result;
}

// Of the scene's flight; counted from its end where negative, as Python does. `expected`: what the
// caller takes.
int frame_number(const Scene& scene, const py::handle& told, const char* expected) {
  const int frames = scene.session().scene()->frame_count();
  core::ProblemList problems;
  const auto index = value_of<long long>(told, "frame", problems, expected);
  if (!problems.has_errors() && index >= -frames && index < frames)
    return static_cast<int>(index < 0 ? index + frames : index);
  const std::string last = std::to_string(frames - 1);
  core::throw_input_error(core::ErrorClass::range, "frame", shown(whole_number(told)),
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
std::optional<double> ground_height_m(const Scene& scene, const py::handle& latitude_deg,
                                      const py::handle& longitude_deg) {
  core::ProblemList problems;
  const core::Geodetic at{core::radians(number_of<double>(latitude_deg, "latitude_deg", problems,
                                                          {-90.0, 90.0}, "deg")),
                          core::radians(number_of<double>(longitude_deg, "longitude_deg", problems,
                                                          {-540.0, 540.0}, "deg")),
                          0.0};
  problems.throw_if_errors();
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
  std::vector<std::string> objects;
  while (const std::string* name =
             renderer::object_name(now->world, static_cast<terrain::ObjectId>(objects.size())))
    objects.push_back(*name);
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
  result["materials"] = now->world.geometry->material_names;
  result["objects"] = objects;
  return result;
}

}  // namespace

void add_scene(py::module_& module) {
  module.def("checked_setup", &checked_setup, py::arg("scene"), py::arg("sensor"), py::arg("data"),
             py::arg("effects"), py::arg("caster"), py::arg("sample"), py::arg("cscope"),
             py::arg("seed"), py::arg("threads"), py::arg("shipped"));
  py::class_<Scene> scene(module, "Scene", "Of fanbeam.Scene, which documents it.");
  add_conditions(scene);
  scene
      .def(py::init(&open), py::arg("scene"), py::arg("shipped"), py::arg("data"),
           py::arg("sensor"), py::arg("effects"), py::arg("caster"), py::arg("sample"),
           py::arg("cscope"), py::arg("seed"), py::arg("threads"), py::arg("keeps_time_budget"),
           py::arg("warnings"))
      .def("own_budget", &own_budget)
      .def("render", &render, py::arg("pose"), py::arg("frame_index"), py::arg("bscope"),
           py::arg("cscope"), py::arg("layers"), py::arg("cscope_layers"), py::arg("labels"))
      .def("frame_number", &frame_number, py::arg("index"), py::arg("expected") = "a whole number")
      .def("ground_height_m", &ground_height_m, py::arg("latitude_deg"), py::arg("longitude_deg"))
      .def("trajectory", &trajectory)
      .def("plan", &plan)
      .def("facts", &facts);
}

}  // namespace fanbeam::bindings
