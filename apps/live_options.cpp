#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/live_command.h"
#include "apps/number_check.h"
#include "apps/option_lists.h"
#include "apps/value_words.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::apps {
namespace {

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
  CLI::Option* record = command
                            .add_option("--record", options.record,
                                        "Keep packets, ticks, samplings and controls, for --replay")
                            ->type_name("FILE");
  CLI::Option* replay =
      command
          .add_option("--replay", options.replay,
                      "Fly what --record kept: with --lockstep every frame of it, byte by byte")
          ->type_name("FILE")
          ->excludes(record)
          ->excludes(from);
  command.add_option("--speed", options.speed, "Of a replay, times that of the recording")
      ->check(number_from(0.01, 1000.0))
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
  command
      .add_option("--token-file", options.token_file,
                  "Ask of every request for the token on the file's only line, 16 to 256 letters, "
                  "digits, - . _ or ~ (default: FANBEAM_TOKEN in the environment, else none)")
      ->type_name("FILE");
}

}  // namespace

CLI::App& add_live_command(CLI::App& program, LiveOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "live", "Show what the radar sees from where a simulator is now, on a page in a browser");
  add_scene_choice(command, options);
  add_poses(command, options);
  add_sinks(command, options);
  CLI::Option* const replay = command.get_option("--replay");
  command.add_option("--rate", options.rate_Hz, "Frames a second (default: the sensor's)")
      ->check(number_from(0.1, 1000.0))
      ->excludes(replay);
  command
      .add_option("--rays-per-cell", options.rays_per_cell,
                  "Rays per range cell and column, or azimuth slices per column (fractions: the "
                  "next whole number, with fewer rays for bounces; default: the most that keeps "
                  "the rate; in lockstep the scene's)")
      ->check(number_from(renderer::kSamplesPerCell))
      ->excludes(replay);
  add_effects_option(command, options.effects, renderer::Touches::pictures);
  command.add_option("--seconds", options.seconds, "End after so long (default: when stopped)")
      ->check(number_from(0.1, 1e9));
  command
      .add_option("--frames", options.frames, "End after so many frames (default: when stopped)")
      ->check(whole_number_from(1, 1'000'000'000));
  add_threads_option(command, options.threads);
  command.footer("Ctrl-C and SIGTERM are a good end, as --seconds is: exit code 0.");
  return command;
}

}  // namespace fanbeam::apps
