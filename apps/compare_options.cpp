#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/compare_command.h"
#include "apps/number_check.h"
#include "apps/value_words.h"

namespace fanbeam::apps {

CLI::App& add_compare_command(CLI::App& program, CompareOptions& options) {
  CLI::App& command =
      *program.add_subcommand("compare", "Compare two images or two folders of images");
  command.add_option("A", options.a, "Image (PNG, EXR) or folder of images")
      ->type_name(kFileValue)
      ->required();
  command.add_option("B", options.b, "Another of the same kind")->type_name(kFileValue)->required();
  CLI::Option* rms =
      command
          .add_option("--rms", options.rms,
                      "Largest RMS difference allowed: grey levels for PNG, dB for power layers "
                      "(default: 0, but none beside another limit)")
          ->check(number_from(0.0, 1000.0));
  CLI::Option* largest =
      command
          .add_option("--largest", options.largest,
                      "Largest single difference allowed, same units (0 or default: any)")
          ->check(number_from(0.0, 1000.0));
  CLI::Option* percent =
      command
          .add_option("--percent", options.percent_different,
                      "Largest share of differing cells allowed, per cent (default: any)")
          ->check(number_from(0.0, 100.0));
  command.add_flag("--exact", options.exact, "Every value equal")
      ->excludes(rms)
      ->excludes(largest)
      ->excludes(percent);
  command
      .add_option("--heat-map", options.heat_map,
                  "Draw where they differ, B - A in grey levels or dB: a PNG file for two images; "
                  "for two folders a folder of maps of the pairs that differ")
      ->type_name(kFileValue);
  return command;
}

}  // namespace fanbeam::apps
