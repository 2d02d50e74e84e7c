#include "scenes/new_scene/buildings_guess.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "scenes/new_scene/words.h"
#include "terrain/buildings/footprints.h"

namespace fanbeam::scenes {
namespace {

constexpr std::size_t kMostTried = 6;  // each is a reading of the file

// Small letters and digits of a name: "building:height" and "BuildingHeight" alike.
std::string plain(std::string_view name) {
  std::string letters;
  for (const char letter : name.substr(0, 100))
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return letters;
}

bool is_underside(const std::string& letters) { return letters.find("min") != std::string::npos; }

bool is_height(const std::string& letters) {
  constexpr std::array<std::string_view, 5> kWords = {"height", "hoehe", "hgt", "hauteur",
                                                      "altura"};
  constexpr std::array<std::string_view, 5> kOthers = {"level", "elev", "ground", "source",
                                                       "roofheight"};
  const auto holds = [&](std::string_view word) { return letters.find(word) != std::string::npos; };
  return std::any_of(kWords.begin(), kWords.end(), holds) &&
         std::none_of(kOthers.begin(), kOthers.end(), holds);
}

// Features without the property, or nothing where some of its values are no heights.
std::optional<std::size_t> features_without(const std::filesystem::path& file,
                                            const std::string& property) {
  terrain::FootprintOptions options;
  options.height_property = property;
  options.min_height_property.clear();
  core::ProblemList told;
  try {
    terrain::read_footprints(file, options, told);
  } catch (const core::InputError&) {
    return std::nullopt;
  }
  for (const core::Problem& problem : told.all())
    if (problem.code == "W-DEFAULT") return std::stoul(problem.value);
  return 0;
}

// Whether the property is a height everywhere and most buildings stand on the ground by it: as the lowest point of a
// roof it would raise all.
bool leaves_most_standing(const std::filesystem::path& file, terrain::FootprintOptions options,
                          const std::string& property) {
  core::ProblemList told;
  options.min_height_property.clear();
  const std::size_t all = terrain::read_footprints(file, options, told).size();
  options.min_height_property = property;
  try {
    const auto footprints = terrain::read_footprints(file, options, told);
    const auto standing =
        std::count_if(footprints.begin(), footprints.end(),
                      [](const terrain::Footprint& each) { return each.min_height_m == 0.0; });
    return 2 * static_cast<std::size_t>(standing) >= all;
  } catch (const core::InputError&) {
    return false;
  }
}

// As BuildingsGuess has it, beside the height of `options`.
std::optional<std::string> underside_of(const std::filesystem::path& file,
                                        const std::vector<std::string>& properties,
                                        const terrain::FootprintOptions& options) {
  const auto goes_with_height = [&](const std::string& property) {
    std::string letters = plain(property);
    return is_underside(letters) &&
           letters.erase(letters.find("min"), 3) == plain(options.height_property);
  };
  const auto named = std::find_if(properties.begin(), properties.end(), goes_with_height);
  if (named != properties.end() && leaves_most_standing(file, options, *named)) return *named;
  // Names are the same to the reader in small letters and in capitals.
  const std::string& otherwise = options.min_height_property;
  const auto there = std::find_if(
      properties.begin(), properties.end(),
      [&](const std::string& property) { return plain(property) == plain(otherwise); });
  if (there == properties.end()) return std::nullopt;
  const bool rejected = there == named || !leaves_most_standing(file, options, otherwise);
  return rejected ? std::optional<std::string>("") : std::nullopt;
}

}  // namespace

std::optional<BuildingsGuess> guess_buildings(const std::filesystem::path& file, Notes& notes,
                                              core::ProblemList& problems) {
  try {
    const std::vector<std::string> properties = terrain::footprint_properties(file);
    BuildingsGuess guess;
    std::optional<std::size_t> fewest;
    std::vector<std::string> tried;
    for (const std::string& property : properties) {
      const std::string letters = plain(property);
      if (!is_height(letters) || is_underside(letters) || tried.size() >= kMostTried) continue;
      tried.push_back(property);
      const std::optional<std::size_t> without = features_without(file, property);
      if (!without || (fewest && *fewest <= *without)) continue;
      fewest = without;
      guess.height_property = property;
    }
    core::ProblemList told;
    terrain::FootprintOptions options;
    if (fewest) options.height_property = guess.height_property;
    guess.min_height_property = underside_of(file, properties, options);
    options.min_height_property = guess.min_height_property.value_or(options.min_height_property);
    const std::size_t count = terrain::read_footprints(file, options, told).size();
    std::string text =
        safe_words(file.filename().string()) + ": " + std::to_string(count) + " footprints";
    if (fewest)
      text += ", heights from \"" + safe_words(guess.height_property) + "\"" +
              (*fewest == 0 ? "" : ", of " + std::to_string(*fewest) + " without it 5 m");
    else if (tried.empty())
      text += ", 5 m each: no property speaks of a height";
    else
      text += ", 5 m each: \"" + safe_words(tried.front()) + "\" is not always a number of metres";
    const auto& underside = guess.min_height_property;
    if (underside && underside->empty())
      text += ", all from the ground up: \"" + terrain::FootprintOptions().min_height_property +
              "\" is no underside of most";
    else if (underside)
      text += ", undersides from \"" + safe_words(*underside) + "\"";
    notes.push_back({"buildings", text, !fewest || *fewest > 0 || underside});
    return guess;
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return std::nullopt;
  }
}

}  // namespace fanbeam::scenes
