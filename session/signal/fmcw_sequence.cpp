#include "session/signal/fmcw_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "core/files.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "session/frame_choice.h"
#include "session/records/output_folder.h"
#include "session/signal/bscope_product.h"
#include "session/signal/interferers.h"
#include "session/signal/radar_file.h"
#include "session/signal/signal_files.h"
#include "session/signal/spectrogram.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInterference = "interference";

// The next stretch begins where this one ends.
double ms_since(std::chrono::steady_clock::time_point& begin) {
  const auto now = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::milli>(now - std::exchange(begin, now)).count();
}

// Only samples where the waveform has no maps; asking for more is refused.
std::set<std::string> chosen_products(const std::set<std::string>& asked, const FmcwRadar& radar) {
  if (asked.empty() && !radar.maps) return {"beat"};
  if (asked.empty()) return {"range-doppler", "range-azimuth", "top-view", "detections"};
  for (const std::string& name : asked)
    if (name != "beat" && name != kScanProduct && !radar.maps)
      core::throw_input_error(
          core::ErrorClass::unsupported, "--products", "\"" + name + "\"",
          "beat or bscope: maps and detections need a chirp sequence, of 2 chirps or more");
  return asked;
}

// What does not go together is the radar file's fault where it is so without any option.
FmcwRadar radar_of(const FmcwSequenceSettings& settings, const scenes::SceneDescription& scene) {
  const fs::path file =
      settings.radar_file.empty() ? fs::path(scene.signal_file) : settings.radar_file;
  try {
    return fmcw_radar(settings.radar, scene.sensor);
  } catch (const core::InputError&) {
    if (file.empty()) throw;
    const FmcwSettings alone = radar_settings(file);
    radar_in_file(file, [&] { return fmcw_radar(alone, scene.sensor); });
    throw;
  }
}

class FmcwRun {
 public:
  FmcwRun(const scenes::Scene& scene, const FmcwSequenceSettings& settings)
      : settings_(settings),
        scene_(scene),
        frames_(parse_frames(settings.frames, scene.frame_count())),
        runs_chain_(settings.products != std::set<std::string>{kScanProduct}),
        radar_(runs_chain_ ? radar_of(settings, scene.description) : FmcwRadar{}),
        products_(chosen_products(settings.products, radar_)),
        output_(settings.output.empty()
                    ? core::default_output_folder(scene.description.name, "-fmcw")
                    : settings.output,
                "", settings.overwrite) {
    if (runs_chain_) check_processing(radar_, products_);  // before rays are sent
    if (runs_chain_ && !scene.description.interferers.empty())
      signal::check_hears_others(radar_.waveform);
    if (products_.contains(kInterference) && scene.description.interferers.empty())
      core::throw_input_error(core::ErrorClass::ref, "--products", "\"interference\"",
                              "a scene with [[interferer]]: this one has no other radar");
    if (!products_.contains(kSpectrogramProduct)) return;
    spectrogram_.emplace(radar_, settings.spectrogram_of);
    const auto& targets = scene.world.targets;
    if (!settings.spectrogram_of.empty() &&
        std::none_of(targets.begin(), targets.end(), [&](const auto& target) {
          return target.name.starts_with(settings.spectrogram_of);
        }))
      core::throw_input_error(core::ErrorClass::ref, "--spectrogram-of",
                              "\"" + settings.spectrogram_of + "\"",
                              "the beginning of a target's name in the scene");
  }

  void process(const ProgressListener& progress) {
    const int total = static_cast<int>(frames_.size());
    progress(0, total);
    for (const int index : frames_) {
      core::throw_if_stopped();
      process(index);
      progress(static_cast<int>(records_.size()), total);
    }
  }

  void write_records() {
    std::set<std::string> of_all_frames;
    if (spectrogram_)
      of_all_frames = write_spectrogram(output_.path(), *spectrogram_, scene_.description.name,
                                        settings_.radar.dynamic_range_dB);
    if (runs_chain_) {
      of_all_frames.insert(kRadarFile);
      core::write_file_atomically(output_.path() / kRadarFile, resolved_radar_toml());
    }
    std::set<std::string> files = of_all_frames;
    for (const FmcwFrameRecord& frame : records_)
      files.insert(frame.files.begin(), frame.files.end());
    output_.keep_only(files);
    core::write_file_atomically(
        output_.path() / "run.json",
        fmcw_run_json(scene_, settings_.radar, radar_, records_, of_all_frames));
    core::write_file_atomically(
        output_.path() / "timing.json",
        fmcw_timing_json(core::ThreadLimit::threads(), scene_.build_s, records_));
    output_.end();
  }

  FmcwSequence result() && {
    FmcwSequence result{std::move(records_), {}};
    for (const std::string& product : products_)
      result.places.push_back({product, output_.path() / product});
    result.places.push_back({"record", output_.path() / "run.json"});
    return result;
  }

 private:
  std::string resolved_radar_toml() const {
    const signal::Waveform& waveform = radar_.waveform;
    FmcwSettings told = settings_.radar;
    // Whoever reads the samples again has no sensor, and another last cell gives other detections.
    if (radar_.maps && !told.most_range_m)
      told.most_range_m = scene_.description.sensor.range.maximum_m();
    return radar_toml(
        told, radar_.waveform_name,
        {waveform.centre_frequency_Hz,
         waveform.kind == signal::WaveformKind::pulsed ? 0.0 : waveform.bandwidth_Hz,
         radar_.noise_figure, is_sequence(waveform.kind) ? waveform.sample_rate_Hz[0] : 0.0});
  }

  // What a frame refuses comes before anything is there.
  void begin_writing() {
    if (!records_.empty()) return;
    std::set<std::string> files;
    if (runs_chain_) files.insert(kRadarFile);
    output_.begin(products_, files);
  }

  void process(int index) {
    FmcwFrameRecord record;
    if (runs_chain_) record = chain(index);
    record.index = index;
    record.time_s =
        scene_.trajectory->frame_time_s(index, scene_.description.sensor.scan.frame_rate_Hz);
    if (products_.contains(kScanProduct)) scan(index, record);
    records_.push_back(std::move(record));
  }

  void scan(int index, FmcwFrameRecord& record) {
    auto begin = std::chrono::steady_clock::now();
    const SignalBscope bscope = fmcw_bscope(scene_, index, settings_.radar);
    const double ms = ms_since(begin);
    begin_writing();
    record.files.merge(write_bscope(output_.path(), scene_.description.sensor, index, bscope));
    record.events = bscope.events;
    record.scan = FmcwScanCounts{
        bscope.looks, bscope.rays, bscope.scatterers, bscope.phase_noise_rad, bscope.clipped,
        bscope.plan,  ms};
  }

  void write_interference(int index, const FmcwPaths& paths, const FmcwFrame& frame,
                          std::set<std::string>& files) const {
    const auto cases =
        interference_study(radar_, paths, frame, index, settings_.radar, signal_budget(scene_));
    const std::string name = fmt::format("{}/{:05}", kInterference, index);
    core::write_file_atomically(output_.path() / (name + ".csv"), interference_csv(cases));
    const std::string title =
        fmt::format("{}, frame {}: other radars", scene_.description.name, index);
    write_plot(interference_plot(cases, radar_.axes.range_step_m, title),
               output_.path() / (name + ".png"));
    files.insert({name + ".csv", name + ".png"});
  }

  // Of the targets that the spectrogram looks at.
  std::vector<double> ranges_of(const FmcwPaths& paths) const {
    std::vector<double> ranges_m;
    if (spectrogram_->target().empty()) return ranges_m;
    for (const core::Echo& echo : paths.targets)
      if (scene_.world.targets[echo.object_id].name.starts_with(spectrogram_->target()))
        ranges_m.push_back(echo.range_m);
    return ranges_m;
  }

  FmcwFrameRecord chain(int index) {
    auto begin = std::chrono::steady_clock::now();
    const FmcwPaths paths = fmcw_paths(scene_, index, settings_.radar);
    const double echoes_ms = ms_since(begin);
    const FmcwFrame frame = fmcw_frame(radar_, scene_, paths, index, settings_.radar, products_);
    const double signal_ms = ms_since(begin);
    FmcwFrameRecord record = fmcw_record(scene_, index, paths, frame);
    begin_writing();
    record.files = write_fmcw_products(
        output_.path(), products_, radar_, frame,
        {index, record.time_s, scene_.description.name, settings_.radar.dynamic_range_dB,
         record.radar_speed_mps, record.radar_velocity_mps});
    if (spectrogram_) spectrogram_->add(record.time_s, frame, ranges_of(paths));
    if (products_.contains(kInterference)) write_interference(index, paths, frame, record.files);
    record.echoes_ms = echoes_ms;
    record.signal_ms = signal_ms;
    record.writing_ms = ms_since(begin);
    return record;
  }

  const FmcwSequenceSettings& settings_;
  const scenes::Scene& scene_;
  std::vector<int> frames_;
  bool runs_chain_;
  FmcwRadar radar_;
  std::set<std::string> products_;
  OutputFolder output_;
  std::vector<FmcwFrameRecord> records_{};
  std::optional<Spectrogram> spectrogram_{};
};

}  // namespace

FmcwSequence run_fmcw(const scenes::Scene& scene, const FmcwSequenceSettings& settings,
                      const ProgressListener& progress) {
  FmcwRun run(scene, settings);
  run.process(progress);
  run.write_records();
  return std::move(run).result();
}

}  // namespace fanbeam::session
