// fanbeam live: a radar channel that a simulator, or a built-in flight, keeps moving.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/live_status_line.h"
#include "apps/option_kinds.h"
#include "apps/option_lists.h"
#include "apps/scene_choice.h"
#include "apps/stop_on_signals.h"
#include "core/parallel.h"
#include "live/feed.h"
#include "live/wiring/run.h"
#include "live/wiring/wiring.h"
#include "renderer/casting/sampling.h"
#include "renderer/plan/plan.h"

namespace fanbeam::apps {
namespace {

struct LiveOptions : SceneChoice, live::RunSettings {};

void add_poses(CLI::App& command, LiveOptions& options) {
  CLI::Option* from =
      command
          .add_option(
              "--from", options.from,
              "Where the aircraft is: circle (round the runway, no simulator needed), ils (the "
              "scene's own trajectory, again and again), csv:FILE (that of a file with columns "
              "time_s, latitude_deg, longitude_deg, height_m, again and again too), "
              "native-fdm:[ADDRESS:]PORT "
              "(FlightGear with --native-fdm=socket,out,16,127.0.0.1,PORT,udp), "
              "fg-generic:[ADDRESS:]PORT (FlightGear with the shipped add-on), "
              "cigi:[ADDRESS:]PORT (a CIGI 3.3 host, answered where it sends from, or at "
              ",host=ADDRESS:PORT) or xplane:[ADDRESS:]PORT (X-Plane, which listens at 49000 and "
              "is asked for its position; xplane:beacon finds it on the network). "
              "Behind it ,datum=egm96 (the default) or ,datum=ellipsoid tells what heights count "
              "from (a scene whose own datum is unknown takes them as they are), and ,peer=ADDRESS "
              "whose packets count, which an ADDRESS beyond this machine's own needs; "
              ",weather=simulator (of one that tells it) takes fog, rain and snow from there. "
              "Several simulators that send: the one named first leads, the next counts while "
              "those before it are silent")
          ->type_name("SOURCE")
          ->allow_extra_args(false)
          ->capture_default_str();
  CLI::Option* lockstep =
      command.add_flag("--lockstep", options.lockstep,
                       "One frame for each pose as it is received, with the same sampling: the "
                       "same bytes every time");
  CLI::Option* record = add_file(command, "--record", options.record,
                                 "Keep packets, ticks, samplings and controls, for --replay");
  CLI::Option* replay =
      add_file(command, "--replay", options.replay,
               "Fly what --record kept: with --lockstep every frame of it, byte by byte")
          ->excludes(record)
          ->excludes(from);
  add_number(command, "--speed", options.speed, {0.01, 1000.0},
             "Of a replay, times that of the recording")
      ->needs(replay)
      ->excludes(lockstep)
      ->capture_default_str();
}

void add_sinks(CLI::App& command, LiveOptions& options) {
  command
      .add_option("--to", options.to,
                  "Where frames go beside the page: shm:NAME (a ring of the newest frames in "
                  "shared memory, /dev/shm/NAME; docs/live.md has its layout), raw-bscope:FILE or "
                  "raw-cscope:FILE (8-bit grey, for ffmpeg; - is the standard output) or "
                  "cat240:ADDRESS:PORT (ASTERIX 240 radar video, unicast or multicast; "
                  "docs/live-cat240.md has what may stand behind it)")
      ->type_name("SINK")
      ->allow_extra_args(false);
  command
      .add_option(
          "--http", options.http,
          "Port of the page, on this machine alone, or its ADDRESS:PORT, beyond this machine with "
          "a token; 0 takes any port that is free")
      ->type_name("PORT")
      ->capture_default_str();
  add_file(command, "--token-file", options.token_file,
           "Ask of every request for the token on the file's only line, 16 to 256 letters, "
           "digits, - . _ or ~ (default: FANBEAM_TOKEN in the environment, else none)");
}

CLI::App& declare_live(CLI::App& program, LiveOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "live", "Show what the radar sees from where a simulator is now, on a page in a browser");
  add_scene_choice(command, options);
  add_poses(command, options);
  add_sinks(command, options);
  CLI::Option* const replay = command.get_option("--replay");
  add_number(command, "--rate", options.rate_Hz, {0.1, 1000.0},
             "Frames a second (default: the sensor's)")
      ->excludes(replay);
  add_number(command, "--rays-per-cell", options.rays_per_cell, renderer::kSamplesPerCell,
             "Rays per range cell and column, or azimuth slices per column (fractions: the "
             "next whole number, with fewer rays for bounces; default: the most that keeps "
             "the rate; in lockstep the scene's)")
      ->excludes(replay);
  add_effects_option(command, options.effects, renderer::Touches::pictures);
  add_number(command, "--seconds", options.seconds, {0.1, 1e9},
             "End after so long (default: when stopped)");
  add_whole_number(command, "--frames", options.frames, {1, 1'000'000'000},
                   "End after so many frames (default: when stopped)");
  add_threads_option(command, options.threads);
  command.footer("Ctrl-C and SIGTERM are a good end, as --seconds is: exit code 0.");
  return command;
}

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

// Runs until it is stopped, which is its good end.
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

}  // namespace

void add_live(CommandLine& line) { line.add(declare_live, fly); }

}  // namespace fanbeam::apps
