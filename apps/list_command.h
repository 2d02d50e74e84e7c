// fanbeam list: what there is to choose from.
#pragma once

#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

struct ListOptions {
  std::string what;  // "scenes", "sensors", "materials", "effects" or "products"; empty: all, short
  std::string data;  // as in the other commands: are the scenes' files there?
  bool json = false;
  bool names = false;  // alone, one a line
};

// Returns an exit code; throws InputError E-IO as shipped_folder, or for what is wrong with a
// shipped file.
int list(const ListOptions& options, const CommonOptions& common);
CLI::App& add_list_command(CLI::App& program, ListOptions& options);

}  // namespace fanbeam::apps
