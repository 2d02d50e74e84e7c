// The TOML document behind a ConfigTable and its sub-tables, and how its values are told. Private:
// carries toml++'s types.
#pragma once

#include <toml++/toml.h>

#include <functional>
#include <map>
#include <set>
#include <string>

#include "core/config_table.h"

namespace fanbeam::core {

struct ConfigTable::Document {
  toml::table root;
  std::string file;
  ProblemList* problems = nullptr;
  std::map<const void*, std::set<std::string, std::less<>>>
      asked;  // per table: keys that exist or could
  ResolvedConfig resolved;

  void report_unknown(const toml::table& table, const std::string& prefix);
};

inline Place place_of(const toml::source_region& source, const std::string& file) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

// As it stands in the file, short enough for a message.
std::string value_text(const toml::node& node);

}  // namespace fanbeam::core
