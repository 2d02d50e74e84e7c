#include "apps/help/command_notes.h"

#include <map>

namespace fanbeam::apps {
namespace {

struct CommandExample {
  std::string_view command, line, what;
};

// Of a command in the order of these rows.
constexpr CommandExample kExamples[] = {
    {"", "fanbeam list scenes", "what can be rendered"},
    {"", "fanbeam render", "pictures of the default scene, to out/braunschweig-26"},
    {"", "fanbeam validate my-scene", "what is wrong with a scene of your own"},
    {"", "fanbeam help render", "all that render can do, with examples"},
    {"render", "fanbeam render", "the default scene, to out/braunschweig-26"},
    {"render", "fanbeam render flat-grass --products bscope,power -o /tmp/grass",
     "B-scope as PNG and power in watts as EXR"},
    {"render", "fanbeam render braunschweig-26 --frames 0:160:16 --accuracy 0.5",
     "a frame a second for ten seconds, to half a grey level"},
    {"render", "fanbeam render rain-94ghz --frames 40 --sensor hivision --effects +multipath,-gas",
     "one frame with a radar at 35 GHz instead, without the loss in gas"},
    {"render", "fanbeam render my-scene --data ~/terrain --resume",
     "a scene of your own with its terrain elsewhere, taken up where it was stopped"},
    {"plan", "fanbeam plan", "which effects the default scene calls for, and why"},
    {"plan", "fanbeam plan rain-94ghz --accuracy 0.1 --json",
     "the same for programs, five times finer"},
    {"plan", "fanbeam plan braunschweig-26 --per-frame --frames 0:50:10",
     "what single frames can go without"},
    {"cost", "fanbeam cost flat-grass --quick", "a short look, to out/flat-grass-cost"},
    {"cost", "fanbeam cost --parts ladder,effects -o /tmp/cost", "without numerics and signals"},
    {"live", "fanbeam live", "round the default scene's runway; look at http://127.0.0.1:8416/"},
    {"live", "fanbeam live keflavik-10 --from native-fdm:5501", "as FlightGear flies it"},
    {"live", "fanbeam live --lockstep --record flight.jsonl --frames 160",
     "ten seconds as fast as they are made, kept for --replay"},
    {"live", "fanbeam live --lockstep --frames 160 --to raw-bscope:frames.gray",
     "the same as raw video (docs/live.md shows it in ffmpeg)"},
    {"live", "fanbeam live obstacle-field --from ils --http 0 --to shm:radar --seconds 60",
     "a minute of the scene's approach, for a program that reads shared memory"},
    {"campaign", "fanbeam campaign plan campaign.toml",
     "what it comes to, by a pilot of a few runs"},
    {"campaign", "fanbeam campaign run campaign.toml",
     "all that is not there yet, to out/<its name>"},
    {"campaign plan", "fanbeam campaign plan campaign.toml",
     "time and disk by a pilot of a few runs"},
    {"campaign plan", "fanbeam campaign plan campaign.toml --no-pilot", "what is drawn alone"},
    {"campaign run", "fanbeam campaign run campaign.toml -o /data/fog",
     "all that is not there yet"},
    {"campaign run", "fanbeam campaign run campaign.toml -o /data/fog --shard 2/8",
     "the second of eight parts, on the second of eight machines"},
    {"campaign run", "fanbeam campaign run campaign.toml -o /data/fog --runs 3,17,40:43 --replace",
     "what verify found damaged"},
    {"campaign status", "fanbeam campaign status campaign.toml -o /data/fog",
     "while others work on it"},
    {"campaign merge", "fanbeam campaign merge campaign.toml -o /data/fog",
     "index.csv, manifest.json, coco.json and lard.csv of all runs there"},
    {"campaign verify", "fanbeam campaign verify campaign.toml -o /data/fog",
     "every file against its hash; says what repairs the rest"},
    {"campaign slurm", "fanbeam campaign slurm campaign.toml --folder /shared/fog --tasks 8",
     "a script that has eight nodes do it: bash job.sh"},
    {"init",
     "fanbeam init my-scene --airport EDNY --runway 24 --runways runways.csv --dem N47E009.hgt",
     "an instrument approach over real terrain, in a folder that validates"},
    {"init",
     "fanbeam init my-scene --airport LOWI --runway 26 --apt-dat apt.dat --dem dem.tif --track "
     "flight.csv --buildings houses.geojson",
     "a recorded flight, with buildings"},
    {"regress", "fanbeam regress run suite.toml",
     "pictures, a page and JUnit XML in out/regress/NAME"},
    {"regress", "fanbeam regress approve suite.toml --reason \"wet grass is brighter\"",
     "from now on these pictures are right"},
    {"regress run", "fanbeam regress run suite.toml --junit results.xml --no-html", "in a CI"},
    {"regress approve",
     "fanbeam regress approve suite.toml --case \"LOWI 26\" --reason \"new taxiway\"",
     "one case of the suite"},
    {"validate", "fanbeam validate my-scene",
     "every problem of a scene, with file, line and column"},
    {"validate", "fanbeam validate my-scene -q && fanbeam render my-scene",
     "pictures of a good scene only"},
    {"doctor", "fanbeam doctor braunschweig-26", "what is delicate, and what to do about it"},
    {"doctor", "fanbeam doctor my-scene --measure --json findings.json",
     "measured on three frames, and written down"},
    {"compare", "fanbeam compare --exact old new", "two folders, every value of every picture"},
    {"compare", "fanbeam compare --rms 0.5 --largest 8 old/bscope/00000.png new/bscope/00000.png",
     "two pictures within half a grey level RMS and eight anywhere"},
    {"fmcw", "fanbeam fmcw", "maps and detections of a street, to out/street-76ghz-fmcw"},
    {"fmcw", "fanbeam fmcw street-76ghz --frames 0:3 --products cube,detections --unfold",
     "three frames: range, speed and azimuth, and what is in them"},
    {"fmcw", "fanbeam fmcw street-76ghz --range-window hann --cfar ca --angle-method music",
     "another window, detector and method of direction"},
    {"fmcw", "fanbeam fmcw braunschweig-26 --products bscope",
     "an aircraft's picture from beat signals"},
    {"waveform", "fanbeam waveform", "what a chirp sequence at 76 GHz resolves"},
    {"waveform", "fanbeam waveform triangle --bandwidth 150 --ramp 1000 --range 80 --speed -12",
     "the beats of a target that closes in"},
    {"track", "fanbeam track highway.json --plots",
     "tracks and errors of every scenario in the file"},
    {"track", "fanbeam track highway.json --scenario crossing --association joint --seed 3",
     "one of them, with another association and another draw"},
    {"track", "fanbeam track street-76ghz --frames 0:40 --plots",
     "a scene: signals, detections, tracks"},
    {"track", "fanbeam track recorded.npy --radar radar.toml", "samples of a radar of your own"},
    {"materials", "fanbeam materials --state wet --polarisation VV",
     "reflectivities of wet surfaces"},
    {"materials", "fanbeam materials plot -o grass.svg short_grass concrete",
     "two of them over grazing angle"},
    {"materials", "fanbeam materials objects", "radar cross-sections"},
    {"materials plot", "fanbeam materials plot -o grass.svg short_grass concrete",
     "two curves at 35 GHz"},
    {"materials plot", "fanbeam materials plot -o all.png --frequency 94", "all of them at 94 GHz"},
    {"materials fit", "fanbeam materials fit --model git-land --terrain grass",
     "a, b, c of a published model"},
    {"materials fit", "fanbeam materials fit --csv measured.csv --json",
     "of measurements of your own"},
    {"materials objects", "fanbeam materials objects", "a line an object"},
    {"atmosphere", "fanbeam atmosphere --fog-visibility 200",
     "loss at 35 GHz in thick fog, to 4 km"},
    {"atmosphere", "fanbeam atmosphere --frequency 35,94 --rain 4 --range 8000 --csv",
     "a table for programs"},
    {"atmosphere", "fanbeam atmosphere --compare 35,94 -o /tmp/bands",
     "which band sees farther, with plots"},
    {"list", "fanbeam list", "names of all there is"},
    {"list", "fanbeam list scenes", "what can be rendered, and whether its data are there"},
    {"list", "fanbeam list effects --json", "for programs"},
    {"help", "fanbeam help render", "its options, with examples"},
    {"help", "source <(fanbeam help --bash-completion)", "completion in this shell"},
};

// Meanings of 1 and of more than 5, which few commands have.
const std::map<std::string_view, ExitCode>& own_exit_codes() {
  static const std::map<std::string_view, ExitCode> codes = {
      {"compare", {"1", "comparison failed", "pictures differ by more than is allowed"}},
      {"doctor", {"1", "something is worse than delicate", ""}},
      {"regress", {"1", "pictures differ or are not approved", ""}},
      {"regress run", {"1", "pictures differ or are not approved", ""}},
      {"render", {"130 or 143", "stopped by Ctrl-C or kill", "whole files only are left"}},
      {"campaign verify",
       {"1", "runs are missing or damaged", "the command that makes them again is printed"}},
      {"campaign plan",
       {"130 or 143", "stopped by Ctrl-C or kill", "nothing of the pilot is left"}},
      {"campaign run", {"130 or 143", "stopped by Ctrl-C or kill", "whole runs only are left"}},
      {"fmcw", {"130 or 143", "stopped by Ctrl-C or kill", "whole files only are left"}},
      {"", {"1", "comparison failed", "pictures differ by more than is allowed"}},
  };
  return codes;
}

}  // namespace

std::vector<Example> examples_of(std::string_view command) {
  std::vector<Example> examples;
  for (const CommandExample& row : kExamples)
    if (row.command == command) examples.push_back({row.line, row.what});
  return examples;
}

std::vector<ExitCode> exit_codes_of(std::string_view command) {
  std::vector<ExitCode> codes = {
      {"0", "done", ""},
      {"2", "usage", "the command line could not be understood; nothing was done"},
      {"3", "invalid input", "a scene or another file is wrong; each problem was told"},
      {"4", "input/output", "a file is not there, or the system refused to read or write one"},
      {"5", "bug", "of fanbeam itself: please report it"}};
  const auto own = own_exit_codes().find(command);
  if (own == own_exit_codes().end()) return codes;
  codes.insert(own->second.codes == "1" ? codes.begin() + 1 : codes.end(), own->second);
  return codes;
}

}  // namespace fanbeam::apps
