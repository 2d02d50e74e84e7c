// fanbeam list: what there is to choose from.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/text_table.h"
#include "session/listing.h"
#include "session/signal/fmcw_settings.h"

namespace fanbeam::apps {
namespace {

using Json = nlohmann::ordered_json;
using session::ListedThing, session::Listing;

struct ListOptions {
  std::string what;  // "scenes", "sensors", "materials", "effects" or "products"; empty: all, short
  std::string data;  // as in the other commands: are the scenes' files there?
  bool json = false;
  bool names = false;  // alone, one a line
};

CLI::App& declare_list(CLI::App& program, ListOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "list", "List the scenes, sensors, materials, effects and products that there are");
  CLI::Option* what = add_word(command, "WHAT", options.what,
                               {"scenes", "sensors", "materials", "effects", "products"},
                               "Left out: the names of them all");
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

constexpr const char* kKinds[] = {"scenes", "sensors", "materials", "effects", "products"};

Listing listing_of(const std::string& kind, const ListOptions& options) {
  if (kind == "scenes") return session::listed_scenes(shipped_folder(), data_folders(options.data));
  if (kind == "sensors") return session::listed_sensors(shipped_folder());
  if (kind == "materials") return session::listed_materials(shipped_folder());
  if (kind == "effects") return session::listed_effects();
  constexpr session::CommandProducts kAll[] = {{"render", session::kProducts},
                                               {"fmcw", session::kFmcwProducts}};
  return session::listed_products(kAll);
}

// A name may come twice: fmcw has a bscope too.
std::vector<std::string> names_in(const Listing& listing) {
  std::vector<std::string> names;
  for (const ListedThing& thing : listing.things)
    if (std::find(names.begin(), names.end(), thing.name) == names.end())
      names.push_back(thing.name);
  return names;
}

Json json_of(const Listing& listing) {
  Json json = Json::array();
  for (const ListedThing& thing : listing.things) json.push_back(Json::parse(thing.json));
  return json;
}

void print_names(const std::string& kind, const Listing& listing) {
  std::string text;
  for (const std::string& name : names_in(listing)) text += (text.empty() ? "" : " ") + name;
  fmt::print("{}", beside(fmt::format("{:<11}", kind), text));
}

void print_table(const std::string& kind, const Listing& listing) {
  std::vector<ListedThing> rows = listing.things;
  rows.insert(rows.begin(), ListedThing{kind, listing.headings, {}});
  std::vector<std::size_t> widths(listing.headings.size(), 0);  // of the name and all but the last
  for (const ListedThing& row : rows) {
    widths[0] = std::max(widths[0], row.name.size());
    for (std::size_t i = 1; i < widths.size(); ++i)
      widths[i] = std::max(widths[i], row.columns[i - 1].size());
  }
  for (const ListedThing& row : rows) {
    std::string lead = fmt::format("{:<{}}  ", row.name, widths[0]);
    for (std::size_t i = 1; i < widths.size(); ++i)
      lead += fmt::format("{:<{}}  ", row.columns[i - 1], widths[i]);
    fmt::print("{}", beside(lead, row.columns.back()));
  }
}

int list(const ListOptions& options, const CommonOptions& common) {
  if (options.what.empty()) {
    Json all;
    for (const char* kind : kKinds) {
      const Listing listing = listing_of(kind, options);
      if (options.json) all[kind] = json_of(listing);
      if (!options.json) print_names(kind, listing);
    }
    if (options.json) fmt::print("{}\n", all.dump(1));
    if (!options.json && !common.quiet)
      fmt::print("\nfanbeam list scenes tells more, and so on.\n");
    return kExitDone;
  }
  const Listing listing = listing_of(options.what, options);
  if (options.json) {
    fmt::print("{}\n", Json{{options.what, json_of(listing)}}.dump(1));
  } else if (options.names) {
    for (const std::string& name : names_in(listing)) fmt::print("{}\n", name);
  } else {
    print_table(options.what, listing);
    if (!common.quiet) fmt::print("\n{}", beside("", listing.note));
  }
  return kExitDone;
}

}  // namespace

void add_list(CommandLine& line) { line.add(declare_list, list); }

}  // namespace fanbeam::apps
