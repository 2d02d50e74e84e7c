#include "datasets/worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "core/files.h"
#include "core/image.h"
#include "core/stop.h"
#include "datasets/airport_scene.h"
#include "datasets/record_seal.h"
#include "datasets/run_conditions.h"
#include "datasets/run_flight.h"
#include "datasets/run_lock.h"
#include "datasets/sha256.h"
#include "session/products/frame_output.h"
#include "session/products/layers_product.h"
#include "session/products/products.h"
#include "session/records/conditions_json.h"
#include "session/records/output_folder.h"
#include "session/records/record_json.h"
#include "session/records/run_record.h"
#include "session/shipped.h"
#include "session/version.h"
#include "terrain/ray_scene.h"

namespace fanbeam::datasets {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct MadeFrame {
  session::FrameRecord record;
  std::vector<std::string> files;
};

namespace {

constexpr int kFrameBits = 24;  // of the number that keys what is random; the run's stands above

fs::path hidden(const fs::path& campaign, int run, const char* ending) {
  return campaign / "runs" / fmt::format(".{:06}{}", run, ending);
}

// Relative to the folder.
std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

Json value_json(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::get<std::string>(value);
}

void write_failure(const Campaign& campaign, const fs::path& output, int run, const Draw& draw,
                   const std::vector<core::Problem>& problems) {
  Json json = {{"fanbeam_failed_run", 1},
               {"campaign", campaign.name},
               {"campaign_sha256", campaign.text_hash},
               {"run", run}};
  for (const auto& [name, value] : draw.values) json["parameters"][name] = value_json(value);
  json["problems"] = Json::array();
  for (const core::Problem& problem : problems) json["problems"].push_back(to_string(problem));
  core::write_file_atomically(failed_file(output, run), json.dump(1) + "\n");
}

session::RunRecord settings_of(const session::Session& session, const session::Session::Moment& now,
                               const session::ProductSet& products) {
  session::RunRecord settings;
  settings.choice.sampling = session.sampling(now);
  settings.wanted = session::wanted_of(products);
  settings.seed = session.seed();
  return settings;
}

// A scene's own flight is refused for the same.
void check_above_ground(const scenes::Scene& scene, const std::string& name,
                        const session::FrameRecord& frame) {
  const glm::dvec3 at_m =
      renderer::antenna_of(scene.description.sensor, scene.pose_at(frame.pose)).position_m;
  const terrain::RayScene& surfaces = scene.world.surfaces();
  if (!surfaces.in_ground(at_m)) return;
  const double depth_m = std::max(0.01, -surfaces.height_above_ground_m(at_m));
  core::throw_input_error(
      core::ErrorClass::range, core::Place{name}, "flight",
      fmt::format("frame {} with the antenna {:.2f} m inside the ground", frame.index, depth_m),
      "an antenna above the ground in every frame; flight.vertical_m, lateral_m, turbulence_m and "
      "campaign.frames say where it is");
}

// Where a run is made. A worker that was killed leaves it to the next on this machine.
fs::path making_place(const Campaign& campaign, const fs::path& output, int run) {
  if (!campaign.archives) return hidden(output, run, "");
  const std::string whole = fs::absolute(output).lexically_normal().string() + campaign.text_hash;
  return fs::temp_directory_path() /
         fmt::format("fanbeam-{}-{:06}", sha256(whole).substr(0, 16), run);
}

}  // namespace

fs::path failed_file(const fs::path& campaign, int run) {
  return campaign / "failed" / fmt::format("{:06}.json", run);
}

// A scene held open, and what it was when it was opened.
struct Worker::Stage {
  std::string scene;
  std::unique_ptr<session::Session> session;
  std::shared_ptr<const scenes::Scene> own;
  std::string input;                   // kSceneInput
  std::vector<core::Problem> refused;  // why it could not be opened
};

Worker::Worker(const Campaign& campaign, WorkerSettings settings)
    : campaign_(campaign), settings_(std::move(settings)), drawer_(campaign) {
  core::limit_instructions(campaign.isa, "campaign.isa");
}

Worker::~Worker() = default;

Worker::Stage& Worker::stage_of(const std::string& scene) {
  if (stage_ && stage_->scene == scene) {
    if (stage_->refused.empty()) return *stage_;
    throw core::InputError(stage_->refused);
  }
  stage_.reset();  // before the next takes its memory
  stage_ = std::make_unique<Stage>();
  stage_->scene = scene;
  try {
    session::Setup setup;
    setup.shipped = settings_.shipped;
    setup.data_folders = settings_.data_folders;
    if (!campaign_.airports.empty())
      setup.data_folders.insert(setup.data_folders.begin(), campaign_.folder());
    setup.sample = campaign_.sample;
    setup.seed = campaign_.seed;
    const session::ProductSet products(campaign_.products.begin(), campaign_.products.end());
    session::plan_for(products, setup.build);
    if (!campaign_.sensor.empty())
      setup.sensor = session::find_sensor(campaign_.sensor, settings_.shipped, "campaign.sensor",
                                          campaign_.folder());
    core::ProblemList problems;
    stage_->session = std::make_unique<session::Session>(scene_path(scene), setup, problems);
    stage_->own = stage_->session->scene();
    keep_warnings(scene, problems);
    if (stage_->own->frame_count() == 0)
      core::throw_input_error(core::ErrorClass::ref, core::Place{scene}, "[trajectory]", "missing",
                              "a scene with a flight");
    if (campaign_.samples_per_cell > 0.0)
      stage_->session->set(session::Samples{campaign_.samples_per_cell});
    stage_->input = session::input_fingerprint(
        *stage_->own, settings_of(*stage_->session, stage_->session->now(), products));
  } catch (const core::InputError& error) {
    stage_->refused = error.problems();
    throw;
  }
  return *stage_;
}

// Never of the working directory: a run is a pure function of the campaign's file and its number.
fs::path Worker::scene_path(const std::string& name) const {
  for (const CampaignAirport& airport : campaign_.airports)
    if (airport.name == name)
      return airport_scene(campaign_, airport, settings_.output, settings_.data_folders);
  return session::find_scene(name, settings_.shipped, campaign_.folder());
}

RunEnd Worker::make(int run) {
  const auto there = [&] {
    return !settings_.replace && RunFiles::is_there(settings_.output, run);
  };
  const fs::path lock_file = hidden(settings_.output, run, ".lock");
  if (there()) {
    // Of a worker that was killed when its run had its name already.
    remove_unheld(lock_file);
    return RunEnd::there;
  }
  std::error_code made;
  fs::create_directories(settings_.output / "runs", made);
  const RunLock lock(lock_file);
  if (!lock.held()) return RunEnd::elsewhere;
  if (there()) return RunEnd::there;
  const fs::path making = making_place(campaign_, settings_.output, run);
  const auto clear = [&] {
    std::error_code ignored;
    fs::remove_all(making, ignored);
    fs::remove(hidden(settings_.output, run, ".tar"), ignored);
  };
  clear();  // what a worker left that was killed
  const auto begin = std::chrono::steady_clock::now();
  Draw draw;
  draw.run = run;
  try {
    draw = drawer_.draw(run);
    render(draw, making);
    put_in_place(run, making);
  } catch (const core::InputError& error) {
    clear();
    const auto& problems = error.problems();
    // A full disk is no fault of the run.
    const std::string& file = problems.front().place.file;
    if (error.has(core::ErrorClass::io) &&
        (file.starts_with(making.string()) ||
         file.starts_with(hidden(settings_.output, run, "").string())))
      throw;
    refused_ = problems;
    write_failure(campaign_, settings_.output, run, draw, problems);
    return RunEnd::failed;
  } catch (...) {
    clear();
    throw;
  }
  fs::remove(failed_file(settings_.output, run));
  cost_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return RunEnd::made;
}

// Of a scene's own weather they are told with its line first, then without a place of what is set.
void Worker::keep_warnings(const std::string& scene, const core::ProblemList& found) {
  constexpr std::string_view kWeather = "weather.";
  for (core::Problem problem : found.all()) {
    if (problem.place.file.empty()) problem.place.file = scene;
    core::Problem reason = problem;
    reason.value.clear();  // another in each run
    if (reason.field.starts_with(kWeather)) {
      reason.field.erase(0, kWeather.size());
      reason.place = core::Place{scene};
    }
    if (told_.insert(core::to_string(reason)).second) warnings_.push_back(std::move(problem));
  }
}

std::vector<core::Problem> Worker::new_warnings() { return std::exchange(warnings_, {}); }

void Worker::put_in_place(int run, const fs::path& made) const {
  const fs::path folder = run_folder(settings_.output, run);
  const fs::path archive = run_archive(settings_.output, run);
  if (campaign_.archives) {
    std::vector<std::string> names = {kRunRecord};
    for (const std::string& name : files_below(made))
      if (name != kRunRecord) names.push_back(name);
    const fs::path packing = hidden(settings_.output, run, ".tar");
    pack(made, names, packing);
    fs::remove_all(made);
    fs::rename(packing, archive);
    fs::remove_all(folder);
  } else {
    fs::remove_all(folder);
    fs::rename(made, folder);
    fs::remove(archive);
  }
}

void Worker::render(const Draw& draw, const fs::path& folder) {
  Stage& stage = stage_of(scene_of(campaign_, draw));
  session::Session& session = *stage.session;
  keep_warnings(stage.scene, set_conditions(session, campaign_, draw, *stage.own));
  const session::Session::Moment now = session.now();
  const std::shared_ptr<const scenes::Scene> scene = session.scene(now);
  const session::ProductSet products(campaign_.products.begin(), campaign_.products.end());
  std::unique_ptr<const session::Labeller> labeller;
  if (session::want_labels(products)) labeller = std::make_unique<const session::Labeller>(*scene);

  session::RunRecord settings = settings_of(session, now, products);
  settings.set = session::changed_conditions_json(*stage.own, *scene);
  const session::OutputSettings output{products, session::input_fingerprint(*scene, settings),
                                       settings.choice.sampling, "", labeller.get()};
  std::vector<MadeFrame> frames;
  session::FrameWriter writer(folder, products, scene->description.sensor);
  for (const int index : frames_of(campaign_.frames, stage.own->frame_count())) {
    core::throw_if_stopped();
    MadeFrame made;
    made.record.index = index;
    made.record.pose = run_pose(draw, campaign_.seed,
                                stage.own->trajectory->at(stage.own->trajectory->frame_time_s(
                                    index, stage.own->description.sensor.scan.frame_rate_Hz)),
                                stage.own->trajectory->begin_s());
    made.record.time_s = made.record.pose.time_s;
    check_above_ground(*scene, stage.scene, made.record);
    const std::uint64_t key =
        (static_cast<std::uint64_t>(draw.run) << kFrameBits) + static_cast<std::uint64_t>(index);
    renderer::Frame frame =
        session.render(now, made.record.pose, key, session::wanted_of(products));
    writer.push(session::frame_output(*scene, output, std::move(frame), made.record));
    for (const std::string& file : session::frame_files(products, index))
      made.files.push_back(file);
    frames.push_back(std::move(made));
  }
  writer.finish();
  if (products.contains("layers") || products.contains("cscope_layers"))
    core::write_file_atomically(folder / session::kLayersFile, session::layers_json(*scene));
  cost_.bytes = write_record(draw, stage, folder, output.fingerprint, frames);
  cost_.frames = static_cast<int>(frames.size());
}

std::uint64_t Worker::write_record(const Draw& draw, const Stage& stage, const fs::path& folder,
                                   const std::string& fingerprint,
                                   const std::vector<MadeFrame>& frames) const {
  Json json = {{"fanbeam_run", 1},
               {"campaign", campaign_.name},
               {"campaign_sha256", campaign_.text_hash},
               {"run", draw.run},
               {"scene", stage.own->description.name},
               {"sensor", stage.own->description.sensor.name},
               {"seed", campaign_.seed},
               {"isa", core::short_name_of(campaign_.isa)},
               {"version", session::version_text()},
               {"commit", session::commit_text()},
               {"libraries", {terrain::ray_library(), core::image_library()}},
               {"sampling", session::caster_text(stage.session->sampling())},
               {"input", fingerprint},
               {kSceneInput, stage.input},
               {"parameters", Json::object()}};
  for (const auto& [name, value] : draw.values) json["parameters"][name] = value_json(value);
  json["frames"] = Json::array();
  for (const MadeFrame& frame : frames)
    json["frames"].push_back({{"index", frame.record.index},
                              {"time_s", frame.record.time_s},
                              {"pose", Json::parse(session::pose_json(frame.record.pose))},
                              {"events", frame.record.events},
                              {"files", frame.files}});
  std::uint64_t bytes = 0;
  json["files"] = Json::object();
  for (const std::string& name : files_below(folder)) {
    const std::uint64_t size = fs::file_size(folder / name);
    json["files"][name] = {{"sha256", sha256_of_file(folder / name)}, {"bytes", size}};
    bytes += size;
  }
  core::write_file_atomically(folder / kRunRecord, sealed(json.dump(1)));
  return bytes;
}

}  // namespace fanbeam::datasets
