#include "apps/render_command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>

#include "apps/detection_product.h"
#include "apps/frame_choice.h"
#include "apps/frame_metadata.h"
#include "apps/frame_writer.h"
#include "apps/layers_product.h"
#include "apps/obstacle_product.h"
#include "apps/option_lists.h"
#include "apps/output_folder.h"
#include "apps/preview.h"
#include "apps/progress.h"
#include "apps/render_summary.h"
#include "apps/run_record.h"
#include "apps/stop_on_signals.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "core/units.h"
#include "scenes/frame_plan.h"
#include "scenes/scene.h"
#include "sensors/display/display.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

bool has_layers(const FrameRecord& frame) {
  return std::any_of(frame.files.begin(), frame.files.end(), [](const std::string& file) {
    return file.starts_with("layers/") || file.starts_with("cscope_layers/");
  });
}

// Effects that the sequence runs and this frame does not.
std::vector<std::string> left_out(const core::EffectPlan& sequence, const core::EffectPlan& frame) {
  std::vector<std::string> names;
  for (const core::EffectDecision& decision : sequence.decisions)
    if (decision.on && !frame.runs(decision.effect)) names.push_back(decision.effect);
  return names;
}

renderer::Products wanted_of(const ProductSet& products) {
  const bool both =
      products.contains("pair") || products.contains("figure") || products.contains("preview");
  const bool plan_view =
      products.contains("ppi") || products.contains("ppi_north") || products.contains("ppi_figure");
  return {both || plan_view || products.contains("bscope"),
          both || products.contains("cscope"),
          products.contains("detections"),
          products.contains("obstacles"),
          products.contains("layers"),
          products.contains("cscope_layers")};
}

RunRecord record_of(const RenderOptions& options, const scenes::Scene& scene,
                    const renderer::Products& wanted, int threads) {
  RunRecord record;
  record.choice =
      choose_sampling(options, scene, wanted, parse_frames(options.frames, scene.frame_count()));
  record.seed = options.seed;
  record.plan_per_frame = options.plan_per_frame;
  record.range_unit = options.range_unit;
  record.threads = threads;
  record.scene_build_s = scene.build_s;
  return record;
}

class Run {
 public:
  Run(const RenderOptions& options, const CommonOptions& common, session::Session& session,
      ProductSet products, int threads)
      : options_(options),
        common_(common),
        session_(session),
        shown_(session.scene()),
        scene_(*shown_),
        products_(std::move(products)),
        record_(record_of(options, scene_, wanted(), threads)),
        fingerprint_(input_fingerprint(scene_, record_)),
        output_(options.output.empty() ? core::default_output_folder(scene_.description.name)
                                       : fs::path(options.output),
                fingerprint_, options.overwrite) {
    session_.set(record_.choice.sampling);
  }

  void render_frames();
  void write_records();
  void print_summary() const;

 private:
  core::EffectPlan plan_of(int index) const {
    return options_.plan_per_frame ? scenes::frame_plan(scene_, index) : scene_.plan;
  }
  FrameRecord frame_record(int index, const core::EffectPlan& plan) const;
  void take_over_frames();
  void remove_leftovers() const;
  FrameOutput render_frame(const core::EffectPlan& plan, FrameRecord& record) const;
  renderer::Products wanted() const { return wanted_of(products_); }

  fs::path film() const { return output_.path() / ("preview." + options_.preview_format); }

  const RenderOptions& options_;
  const CommonOptions& common_;
  session::Session& session_;
  std::shared_ptr<const scenes::Scene> shown_;
  const scenes::Scene& scene_;
  ProductSet products_;
  RunRecord record_;
  std::string fingerprint_;
  OutputFolder output_;
};

void Run::render_frames() {
  const sensors::Sensor& sensor = scene_.description.sensor;
  const std::vector<int> frames = parse_frames(options_.frames, scene_.frame_count());
  if (options_.resume) remove_leftovers();
  FrameWriter writer(output_.path(), products_, sensor);
  std::optional<Preview> preview;
  if (products_.contains("preview"))
    preview.emplace(film(), 4 * sensor.scan.columns + 8,
                    std::max(sensor.range.cells, sensor.display.cscope_rows),
                    sensor.scan.frame_rate_Hz);
  Progress progress(scene_.description.name, static_cast<int>(frames.size()), common_.quiet);
  const Clock::time_point begin = Clock::now();
  for (const int index : frames) {
    core::throw_if_stopped();
    const core::EffectPlan plan = plan_of(index);
    FrameRecord record = frame_record(index, plan);
    if (!options_.resume || !take_over(output_.path(), products_, fingerprint_, record)) {
      FrameOutput output = render_frame(plan, record);
      if (preview)
        preview->add(side_by_side(sensors::bscope_picture(sensor, output.frame.bscope_grey),
                                  sensors::cscope_picture(sensor, output.frame.cscope_grey)));
      writer.push(std::move(output));
    }
    record_.frames.push_back(std::move(record));
    progress.step(static_cast<int>(record_.frames.size()));
  }
  writer.finish();
  if (preview) {
    preview->finish();
    record_.films.insert(film().filename().string());
  }
  record_.wall_s = seconds_since(begin);
}

FrameRecord Run::frame_record(int index, const core::EffectPlan& plan) const {
  FrameRecord record;
  record.index = index;
  record.time_s =
      scene_.trajectory->frame_time_s(index, scene_.description.sensor.scan.frame_rate_Hz);
  record.pose = scene_.trajectory->at(record.time_s);
  record.left_out = left_out(scene_.plan, plan);
  return record;
}

// The record lists every frame of this input that is there, whichever run made it.
void Run::take_over_frames() {
  std::map<int, ProductSet> products;
  for (const FrameRecord& record : record_.frames) products[record.index] = products_;
  const auto all = output_.frames(products);
  for (const auto& [index, there] : all) {
    if (products.contains(index) || index >= scene_.frame_count()) continue;
    FrameRecord record = frame_record(index, plan_of(index));
    if (take_over(output_.path(), there, fingerprint_, record))
      record_.frames.push_back(std::move(record));
  }
  std::sort(record_.frames.begin(), record_.frames.end(),
            [](const FrameRecord& a, const FrameRecord& b) { return a.index < b.index; });
  for (FrameRecord& record : record_.frames)
    record.files = frame_files(all.at(record.index), record.index);
}

void Run::write_records() {
  take_over_frames();
  if (std::any_of(record_.frames.begin(), record_.frames.end(), has_layers)) {
    core::write_file_atomically(output_.path() / kLayersFile, layers_json(scene_));
    record_.films.insert(kLayersFile);
  }
  std::set<std::string> files = record_.films;
  for (const FrameRecord& record : record_.frames)
    files.insert(record.files.begin(), record.files.end());
  output_.keep_only(files);
  core::write_file_atomically(output_.path() / "run.json", run_json(scene_, record_));
  core::write_file_atomically(output_.path() / "timing.json", timing_json(record_));
}

// What a killed run was writing.
void Run::remove_leftovers() const {
  core::remove_abandoned_temporaries(output_.path());
  for (const std::string& product : products_)
    core::remove_abandoned_temporaries(output_.path() / product);
}

FrameOutput Run::render_frame(const core::EffectPlan& plan, FrameRecord& record) const {
  const Clock::time_point begin = Clock::now();
  FrameOutput output{record.index,
                     core::attitude_from(record.pose.q_NB).heading_rad,
                     session_.render_flown(record.index, plan, wanted()),
                     {}};
  record.frame_ms = 1000.0 * seconds_since(begin);
  record.rays = output.frame.rays;
  record.slices = output.frame.slices;
  record.blanked = output.frame.blanked;
  record.unprojected = output.frame.unprojected;
  record.events = output.frame.events;
  record.error = output.frame.error;
  output.metadata = frame_metadata(scene_, record_.choice.sampling, record, fingerprint_);
  if (products_.contains("figure") || products_.contains("ppi_figure"))
    output.figure = figure_facts(scene_, record.pose, record.index, options_.range_unit);
  if (products_.contains("obstacles"))
    output.obstacle_table = obstacle_table(output.frame.obstacles, output.metadata);
  if (products_.contains("detections"))
    output.detection_table = detection_table(scene_.description.sensor, record.index, record.time_s,
                                             output.metadata, output.frame.detections);
  return output;
}

void Run::print_summary() const {
  if (common_.quiet) return;
  std::vector<ProductPlace> places;
  for (const std::string& product : products_)
    places.push_back({product, product == "preview" ? film() : output_.path() / product});
  places.push_back({"record", output_.path() / "run.json"});
  print_render_summary(record_, scene_, options_.accuracy_grey, places);
}

}  // namespace

int render(const RenderOptions& asked, const CommonOptions& common) {
  ProductSet products = products_in(asked.products, kProducts);
  if (!asked.range_unit.empty() && !products.contains("figure") && !products.contains("ppi_figure"))
    core::throw_input_error(core::ErrorClass::ref, "--range-unit", asked.range_unit,
                            "figure or ppi_figure among --products");
  const core::ThreadLimit threads(asked.threads);
  core::ProblemList problems;
  scenes::SceneDescription description = read_chosen_scene(asked, problems);
  const RenderOptions options = with_accuracy_of(description, asked);
  if (!options.realisation.empty()) description.sample = options.realisation == "sample";
  session::Setup setup{.seed = options.seed};
  scenes::BuildOptions& build = setup.build;
  build.accuracy_grey = options.accuracy_grey;
  const renderer::Products wanted = wanted_of(products);
  build.heights_shown = wanted.cscope || wanted.obstacles;
  if (!options.effects.empty()) build.wishes = renderer::parse_effect_wishes(options.effects);
  if (options.reference) {
    build.caster = renderer::CasterWish::rays;
  } else if (!options.caster.empty()) {
    build.caster = renderer::caster_wish(options.caster);
  }
  session::Session session(description, setup, problems);
  const std::shared_ptr<const scenes::Scene> scene = session.scene();
  if (!common.quiet) print_problems(problems.all());
  if (scene->trajectory && scene->trajectory->attitude_derived)
    spdlog::info("the trajectory has no full attitude: missing angles are derived from its path");
  const StopOnSignals stop_on_signals;
  try {
    Run run(options, common, session, std::move(products), threads.threads());
    run.render_frames();
    run.write_records();
    run.print_summary();
  } catch (const core::Stopped&) {
    if (!common.quiet)
      fmt::print(stderr, "stopped: frames on disk are whole, --resume goes on from there\n");
    return end_by_stop_signal();
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
