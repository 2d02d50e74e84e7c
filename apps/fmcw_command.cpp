#include "apps/fmcw_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <set>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_lists.h"
#include "apps/progress.h"
#include "apps/stop_on_signals.h"
#include "core/parallel.h"
#include "session/signal/fmcw_sequence.h"
#include "session/signal/radar_file.h"
#include "session/signal/signal_session.h"

namespace fanbeam::apps {
namespace {

// What a B-scope alone, or all but it or the spectrogram, does not look at would be ignored in silence.
void refuse_idle_options(const FmcwOptions& options, const std::set<std::string>& products) {
  core::ProblemList problems;
  const auto refuse = [&](const std::string& option, const std::string& expected) {
    problems.error(core::ErrorClass::unsupported, {}, option, "given", expected);
  };
  if (products == std::set<std::string>{session::kScanProduct})
    for (const std::string& option : options.given_for_chain)
      refuse(option,
             "with a product besides bscope, which has the sensor's sweep and range window");
  if (!products.contains(session::kScanProduct) && options.looks > 0)
    refuse("--looks", "with --products bscope");
  if (!products.contains(session::kSpectrogramProduct) && !options.spectrogram_of.empty())
    refuse("--spectrogram-of", "with --products spectrogram");
  problems.throw_if_errors();
}

session::FmcwSequenceSettings sequence_of(const FmcwOptions& options) {
  session::FmcwSequenceSettings settings{.radar = options,
                                         .radar_file = options.radar_file,
                                         .output = options.output,
                                         .frames = options.frames,
                                         .spectrogram_of = options.spectrogram_of,
                                         .overwrite = options.overwrite};
  if (!options.products.empty())
    settings.products = products_in(options.products, session::kFmcwProducts);
  refuse_idle_options(options, settings.products);
  return settings;
}

void print_summary(const session::FmcwSequence& sequence) {
  for (const session::FmcwFrameRecord& frame : sequence.frames) {
    print_problems(frame.warnings);
    if (frame.scan)
      fmt::print("frame {}: B-scope of {} {}, {} scatterers from {} rays; {:.0f} ms\n", frame.index,
                 frame.scan->looks, frame.scan->looks == 1 ? "look" : "looks",
                 frame.scan->scatterers, frame.scan->rays, frame.scan->ms);
    if (!frame.chain) continue;
    fmt::print("frame {}: {} paths from {} rays, {} synthesis", frame.index, frame.paths,
               frame.rays, frame.keystone ? "keystone" : "direct");
    if (frame.found)
      fmt::print(", {} detections in {} clusters", frame.found->detections, frame.found->clusters);
    fmt::print("; echoes {:.0f} ms, signal {:.0f} ms, files {:.0f} ms\n", frame.echoes_ms,
               frame.signal_ms, frame.writing_ms);
  }
  for (const session::ProductPlace& place : sequence.places)
    fmt::print("{:14} {}\n", place.name, full_path(place.path));
}

// Stopped by signals as render is. A radar file that the scene names goes into the options, below those that were
// given.
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
  if (!options.effects.empty())
    build.wishes = renderer::parse_effect_wishes(options.effects, renderer::Touches::samples);
  const auto scene = session::Session(description, session::signal_setup(build), problems).scene();
  if (!common.quiet) print_problems(problems.all());
  const StopOnSignals stop_on_signals;
  const session::FmcwSequenceSettings settings = sequence_of(options);
  std::optional<Progress> bar;
  const auto progress = frames_progress(bar, scene->description.name, common.quiet);
  const session::FmcwSequence sequence = session::run_fmcw(*scene, settings, progress);
  bar.reset();
  if (!common.quiet) print_summary(sequence);
  return kExitDone;
}

}  // namespace

void add_fmcw(CommandLine& line) { line.add(declare_fmcw, fmcw); }

}  // namespace fanbeam::apps
