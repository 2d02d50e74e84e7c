#include "session/sequence.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "core/files.h"
#include "core/parallel.h"
#include "core/spelling.h"
#include "core/stop.h"
#include "scenes/frame_plan.h"
#include "scenes/scene.h"
#include "sensors/display/display.h"
#include "session/frame_choice.h"
#include "session/labels/run_labels.h"
#include "session/products/frame_output.h"
#include "session/products/frame_writer.h"
#include "session/products/layers_product.h"
#include "session/products/preview.h"
#include "session/records/conditions_json.h"
#include "session/records/frame_metadata.h"
#include "session/records/output_folder.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

bool has_any(const FrameRecord& frame, std::initializer_list<const char*> products) {
  return std::any_of(frame.files.begin(), frame.files.end(), [&](const std::string& file) {
    return std::any_of(products.begin(), products.end(), [&](const char* product) {
      return file.starts_with(std::string(product) + "/");
    });
  });
}

bool has_layers(const FrameRecord& frame) { return has_any(frame, {"layers", "cscope_layers"}); }
bool has_labels(const FrameRecord& frame) { return has_any(frame, {"labels"}); }

// Effects that the sequence runs and this frame does not.
core::EffectSet left_out(const core::EffectPlan& sequence, const core::EffectPlan& frame) {
  core::EffectSet effects;
  for (const core::EffectDecision& decision : sequence.decisions)
    if (decision.on && !frame.runs(decision.effect)) effects.insert(decision.effect);
  return effects;
}

void check(const SequenceSettings& settings, const scenes::BuildOptions& told) {
  core::ProblemList problems;
  const auto one_of = [&](const char* field, const std::string& value, const auto& known) {
    const std::vector<std::string> names(known.begin(), known.end());
    if (std::find(names.begin(), names.end(), value) == names.end())
      problems.error(core::ErrorClass::ref, {}, field, "\"" + value + "\"",
                     "a known one" + core::names_there_text(value, names));
  };
  std::vector<std::string_view> known;
  for (const Product& product : kProducts) known.push_back(product.name);
  if (settings.products.empty())
    problems.error(core::ErrorClass::ref, {}, "products", "none", "at least one");
  for (const std::string& product : settings.products) one_of("products", product, known);
  one_of("preview_format", settings.preview_format, kPreviewFormats);
  if (!settings.range_unit.empty()) one_of("range_unit", settings.range_unit, kRangeUnits);
  scenes::BuildOptions needed;
  plan_for(settings.products, needed);
  check_told(needed, told, problems);
  problems.throw_if_errors();
}

RunRecord record_of(const SequenceSettings& settings, const Session& session,
                    const scenes::Scene& scene) {
  RunRecord record;
  record.wanted = wanted_of(settings.products);
  record.choice =
      choose_sampling(settings.sampling, scene, session.seed(), record.wanted,
                      poses_to_time(scene, parse_frames(settings.frames, scene.frame_count())));
  record.set = changed_conditions_json(*session.opened(), scene);
  record.seed = session.seed();
  record.plan_per_frame = settings.plan_per_frame;
  record.range_unit = settings.range_unit;
  record.threads = core::ThreadLimit::threads();
  record.scene_build_s = scene.build_s;
  return record;
}

class Run {
 public:
  Run(Session& session, const SequenceSettings& settings)
      : settings_(settings),
        session_(session),
        shown_(session.scene()),
        scene_(*shown_),
        record_(record_of(settings, session, scene_)),
        fingerprint_(input_fingerprint(scene_, record_)),
        output_(settings.output.empty() ? core::default_output_folder(scene_.description.name)
                                        : settings.output,
                fingerprint_, settings.overwrite) {
    session_.set(record_.choice.sampling);
    if (want_labels(settings.products)) labeller_ = std::make_unique<const Labeller>(scene_);
  }

  void render_frames(const ProgressListener& progress);
  void write_records();
  Sequence result() const { return result_; }

 private:
  core::EffectPlan plan_of(int index) const {
    return settings_.plan_per_frame ? scenes::frame_plan(scene_, index) : scene_.plan;
  }
  std::set<std::string> files_of(const std::vector<int>& frames) const;
  FrameRecord frame_record(int index, const core::EffectPlan& plan) const;
  void take_over_frames();
  void fill_result();
  void remove_leftovers() const;
  FrameOutput render_frame(const core::EffectPlan& plan, FrameRecord& record) const;
  fs::path film() const { return output_.path() / ("preview." + settings_.preview_format); }

  const SequenceSettings& settings_;
  Session& session_;
  std::shared_ptr<const scenes::Scene> shown_;
  const scenes::Scene& scene_;
  RunRecord record_;
  std::string fingerprint_;
  OutputFolder output_;
  std::unique_ptr<const Labeller> labeller_{};  // where labels are wanted
  Sequence result_{};
};

void Run::render_frames(const ProgressListener& progress) {
  const sensors::Sensor& sensor = scene_.description.sensor;
  const std::vector<int> frames = parse_frames(settings_.frames, scene_.frame_count());
  if (settings_.resume) remove_leftovers();
  FrameWriter writer(output_.path(), settings_.products, sensor);
  std::optional<Preview> preview;
  if (settings_.products.contains("preview"))
    preview.emplace(film(), 4 * sensor.scan.columns + 8,
                    std::max(sensor.range.cells, sensor.display.cscope_rows),
                    sensor.scan.frame_rate_Hz);
  const int total = static_cast<int>(frames.size());
  progress(0, total);
  const Clock::time_point begin = Clock::now();
  for (const int index : frames) {
    core::throw_if_stopped();
    const core::EffectPlan plan = plan_of(index);
    FrameRecord record = frame_record(index, plan);
    if (!settings_.resume || !take_over(output_.path(), settings_.products, fingerprint_, record)) {
      FrameOutput output = render_frame(plan, record);
      output_.begin_frames([&] { return files_of(frames); });
      if (preview)
        preview->add(side_by_side(sensors::bscope_picture(sensor, output.frame.bscope_grey),
                                  sensors::cscope_picture(sensor, output.frame.cscope_grey)));
      writer.push(std::move(output));
    }
    record_.frames.push_back(std::move(record));
    progress(static_cast<int>(record_.frames.size()), total);
  }
  writer.finish();
  if (preview) {
    output_.begin({}, {film().filename().string()});  // it does not say what input it is of
    preview->finish();
    record_.films.insert(film().filename().string());
  }
  record_.wall_s = seconds_since(begin);
  result_.asked = total;
  result_.resumed =
      static_cast<int>(std::count_if(record_.frames.begin(), record_.frames.end(),
                                     [](const FrameRecord& frame) { return frame.resumed; }));
}

std::set<std::string> Run::files_of(const std::vector<int>& frames) const {
  std::set<std::string> files;
  for (const int index : frames) files.merge(frame_files(settings_.products, index));
  return files;
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
  for (const FrameRecord& record : record_.frames) products[record.index] = settings_.products;
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
  const bool layers = std::any_of(record_.frames.begin(), record_.frames.end(), has_layers);
  const bool labels = std::any_of(record_.frames.begin(), record_.frames.end(), has_labels);
  if (layers) record_.films.insert(kLayersFile);
  if (labels) record_.films.insert(kRunLabelFiles.begin(), kRunLabelFiles.end());
  // They do not say what input they are of.
  if (!record_.films.empty()) output_.begin({}, record_.films);
  if (layers) core::write_file_atomically(output_.path() / kLayersFile, layers_json(scene_));
  if (labels) write_run_labels(output_.path(), record_.frames);
  record_.films.insert(output_.films().begin(), output_.films().end());
  std::set<std::string> files = record_.films;
  for (const FrameRecord& record : record_.frames)
    files.insert(record.files.begin(), record.files.end());
  result_.removed = output_.keep_only(files);
  core::write_file_atomically(output_.path() / "run.json", run_json(scene_, record_));
  core::write_file_atomically(output_.path() / "timing.json", timing_json(record_));
  output_.end();
  fill_result();
}

// What a killed run was writing.
void Run::remove_leftovers() const {
  core::remove_abandoned_temporaries(output_.path());
  for (const std::string& product : settings_.products)
    core::remove_abandoned_temporaries(output_.path() / product);
}

FrameOutput Run::render_frame(const core::EffectPlan& plan, FrameRecord& record) const {
  const Clock::time_point begin = Clock::now();
  renderer::Frame frame = session_.render_flown(record.index, plan, wanted_of(settings_.products));
  record.frame_ms = 1000.0 * seconds_since(begin);
  return frame_output(scene_,
                      {settings_.products, fingerprint_, record_.choice.sampling,
                       settings_.range_unit, labeller_.get()},
                      std::move(frame), record);
}

void Run::fill_result() {
  result_.record = record_;
  for (const std::string& product : settings_.products)
    result_.places.push_back({product, product == "preview" ? film() : output_.path() / product});
  result_.places.push_back({"record", output_.path() / "run.json"});
}

}  // namespace

Sequence render_sequence(Session& session, const SequenceSettings& settings,
                         const ProgressListener& progress) {
  check(settings, session.scene()->options);
  // A time budget is measured with as many as frames have, labels are made with them, and the record
  // tells them.
  const core::ThreadLimit limit(session.threads());
  Run run(session, settings);
  run.render_frames(progress);
  run.write_records();
  return run.result();
}

}  // namespace fanbeam::session
