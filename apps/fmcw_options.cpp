#include <CLI/CLI.hpp>
#include <string_view>

#include "apps/command_line.h"
#include "apps/fmcw_command.h"
#include "apps/option_kinds.h"
#include "apps/option_lists.h"
#include "core/text.h"
#include "renderer/casting/sampling.h"
#include "scenes/scene.h"
#include "session/signal/radar_file.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::apps {
namespace {

// Before the options that replace what the file says: they are taken in the order of declaration.
void add_radar_file(CLI::App& command, FmcwOptions& options) {
  command
      .add_option_function<std::string>(
          "--radar",
          [&options](const std::string& file) {
            core::ProblemList problems;
            session::read_radar_file(file, options, problems);
            problems.throw_if_errors();
            options.radar_file = file;
          },
          "TOML file of a radar: waveform, array, receiver, processing (docs/fmcw.md); options "
          "replace what it says (default: the one that the scene names, if any)")
      ->type_name(kFileValue);
  options.put_given_again = [&command] {
    for (CLI::Option* option : command.get_options())
      if (option->count() > 0) option->run_callback();
  };
}

// Replaces the places that a radar file may give.
void add_elements(CLI::App& command, const char* name, FmcwOptions& options, int& count,
                  const char* what) {
  command
      .add_option_function<int>(
          name,
          [&options, &count](int given) {
            options.put_on_a_line();
            count = given;
          },
          what)
      ->check(whole_number_from(1, 64))
      ->default_str(std::to_string(count));
}

void add_radar(CLI::App& command, FmcwOptions& options) {
  std::vector<std::string> names = {session::kAutomotive};
  for (const signal::WaveformKind kind : signal::all_waveform_kinds())
    names.emplace_back(signal::name(kind));
  add_word(command, "--waveform", options.waveform, names,
           "automotive-76ghz: chirps of 20 us, one transmitter after the other; or a kind "
           "of fanbeam waveform (default: automotive-76ghz for sensors of 70 to 82 GHz, "
           "else chirp-sequence)");
  for (std::size_t i = 0; i < session::kWaveformNumbers.size(); ++i) {
    const session::WaveformNumber& number = session::kWaveformNumbers[i];
    if (std::string_view(number.option) == "--frequency") continue;  // the sensor's
    add_number(command, number.option, options.numbers[i], {number.least, number.most},
               number.help);
  }
  command.add_flag("--real", options.real, "Real samples: negative beats read as positive ones");
  add_elements(command, "--transmitters", options, options.transmitters, "Of the array");
  add_elements(command, "--receivers", options, options.receivers,
               "Of the array, half a wavelength apart");
}

void add_receiver(CLI::App& command, FmcwOptions& options) {
  command
      .add_option_function<double>(
          "--line-width",
          [&options](double given_Hz) {
            options.line_width_Hz = given_Hz;
            if (given_Hz == 0.0) options.phase_noise = {};
          },
          "Of the oscillator, Hz: phase noise (default 0: none, given also of a radar file's "
          "table)")
      ->check(number_from(0.0, 1e6));
  add_whole_number(command, "--adc-bits", options.adc_bits, {0, 24},
                   "Quantise the samples, full scale at the largest (default 0: not)");
  add_number(command, "--adc-full-scale", options.adc_full_scale_dBm, {-300.0, 300.0},
             "Full scale of the quantiser instead, dBm of a tone that just fills it: what is "
             "stronger saturates");
}

// What `read` makes of a word, which is checked before.
template <class Value, class Read>
CLI::Option* add_choice(CLI::App& command, const char* name, Value& value, Read read,
                        const std::string& what) {
  return command.add_option_function<std::string>(
      name, [&value, read](const std::string& word) { value = *read(word); }, what);
}

void add_window(CLI::App& command, const char* name, signal::Window& window, const char* what) {
  add_choice(command, name, window, signal::window_of,
             std::string(what) + " (default " + signal::name(window) + ")")
      ->type_name("WINDOW")
      ->check(CLI::Validator(
          [](std::string& text) {
            return signal::window_of(text) ? std::string()
                                           : text + ": expected " + session::kWindowWords;
          },
          ""));
}

// "4" for both axes, "4,2" for range and Doppler.
void add_span(CLI::App& command, const char* name, session::CellSpan& span, const char* what) {
  command
      .add_option_function<std::vector<int>>(
          name,
          [&span](const std::vector<int>& cells) {
            span = {cells.front(), cells.back()};
          },
          std::string(what) + ": along range and Doppler, or one number for both (default " +
              std::to_string(span.range) + "," + std::to_string(span.doppler) + ")")
      ->type_name("N[,N]")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(whole_number_from(0, 64));
}

void add_processing(CLI::App& command, FmcwOptions& options) {
  add_window(command, "--range-window", options.range_window,
             "Over fast time: rectangular, hann, hamming, blackman, blackman-harris, taylor:DB, "
             "chebyshev:DB or kaiser:BETA");
  add_window(command, "--doppler-window", options.doppler_window, "Over slow time");
  add_window(
      command, "--angle-window", options.angle_window,
      "Over the channels, for the beams of cube, range-azimuth and top-view, not for detections "
      "or what --angle-method capon makes; of arrays on a line at one pitch alone");
  add_choice(
      command, "--mitigation", options.mitigation, signal::mitigation_of,
      "Of samples that other radars' chirps cross ([[interferer]] of the scene): set to 0, or "
      "filled from the rest of the chirp (default none)")
      ->check(CLI::IsMember({"none", "zero", "interpolate"}));
}

void add_detector(CLI::App& command, FmcwOptions& options) {
  add_choice(command, "--cfar", options.cfar, session::cfar_kind,
             "Detector: mean of the cells around (ca), ordered statistic (os), greater (go) or "
             "smaller (so) of two halves' means (default os)")
      ->check(CLI::IsMember({"ca", "os", "go", "so"}));
  add_span(command, "--cfar-guard", options.cfar_guard,
           "Cells on each side that it leaves out, over the windows' main lobe");
  add_span(command, "--cfar-training", options.cfar_training,
           "Cells on each side beyond them that tell the background");
  add_number(command, "--pfa", options.false_alarm_probability, {1e-12, 0.1},
             "False-alarm probability of a cell of the range-Doppler map")
      ->capture_default_str();
}

void add_detections(CLI::App& command, FmcwOptions& options) {
  add_choice(command, "--angle-method", options.angle_method, signal::angle_method,
             "Directions of a cell: the strongest beam; capon and music, of four channels or more "
             "on a line at one pitch (arrays in two dimensions have beamforming alone), tell two "
             "inside a beamwidth apart, capon sharpens the range-azimuth map too (default "
             "beamforming)")
      ->check(CLI::IsMember({"beamforming", "capon", "music"}));
  add_number(command, "--cluster-place", options.cluster_place_m, {1e-3, 1000.0},
             "Metres within which detections are neighbours (default: four widths of the "
             "range response)");
  add_number(command, "--cluster-speed", options.cluster_speed_mps, {1e-3, 1000.0},
             "m/s likewise (default: four widths of the Doppler response)");
  add_whole_number(command, "--cluster-neighbours", options.cluster_neighbours, {1, 100},
                   "Detections, itself included, that make one the core of a cluster")
      ->capture_default_str();
  command.add_flag(
      "--unfold", options.unfold,
      "Tell by transmitters that take turns which fold a detection's speed is in: right for what "
      "is alone in its cell, wrong at times for clutter");
}

void add_maps(CLI::App& command, FmcwOptions& options) {
  command.add_flag("--refuse-folding", options.refuse_folding,
                   "A scatterer beyond the unambiguous spans is an error, not a warning");
  add_number(command, "--dynamic-range", options.dynamic_range_dB, {1.0, 300.0},
             "Of the pictures' colours, dB from the noise up")
      ->capture_default_str();
}

void add_plan(CLI::App& command, FmcwOptions& options) {
  add_accuracy_option(
      command, options.accuracy_grey,
      "Grey levels asked for: half of it is for effects left out (default: the scene's, else " +
          core::number_text(scenes::kDefaultAccuracy_grey) + ")");
  add_effects_option(command, options.effects, renderer::Touches::samples);
}

// The options that `add` declares.
template <class Add>
std::vector<const CLI::Option*> declared_by(CLI::App& command, const Add& add) {
  const auto before = static_cast<std::ptrdiff_t>(command.get_options().size());
  add();
  const std::vector<CLI::Option*> all = command.get_options();
  return {all.begin() + before, all.end()};
}

}  // namespace

CLI::App& declare_fmcw(CLI::App& program, FmcwOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "fmcw",
      "A scene at signal level: beat signals, maps of range, speed and azimuth, detections");
  add_scene_choice(command, options);
  add_output_option(command, options.output, "Folder to write to (default out/<scene name>-fmcw)");
  command.add_flag("--overwrite", options.overwrite,
                   "Write to a folder that holds files of others too, which stay");
  add_frames_option(command, options.frames, kFramesText)->capture_default_str();
  command
      .add_option("--products", options.products,
                  products_help(session::kFmcwProducts) +
                      " (default: maps and detections where the waveform has them, else beat)")
      ->type_name("PRODUCT")
      ->check(offers(names_of(session::kFmcwProducts)));
  add_radar_file(command, options);
  // A B-scope has what they say of its sensor, or not at all.
  const std::vector<const CLI::Option*> chain = declared_by(command, [&] {
    add_radar(command, options);
    add_processing(command, options);
    add_detector(command, options);
    add_detections(command, options);
    add_maps(command, options);
  });
  add_receiver(command, options);
  add_plan(command, options);
  add_number(command, "--rays-per-cell", options.rays_per_cell,
             {renderer::kFewestRaysPerCell, 1000.0},
             "Scatterers per range cell and azimuth column of the sensor")
      ->capture_default_str();
  add_whole_number(
      command, "--looks", options.looks, {1, 100000},
      "Sweeps per column of the B-scope, their powers averaged (default: the sensor's)");
  command.add_option("--spectrogram-of", options.spectrogram_of,
                     "Name, or its beginning, of targets about whose range the spectrogram looks "
                     "(default: all ranges)");
  add_seed_option(command, options.seed);
  add_threads_option(command, options.threads);
  command.footer(
      "Frequency, sweep and element pattern are those of the scene's sensor where no option says "
      "otherwise. Speeds are positive "
      "receding, azimuths positive right. docs/fmcw.md explains every step and file.");
  command.parse_complete_callback([&options, chain] {
    for (const CLI::Option* option : chain)
      if (option->count() > 0) options.given_for_chain.insert(option->get_name());
  });
  return command;
}

}  // namespace fanbeam::apps
