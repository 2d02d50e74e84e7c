#include "apps/live_command.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "apps/live_status_line.h"
#include "apps/stop_on_signals.h"
#include "core/parallel.h"
#include "live/feed.h"
#include "live/wiring/run.h"
#include "renderer/plan/plan.h"

namespace fanbeam::apps {
namespace {

// Planned for the air over all of its terrain: nobody knows where a simulator flies.
scenes::SceneDescription scene_of(const LiveOptions& options, const live::PosesFrom& from,
                                  core::ProblemList& problems) {
  scenes::SceneDescription description = read_chosen_scene(options, problems);
  description.flight_heights.stated = true;
  description.sample = true;
  if (from.csv.empty()) return description;
  scenes::TrajectoryDescription flight;
  flight.kind = scenes::TrajectoryDescription::Kind::file;
  flight.file = from.csv;
  flight.place = {from.csv};
  flight.datum = live::datum_of(description, from.datum);
  description.trajectory = flight;
  return description;
}

void refuse_outputs_among_inputs(const LiveOptions& options, const live::Wiring& wiring,
                                 const scenes::SceneDescription& scene) {
  std::vector<std::filesystem::path> inputs = files_of_scene(options, scene);
  inputs.emplace_back(options.replay);
  inputs.emplace_back(options.token_file);
  for (const live::PosesFrom& from : wiring.from) inputs.push_back(from.csv);
  refuse_output_among(inputs, options.record, "--record");
  for (const live::RawSink& sink : wiring.to.raw)
    if (sink.file != "-") refuse_output_among(inputs, sink.file, "--to");
}

std::unique_ptr<session::Session> opened(const LiveOptions& options, const live::Wiring& wiring,
                                         bool quiet) {
  core::ProblemList problems;
  scenes::BuildOptions build;
  // Radar video may read watts; always, as no picture of a recording depends on who else looked.
  build.read.power = true;
  if (!options.effects.empty())
    build.wishes = renderer::parse_effect_wishes(options.effects, renderer::Touches::pictures);
  // Without lockstep the rate decides, and a recording knows its samplings.
  const bool measured =
      options.lockstep && options.replay.empty() && !(options.rays_per_cell > 0.0);
  auto session = std::make_unique<session::Session>(
      scene_of(options, wiring.first(), problems),
      session::Setup{.build = build, .keeps_time_budget = measured, .threads = options.threads},
      problems);
  refuse_outputs_among_inputs(options, wiring, session->scene()->description);
  if (!quiet) print_problems(problems.all());
  return session;
}

}  // namespace

int fly(const LiveOptions& given, const CommonOptions& common) {
  LiveOptions options = given;
  std::optional<live::Recording> recording;
  if (!options.replay.empty()) {
    recording = live::read_recording(options.replay);
    options.from = recording->flown_by.from;
  }
  const live::Wiring wiring = live::wiring_of(options, std::getenv(live::kTokenVariable));
  const core::ThreadLimit threads(options.threads);
  std::signal(SIGPIPE, SIG_IGN);  // a reader of raw frames that leaves is a good end
  const StopOnSignals stop_on_signals;
  const live::RunCallbacks calls{.open =
                                     [&](const std::string& scene) {
                                       LiveOptions other = options;
                                       other.scene = scene;
                                       return opened(other, wiring, common.quiet);
                                     },
                                 .page =
                                     [&](const std::string& scene, std::uint16_t port) {
                                       if (!common.quiet)
                                         print_address(scene, wiring.page.address, port,
                                                       wiring.to.take_stdout() ? stderr : stdout);
                                     },
                                 .status =
                                     [&] {
                                       return [line = std::make_shared<StatusLine>(common.quiet)](
                                                  const live::Status& status, int viewers) {
                                         line->show(status, viewers);
                                       };
                                     }};
  try {
    live::run_live(options, wiring, recording ? &*recording : nullptr, options.scene, calls);
  } catch (const core::Stopped&) {  // while the scene was opened: as good an end
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
