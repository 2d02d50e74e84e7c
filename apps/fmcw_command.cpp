#include "apps/fmcw_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "apps/option_lists.h"
#include "apps/progress.h"
#include "apps/stop_on_signals.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "measure/clock.h"
#include "scenes/scene.h"
#include "session/frame_choice.h"
#include "session/records/output_folder.h"
#include "session/session.h"
#include "session/signal/bscope_product.h"
#include "session/signal/interferers.h"
#include "session/signal/radar_file.h"
#include "session/signal/record.h"
#include "session/signal/signal_files.h"
#include "session/signal/spectrogram.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

// The next stretch begins where this one ends.
double ms_since(measure::Clock::time_point& begin) {
  const double ms = measure::milliseconds_since(begin);
  begin = measure::Clock::now();
  return ms;
}

// The product that has its own sweeps, one a column, and needs nothing of the radar's chain.
constexpr const char* kScan = "bscope";
constexpr const char* kSpectrogram = "spectrogram";  // one of all frames
constexpr const char* kInterference = "interference";

// Only samples where the waveform has no maps; asking for more is refused.
std::set<std::string> chosen_products(const std::string& text, const session::FmcwRadar& radar) {
  if (text.empty() && !radar.maps) return {"beat"};
  if (text.empty()) return {"range-doppler", "range-azimuth", "top-view", "detections"};
  const std::set<std::string> products = products_in(text, session::kFmcwProducts);
  for (const std::string& name : products)
    if (name != "beat" && name != kScan && !radar.maps)
      core::throw_input_error(core::ErrorClass::unsupported, "--products", "\"" + name + "\"",
                              "beat or bscope: maps and detections need a chirp sequence");
  return products;
}

// What a B-scope alone, or all but it or the spectrogram, does not look at would be ignored in silence.
void refuse_idle_options(const FmcwOptions& options, const std::set<std::string>& products) {
  core::ProblemList problems;
  const auto refuse = [&](const std::string& option, const std::string& expected) {
    problems.error(core::ErrorClass::unsupported, {}, option, "given", expected);
  };
  if (products == std::set<std::string>{kScan})
    for (const std::string& option : options.given_for_chain)
      refuse(option,
             "with a product besides bscope, which has the sensor's sweep and range window");
  if (!products.contains(kScan) && options.looks > 0) refuse("--looks", "with --products bscope");
  if (!products.contains(kSpectrogram) && !options.spectrogram_of.empty())
    refuse("--spectrogram-of", "with --products spectrogram");
  problems.throw_if_errors();
}

// What does not go together is the radar file's fault where it is so without any option.
session::FmcwRadar radar_of(const FmcwOptions& options, const scenes::SceneDescription& scene) {
  const fs::path file =
      options.radar_file.empty() ? fs::path(scene.signal_file) : fs::path(options.radar_file);
  try {
    return session::fmcw_radar(options, scene.sensor);
  } catch (const core::InputError&) {
    if (file.empty()) throw;
    const session::FmcwSettings alone = session::radar_settings(file);
    session::radar_in_file(file, [&] { return session::fmcw_radar(alone, scene.sensor); });
    throw;
  }
}

class Run {
 public:
  Run(const FmcwOptions& options, const CommonOptions& common, const scenes::Scene& scene,
      int threads)
      : options_(options),
        common_(common),
        scene_(scene),
        threads_(threads),
        frames_(session::parse_frames(options.frames, scene.frame_count())),
        radar_(options.products == kScan ? session::FmcwRadar{}
                                         : radar_of(options, scene.description)),
        products_(chosen_products(options.products, radar_)),
        output_(options.output.empty()
                    ? core::default_output_folder(scene.description.name, "-fmcw")
                    : fs::path(options.output),
                "", options.overwrite) {
    refuse_idle_options(options, products_);
    if (products_.contains(kInterference) && scene.description.interferers.empty())
      core::throw_input_error(core::ErrorClass::ref, "--products", "\"interference\"",
                              "a scene with [[interferer]]: this one has no other radar");
    if (!products_.contains(kSpectrogram)) return;
    spectrogram_.emplace(radar_, options.spectrogram_of);
    const auto& targets = scene.world.targets;
    if (!options.spectrogram_of.empty() &&
        std::none_of(targets.begin(), targets.end(), [&](const auto& target) {
          return target.name.starts_with(options.spectrogram_of);
        }))
      core::throw_input_error(core::ErrorClass::ref, "--spectrogram-of",
                              "\"" + options.spectrogram_of + "\"",
                              "the beginning of a target's name in the scene");
  }

  void process() {
    Progress progress(scene_.description.name, static_cast<int>(frames_.size()), common_.quiet);
    for (const int index : frames_) {
      core::throw_if_stopped();
      process(index);
      progress.step(static_cast<int>(records_.size()));
    }
    std::set<std::string> files;
    for (const session::FmcwFrameRecord& frame : records_)
      files.insert(frame.files.begin(), frame.files.end());
    if (spectrogram_)
      files.merge(session::write_spectrogram(output_.path(), *spectrogram_, scene_.description.name,
                                             options_.dynamic_range_dB));
    if (runs_chain()) {
      files.insert(session::kRadarFile);
      core::write_file_atomically(output_.path() / session::kRadarFile, radar_toml());
    }
    output_.keep_only(files);
    core::write_file_atomically(output_.path() / "run.json",
                                session::fmcw_run_json(scene_, options_, radar_, records_));
    core::write_file_atomically(output_.path() / "timing.json",
                                session::fmcw_timing_json(threads_, scene_.build_s, records_));
    output_.end();
  }

  void print_summary() const {
    if (common_.quiet) return;
    for (const session::FmcwFrameRecord& frame : records_) {
      print_problems(frame.warnings);
      if (frame.scan)
        fmt::print("frame {}: B-scope of {} {}, {} scatterers from {} rays; {:.0f} ms\n",
                   frame.index, frame.scan->looks, frame.scan->looks == 1 ? "look" : "looks",
                   frame.scan->scatterers, frame.scan->rays, frame.scan->ms);
      if (!runs_chain()) continue;
      fmt::print("frame {}: {} paths from {} rays, {} synthesis", frame.index, frame.paths,
                 frame.rays, frame.keystone ? "keystone" : "direct");
      if (frame.found)
        fmt::print(", {} detections in {} clusters", frame.found->detections,
                   frame.found->clusters);
      fmt::print("; echoes {:.0f} ms, signal {:.0f} ms, files {:.0f} ms\n", frame.echoes_ms,
                 frame.signal_ms, frame.writing_ms);
    }
    for (const std::string& product : products_)
      fmt::print("{:14} {}\n", product,
                 fs::absolute(output_.path() / product).lexically_normal().string());
    fmt::print("{:14} {}\n", "record",
               fs::absolute(output_.path() / "run.json").lexically_normal().string());
  }

 private:
  bool runs_chain() const { return products_ != std::set<std::string>{kScan}; }

  std::string radar_toml() const {
    const signal::Waveform& waveform = radar_.waveform;
    return session::radar_toml(
        options_, radar_.waveform_name,
        {waveform.centre_frequency_Hz,
         waveform.kind == signal::WaveformKind::pulsed ? 0.0 : waveform.bandwidth_Hz,
         radar_.noise_figure, radar_.maps ? waveform.sample_rate_Hz[0] : 0.0});
  }

  // What a frame refuses comes before anything is there.
  void begin_writing() {
    if (!records_.empty()) return;
    std::set<std::string> files;
    if (runs_chain()) files.insert(session::kRadarFile);
    output_.begin(products_, files);
  }

  void process(int index) {
    session::FmcwFrameRecord record;
    if (runs_chain()) record = chain(index);
    record.index = index;
    record.time_s =
        scene_.trajectory->frame_time_s(index, scene_.description.sensor.scan.frame_rate_Hz);
    if (products_.contains(kScan)) scan(index, record);
    records_.push_back(std::move(record));
  }

  void scan(int index, session::FmcwFrameRecord& record) {
    measure::Clock::time_point begin = measure::Clock::now();
    const session::SignalBscope bscope = session::fmcw_bscope(scene_, index, options_);
    const double ms = ms_since(begin);
    begin_writing();
    record.files.merge(
        session::write_bscope(output_.path(), scene_.description.sensor, index, bscope));
    record.events = bscope.events;
    record.scan = session::FmcwScanCounts{
        bscope.looks, bscope.rays, bscope.scatterers, bscope.phase_noise_rad, bscope.clipped,
        bscope.plan,  ms};
  }

  void write_interference(int index, const session::FmcwPaths& paths,
                          const session::FmcwFrame& frame, const session::SignalBudget& budget,
                          std::set<std::string>& files) const {
    const auto cases = session::interference_study(radar_, scene_.description.sensor, paths, frame,
                                                   index, options_, budget);
    const std::string name = fmt::format("{}/{:05}", kInterference, index);
    core::write_file_atomically(output_.path() / (name + ".csv"), session::interference_csv(cases));
    const std::string title =
        fmt::format("{}, frame {}: other radars", scene_.description.name, index);
    session::write_plot(session::interference_plot(cases, radar_.axes.range_step_m, title),
                        output_.path() / (name + ".png"));
    files.insert({name + ".csv", name + ".png"});
  }

  // Of the targets that the spectrogram looks at.
  std::vector<double> ranges_of(const session::FmcwPaths& paths) const {
    std::vector<double> ranges_m;
    if (spectrogram_->target().empty()) return ranges_m;
    for (const core::Echo& echo : paths.targets)
      if (scene_.world.targets[echo.object_id].name.starts_with(spectrogram_->target()))
        ranges_m.push_back(echo.range_m);
    return ranges_m;
  }

  session::FmcwFrameRecord chain(int index) {
    measure::Clock::time_point begin = measure::Clock::now();
    const session::FmcwPaths paths = session::fmcw_paths(scene_, index, options_);
    const double echoes_ms = ms_since(begin);
    const session::SignalBudget budget{scene_.plan, scene_.accuracy_grey, scene_.options.wishes};
    const session::FmcwFrame frame =
        fmcw_frame(radar_, scene_.description.sensor, paths.paths, index, options_, products_,
                   budget, paths.interferers);
    const double signal_ms = ms_since(begin);
    session::FmcwFrameRecord record = session::fmcw_record(scene_, index, paths, frame);
    begin_writing();
    record.files = session::write_fmcw_products(
        output_.path(), products_, radar_, frame,
        {index, record.time_s, scene_.description.name, options_.dynamic_range_dB,
         record.radar_speed_mps, record.radar_velocity_mps});
    if (spectrogram_) spectrogram_->add(record.time_s, frame, ranges_of(paths));
    if (products_.contains(kInterference))
      write_interference(index, paths, frame, budget, record.files);
    record.echoes_ms = echoes_ms;
    record.signal_ms = signal_ms;
    record.writing_ms = ms_since(begin);
    return record;
  }

  const FmcwOptions& options_;
  const CommonOptions& common_;
  const scenes::Scene& scene_;
  int threads_;
  std::vector<int> frames_;
  session::FmcwRadar radar_;
  std::set<std::string> products_;
  session::OutputFolder output_;
  std::vector<session::FmcwFrameRecord> records_;
  std::optional<session::Spectrogram> spectrogram_;
};

}  // namespace

int fmcw(FmcwOptions& options, const CommonOptions& common) {
  const core::ThreadLimit threads(options.threads);
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(options, problems);
  if (options.radar_file.empty() && !description.signal_file.empty()) {
    session::read_radar_file(description.signal_file, options, problems);
    problems.throw_if_errors();
    options.put_given_again();
  }
  scenes::BuildOptions build;
  build.accuracy_grey = options.accuracy_grey;
  build.heights_shown = false;
  if (!options.effects.empty())
    build.wishes = renderer::parse_effect_wishes(options.effects, renderer::Touches::samples);
  const auto scene =
      session::Session(description, {.build = build, .pictures = false}, problems).scene();
  if (!common.quiet) print_problems(problems.all());
  const StopOnSignals stop_on_signals;
  try {
    Run run(options, common, *scene, threads.threads());
    run.process();
    run.print_summary();
  } catch (const core::Stopped&) {
    return end_by_stop_signal();
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
