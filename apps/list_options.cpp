#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/list_command.h"

namespace fanbeam::apps {

CLI::App& add_list_command(CLI::App& program, ListOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "list", "List the scenes, sensors, materials, effects and products that there are");
  CLI::Option* what =
      command.add_option("WHAT", options.what, "Left out: the names of them all")
          ->check(CLI::IsMember({"scenes", "sensors", "materials", "effects", "products"}));
  CLI::Option* json = command.add_flag("--json", options.json, "Print JSON");
  command.add_flag("--names", options.names, "Print the names alone, one a line")
      ->needs(what)
      ->excludes(json);
  add_data_option(command, options.data,
                  std::string(kDataOrder) + ": are the files of the scenes there?");
  command.callback([&options] {
    const bool told =
        options.what.empty() ? options.json : options.what == "scenes" && !options.names;
    if (!options.data.empty() && !told)
      throw CLI::ValidationError("--data",
                                 "only tells in fanbeam list scenes, and in the JSON of "
                                 "everything, whether the files of scenes "
                                 "are there");
  });
  return command;
}

}  // namespace fanbeam::apps
