// What fanbeam list prints: things by name, each with what is said of it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fanbeam::apps {

struct ListedThing {
  std::string name;
  std::vector<std::string> columns;  // as many as the listing has headings; the last may be long
  nlohmann::ordered_json json;       // an object that begins with "name"
};

struct Listing {
  std::vector<std::string> headings;  // of the columns beside the name
  std::vector<ListedThing> things;
  std::string note;  // for people, below
};

// One of each kind. Throw InputError for shipped files that are missing or wrong.
Listing listed_scenes(const std::vector<std::filesystem::path>& data_folders);
Listing listed_sensors();
Listing listed_materials();
Listing listed_effects();
Listing listed_products();

}  // namespace fanbeam::apps
