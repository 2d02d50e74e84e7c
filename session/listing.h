// What there is to choose from: things by name, each with what is said of it (fanbeam list).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "session/products/products.h"

namespace fanbeam::session {

struct ListedThing {
  std::string name;
  std::vector<std::string> columns;  // as many as the listing has headings; the last may be long
  std::string json;                  // an object that begins with "name"
};

struct Listing {
  std::vector<std::string> headings;  // of the columns beside the name
  std::vector<ListedThing> things;
  std::string note;  // for people, below
};

// One of each kind; `shipped` as shipped_above gives it. Throw InputError for shipped files that are
// missing or wrong.
Listing listed_scenes(const std::filesystem::path& shipped,
                      const std::vector<std::filesystem::path>& data_folders);
Listing listed_sensors(const std::filesystem::path& shipped);
Listing listed_materials(const std::filesystem::path& shipped);
Listing listed_effects();

// Of each command that makes some.
struct CommandProducts {
  const char* command;
  std::span<const Product> products;
};
Listing listed_products(std::span<const CommandProducts> all);

}  // namespace fanbeam::session
