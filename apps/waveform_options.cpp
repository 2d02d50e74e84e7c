#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/number_check.h"
#include "apps/value_words.h"
#include "apps/waveform_command.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::apps {

CLI::App& add_waveform_command(CLI::App& program, WaveformOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "waveform", "What a radar waveform can measure, and what it reads for a target");
  std::vector<std::string> kinds;
  for (const signal::WaveformKind kind : signal::all_waveform_kinds())
    kinds.emplace_back(signal::name(kind));
  command.add_option("KIND", options.kind, "Kind of waveform")
      ->check(CLI::IsMember(kinds))
      ->capture_default_str();
  for (std::size_t i = 0; i < session::kWaveformNumbers.size(); ++i) {
    const session::WaveformNumber& number = session::kWaveformNumbers[i];
    command.add_option(number.option, options.numbers[i], number.help)
        ->check(number_from(number.least, number.most));
  }
  command.add_flag("--real", options.real, "Real samples: negative beats read as positive ones");
  command.add_flag("--down-first", options.down_first, "The triangle begins with the ramp down");
  CLI::Option* range =
      command.add_option("--range", options.range_m, "A target's range, m: prints its beats")
          ->check(number_from(1e-3, 1e7));
  command
      .add_option("--speed", options.speed_mps,
                  "Its radial speed, m/s, positive receding (default 0)")
      ->check(number_from(-9e4, 9e4))
      ->needs(range);
  command
      .add_flag("--refuse-folding", options.refuse_folding,
                "A target beyond the unambiguous spans is an error")
      ->needs(range);
  command
      .add_option(
          "--mixer", options.mixer,
          "Folder for what the mixer gets and gives: transmitted, received, product and beat "
          "of the first ramp or step, as tables and a picture")
      ->type_name(kFolderValue)
      ->needs(range);
  command.add_flag("--json", options.json, "Print JSON");
  command.footer(
      "A parameter that the kind does not have is refused. The range of a triangle's target is "
      "that at its turnaround. Beats are transmitted minus received frequency: a receding target's "
      "Doppler is positive.");
  return command;
}

}  // namespace fanbeam::apps
