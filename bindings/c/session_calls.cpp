// Versions, opening and closing, and what a session says of itself.
#include <filesystem>
#include <string>
#include <system_error>

#include "bindings/c/arguments.h"
#include "bindings/c/handle.h"
#include "bindings/c/last_call.h"
#include "renderer/casting/sampling.h"
#include "sensors/display/grey_scale.h"
#include "session/opening_words.h"
#include "session/shipped.h"

using namespace fanbeam;
using bindings::Arguments;
using bindings::kOpened;

namespace {

constexpr std::size_t kMostDataFolders = 256;

std::vector<std::filesystem::path> folders_of(const fanbeam_setup& setup, Arguments& arguments) {
  std::vector<std::filesystem::path> folders;
  if (setup.data_folders == nullptr) {
    if (setup.data_folder_count != 0)
      arguments.refuse(core::ErrorClass::ref, "setup.data_folders", "NULL",
                       std::to_string(setup.data_folder_count) + " folders");
    return folders;
  }
  if (setup.data_folder_count > kMostDataFolders) {
    arguments.refuse(core::ErrorClass::limit, "setup.data_folder_count",
                     std::to_string(setup.data_folder_count),
                     "at most " + std::to_string(kMostDataFolders));
    return folders;
  }
  for (std::size_t i = 0; i < setup.data_folder_count; ++i) {
    const std::string name = "setup.data_folders[" + std::to_string(i) + "]";
    if (!arguments.there(setup.data_folders[i], name, "a folder")) continue;
    folders.emplace_back(setup.data_folders[i]);
    session::check_data_folder(folders.back(), name, arguments.problems());
  }
  return folders;
}

void take_sensor(const std::string& file, Arguments& arguments, session::Setup& settings) {
  settings.sensor = file;
  std::error_code refused;
  if (!file.empty() && !std::filesystem::is_regular_file(settings.sensor, refused))
    arguments.refuse(core::ErrorClass::io, "setup.sensor_file", "\"" + file + "\" not found",
                     "a sensor file");
}

session::Setup settings_of(const fanbeam_setup& setup, Arguments& arguments) {
  session::Setup settings;
  if (arguments.there(setup.shipped_folder, "setup.shipped_folder",
                      "the folder with scenes/, sensors/ and materials/"))
    settings.shipped = setup.shipped_folder;
  settings.data_folders = folders_of(setup, arguments);
  take_sensor(bindings::text_of(setup.sensor_file), arguments, settings);
  settings.build.read.power = true;  // bscope_W and cscope_W_m3 of any frame
  if (setup.realisation == FANBEAM_EXPECTED || setup.realisation == FANBEAM_SAMPLE)
    settings.sample = setup.realisation == FANBEAM_SAMPLE;
  else if (setup.realisation != FANBEAM_AS_SCENE)
    arguments.refuse(core::ErrorClass::range, "setup.realisation",
                     std::to_string(setup.realisation),
                     "FANBEAM_AS_SCENE, FANBEAM_EXPECTED or FANBEAM_SAMPLE");
  session::take_words(bindings::text_of(setup.effects), bindings::text_of(setup.caster), "setup.",
                      settings, arguments.problems());
  settings.keeps_time_budget = !(setup.samples_per_cell > 0.0);
  settings.seed = setup.seed;
  if (setup.threads < 0 || setup.threads > 1024)
    arguments.refuse(core::ErrorClass::range, "setup.threads", std::to_string(setup.threads),
                     "0 to 1024");
  settings.threads = setup.threads;
  arguments.number(setup.samples_per_cell, "setup.samples_per_cell", renderer::kSamplesOrDefault);
  if (setup.bscope_alone != 0 && setup.bscope_alone != 1)
    arguments.refuse(core::ErrorClass::range, "setup.bscope_alone",
                     std::to_string(setup.bscope_alone), "0 or 1");
  settings.build.heights_shown = setup.bscope_alone == 0;
  return settings;
}

fanbeam_facts facts_of(const scenes::Scene& scene) {
  const sensors::Sensor& sensor = scene.description.sensor;
  fanbeam_facts facts{};
  facts.size = sizeof facts;
  facts.columns = static_cast<std::uint32_t>(sensor.scan.columns);
  facts.bscope_rows = static_cast<std::uint32_t>(sensor.range.cells);
  facts.cscope_rows = static_cast<std::uint32_t>(sensor.display.cscope_rows);
  facts.frame_count = static_cast<std::uint32_t>(scene.frame_count());
  facts.range_minimum_m = sensor.range.minimum_m;
  facts.range_cell_m = sensor.range.cell_m;
  facts.field_of_view_rad = sensor.scan.field_of_view_rad;
  facts.cscope_top_rad = sensor.display.cscope_top_rad;
  facts.cscope_span_rad = sensor.display.cscope_span_rad;
  facts.frame_rate_Hz = sensor.scan.frame_rate_Hz;
  const sensors::GreyScale grey(sensor);
  facts.low_dB = grey.low_dB();
  facts.high_dB = grey.high_dB();
  return facts;
}

}  // namespace

extern "C" {

fanbeam_status fanbeam_open(const char* scene, const fanbeam_setup* setup,
                            fanbeam_session** session) noexcept {
  if (session != nullptr) *session = nullptr;
  return bindings::guarded([&] {
    Arguments arguments;
    constexpr const char* kScene = "a folder with scene.toml, or that file";
    if (arguments.there(scene, "scene", kScene) && *scene == '\0')
      arguments.refuse(core::ErrorClass::io, "scene", "\"\"", kScene);
    arguments.there(session, "session", "a place for the session");
    session::Setup settings;
    if (arguments.sized(setup, "setup")) settings = settings_of(*setup, arguments);
    arguments.done();
    core::ProblemList problems;
    auto opened = std::make_unique<fanbeam_session>(scene, settings, problems);
    if (setup->samples_per_cell > 0.0)
      problems.append(opened->held.set(session::Samples{setup->samples_per_cell}).all());
    bindings::tell_warnings(problems);
    *session = opened.release();
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_stop(fanbeam_session* session) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    arguments.done();
    session->stop.request();
    return FANBEAM_OK;
  });
}

void fanbeam_close(fanbeam_session* session) noexcept { delete session; }

fanbeam_status fanbeam_get_facts(fanbeam_session* session, fanbeam_facts* facts) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    arguments.sized(facts, "facts");
    arguments.done();
    *facts = facts_of(*session->held.scene());
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_flown_pose(fanbeam_session* session, uint32_t frame,
                                  fanbeam_pose* pose) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    arguments.sized(pose, "pose");
    arguments.done();
    const std::shared_ptr<const scenes::Scene> scene = session->held.scene();
    const int frames = scene->frame_count();
    if (frame >= static_cast<std::uint32_t>(frames))
      arguments.refuse(
          core::ErrorClass::range, "frame", std::to_string(frame),
          frames == 0 ? "a scene with a [trajectory]" : "0 to " + std::to_string(frames - 1));
    arguments.done();
    const scenes::Trajectory& flight = *scene->trajectory;
    *pose = bindings::pose_of(flight.at(flight.frame_time_s(
        static_cast<int>(frame), scene->description.sensor.scan.frame_rate_Hz)));
    return FANBEAM_OK;
  });
}

}  // extern "C"
