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
#include "apps/obstacle_product.h"
#include "apps/preview.h"
#include "apps/progress.h"
#include "apps/run_record.h"
#include "apps/stop_on_signals.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "core/units.h"
#include "renderer/planned_frames.h"
#include "scenes/frame_plan.h"
#include "scenes/scene.h"
#include "sensors/display/display.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

ProductSet parse_products(const std::string& text) {
  std::vector<std::string_view> known;
  for (const Product& product : kProducts) known.push_back(product.name);
  ProductSet products;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string name = text.substr(from, comma - from);
    from = comma + 1;
    if (std::find(known.begin(), known.end(), name) == known.end())
      core::throw_input_error(core::ErrorClass::ref, "--products", "\"" + name + "\"",
                              fmt::format("a list of {}", fmt::join(known, ", ")));
    products.insert(name);
  }
  return products;
}

// What was asked for and what was reached, where an accuracy or a time was asked for.
void print_accuracy(const RunRecord& record, double accuracy_grey) {
  const SamplingChoice& choice = record.choice;
  if (choice.budget_ms > 0.0)
    fmt::print(
        "{:.1f} ms of {:.1f} ms a frame, sampling error {:.2f} grey: the same again with "
        "--rays-per-cell {}{}{}\n",
        choice.slowest_ms, choice.budget_ms, choice.estimated_error_grey,
        core::number_text(choice.samples),
        accuracy_grey > 0.0 ? " --accuracy " + core::number_text(accuracy_grey) : std::string(),
        choice.fits ? "" : " (the coarsest there is, and too slow)");
  double largest_grey = 0.0;
  std::size_t estimated = 0, missed = 0;
  for (const FrameRecord& frame : record.frames) {
    if (!frame.error) continue;
    ++estimated;
    largest_grey = std::max(largest_grey, frame.error->largest_grey());
    if (!frame.error->reached) ++missed;
  }
  if (estimated == 0) return;
  fmt::print("sampling error at most {:.2f} grey RMS (estimated)", largest_grey);
  if (choice.sampling.target_grey > 0.0)
    fmt::print(", asked for {:.2f}{}", choice.sampling.target_grey,
               missed > 0 ? fmt::format(": {} frames missed it at the finest sampling", missed)
                          : std::string());
  fmt::print("\n");
}

// Effects that the sequence runs and this frame does not.
std::vector<std::string> left_out(const core::EffectPlan& sequence, const core::EffectPlan& frame) {
  std::vector<std::string> names;
  for (const core::EffectDecision& decision : sequence.decisions)
    if (decision.on && !frame.runs(decision.effect)) names.push_back(decision.effect);
  return names;
}

class Run {
 public:
  Run(const RenderOptions& options, const CommonOptions& common, const scenes::Scene& scene,
      ProductSet products, int threads)
      : options_(options),
        common_(common),
        scene_(scene),
        products_(std::move(products)),
        folder_(options.output.empty() ? fs::path("out") / scene.description.name
                                       : fs::path(options.output)) {
    record_.choice = choose_sampling(options, scene, wanted(),
                                     parse_frames(options.frames, scene.frame_count()));
    record_.seed = options.seed;
    record_.plan_per_frame = options.plan_per_frame;
    record_.threads = threads;
    record_.scene_build_s = scene.build_s;
    fingerprint_ = input_fingerprint(scene, record_);
  }

  void render_frames();
  void write_records() const {
    core::write_file_atomically(folder_ / "run.json", run_json(scene_, record_));
    core::write_file_atomically(folder_ / "timing.json", timing_json(record_));
  }
  void print_summary() const;

 private:
  core::EffectPlan plan_of(int index) const {
    return options_.plan_per_frame ? scenes::frame_plan(scene_, index) : scene_.plan;
  }
  void remove_leftovers() const;
  FrameOutput render_frame(const renderer::FrameRenderer& frame_renderer,
                           FrameRecord& record) const;
  renderer::Products wanted() const {
    const bool both = products_.contains("pair") || products_.contains("preview");
    const bool plan_view = products_.contains("ppi") || products_.contains("ppi_north");
    return {both || plan_view || products_.contains("bscope"), both || products_.contains("cscope"),
            products_.contains("detections"), products_.contains("obstacles")};
  }

  const RenderOptions& options_;
  const CommonOptions& common_;
  const scenes::Scene& scene_;
  ProductSet products_;
  fs::path folder_;
  RunRecord record_;
  std::string fingerprint_;
};

void Run::render_frames() {
  const sensors::Sensor& sensor = scene_.description.sensor;
  const std::vector<int> frames = parse_frames(options_.frames, scene_.frame_count());
  if (options_.resume) remove_leftovers();
  renderer::PlannedFrames renderers(scene_.world, record_.choice.sampling, wanted(), options_.seed);
  FrameWriter writer(folder_, products_, sensor);
  std::optional<Preview> preview;
  if (products_.contains("preview"))
    preview.emplace(folder_ / ("preview." + options_.preview_format), 4 * sensor.scan.columns + 8,
                    std::max(sensor.range.cells, sensor.display.cscope_rows),
                    sensor.scan.frame_rate_Hz);
  Progress progress(scene_.description.name, static_cast<int>(frames.size()), common_.quiet);
  const Clock::time_point begin = Clock::now();
  for (const int index : frames) {
    core::throw_if_stopped();
    FrameRecord record;
    record.index = index;
    record.time_s = scene_.trajectory.frame_time_s(index, sensor.scan.frame_rate_Hz);
    record.pose = scene_.trajectory.at(record.time_s);
    const core::EffectPlan plan = plan_of(index);
    record.left_out = left_out(scene_.plan, plan);
    if (!options_.resume || !take_over(folder_, products_, fingerprint_, record)) {
      FrameOutput output = render_frame(renderers.for_plan(plan), record);
      if (preview)
        preview->add(side_by_side(sensors::bscope_picture(sensor, output.frame.bscope_grey),
                                  sensors::cscope_picture(sensor, output.frame.cscope_grey)));
      writer.push(std::move(output));
    }
    record_.frames.push_back(std::move(record));
    progress.step(static_cast<int>(record_.frames.size()));
  }
  writer.finish();
  if (preview) preview->finish();
  record_.wall_s = seconds_since(begin);
}

// What a killed run was writing.
void Run::remove_leftovers() const {
  core::remove_abandoned_temporaries(folder_);
  for (const std::string& product : products_)
    core::remove_abandoned_temporaries(folder_ / product);
}

FrameOutput Run::render_frame(const renderer::FrameRenderer& frame_renderer,
                              FrameRecord& record) const {
  const Clock::time_point begin = Clock::now();
  FrameOutput output{record.index,
                     core::attitude_from(record.pose.q_NB).heading_rad,
                     frame_renderer.render(scene_.frame_pose(record.index)),
                     {}};
  record.frame_ms = 1000.0 * seconds_since(begin);
  record.rays = output.frame.rays;
  record.slices = output.frame.slices;
  record.blanked = output.frame.blanked;
  record.unprojected = output.frame.unprojected;
  record.events = output.frame.events;
  record.error = output.frame.error;
  output.metadata = frame_metadata(scene_, record_.choice.sampling, record, fingerprint_);
  if (products_.contains("obstacles"))
    output.obstacle_table = obstacle_table(output.frame.obstacles, fingerprint_);
  if (products_.contains("detections"))
    output.detection_table = detection_table(scene_.description.sensor, record.index, record.time_s,
                                             fingerprint_, output.frame.detections);
  return output;
}

void Run::print_summary() const {
  if (common_.quiet) return;
  const auto resumed = std::count_if(record_.frames.begin(), record_.frames.end(),
                                     [](const FrameRecord& f) { return f.resumed; });
  fmt::print("{} frames in {:.1f} s", record_.frames.size(), record_.wall_s);
  if (resumed > 0) fmt::print(" ({} already there)", resumed);
  fmt::print(", scene built in {:.1f} s\n", record_.scene_build_s);
  fmt::print("cast by {}: {}\n", caster_text(record_.choice.sampling), scene_.caster.reason);
  print_accuracy(record_, options_.accuracy_grey);
  for (const core::EffectDecision& decision : scene_.plan.decisions)
    fmt::print("  {:14} {:3}  {}\n", decision.effect, decision.on ? "on" : "off", decision.reason);
  for (const std::string& product : products_) {
    const fs::path path =
        product == "preview" ? folder_ / ("preview." + options_.preview_format) : folder_ / product;
    fmt::print("{:8} {}\n", product, fs::absolute(path).lexically_normal().string());
  }
  fmt::print("{:8} {}\n", "record", fs::absolute(folder_ / "run.json").lexically_normal().string());
}

}  // namespace

int render(const RenderOptions& options, const CommonOptions& common) {
  ProductSet products = parse_products(options.products);
  const core::ThreadLimit threads(options.threads);
  core::ProblemList problems;
  scenes::SceneDescription description = read_chosen_scene(options, problems);
  if (!options.realisation.empty()) description.sample = options.realisation == "sample";
  scenes::BuildOptions build;
  build.frame_plans = options.plan_per_frame;
  if (options.accuracy_grey > 0.0) build.accuracy_grey = options.accuracy_grey;
  if (!options.effects.empty()) build.wishes = renderer::parse_effect_wishes(options.effects);
  if (options.reference) {
    build.caster = renderer::CasterWish::rays;
  } else if (!options.caster.empty()) {
    build.caster = renderer::caster_wish(options.caster);
  }
  const std::unique_ptr<scenes::Scene> scene = scenes::build_scene(description, build, problems);
  if (!common.quiet) print_problems(problems.all());
  if (scene->trajectory.attitude_derived)
    spdlog::info("the trajectory has no full attitude: missing angles are derived from its path");
  const StopOnSignals stop_on_signals;
  try {
    Run run(options, common, *scene, std::move(products), threads.threads());
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
