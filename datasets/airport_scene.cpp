#include "datasets/airport_scene.h"

#include "core/files.h"
#include "scenes/airport/airport_reader.h"
#include "scenes/data_search.h"
#include "scenes/new_scene/new_scene.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestCopied_bytes = 1ULL << 30U;

// Unless it is there already, by this worker or another. Whole, whoever is killed meanwhile.
void put(const fs::path& file, const std::string& bytes) {
  std::error_code none;
  if (fs::file_size(file, none) == bytes.size() && !none &&
      core::read_file(file, bytes.size()) == bytes)
    return;
  core::write_file_atomically(file, bytes);
}

}  // namespace

fs::path airport_scene(const Campaign& campaign, const CampaignAirport& airport,
                       const fs::path& output, const std::vector<fs::path>& data_folders) {
  const scenes::DataSearch search(campaign.folder(), data_folders);
  core::ProblemList problems;
  const auto find = [&](const std::string& name, const char* field) {
    return search.find(name, airport.place, std::string("airport.") + field, problems);
  };
  const fs::path runways = find(airport.file, "file");
  const fs::path elevation = find(airport.elevation, "elevation");
  const fs::path buildings = airport.buildings.empty() ? "" : find(airport.buildings, "buildings");
  problems.throw_if_errors();

  scenes::NewSceneRequest request;
  request.name = airport.name;
  request.airport = scenes::read_airport(runways, airport.ident, problems);
  request.airport_source = runways.filename().string();
  request.runway = airport.runway;
  request.elevation = elevation;
  request.buildings = buildings;
  request.data_folder = search.root_of(elevation);
  request.start_distance_m = airport.start_distance_m;
  request.glide_path_deg = airport.glide_path_deg;
  const std::optional<scenes::NewScene> scene = scenes::make_new_scene(request, problems);
  problems.throw_if_errors();
  const fs::path folder = output / "scenes" / airport.name;
  for (const scenes::NewSceneFile& file : scene->files)  // buildings of another data folder
    put(folder / file.name, core::read_file(file.from, kLargestCopied_bytes));
  put(folder / "scene.toml", scene->text);
  return folder;
}

}  // namespace fanbeam::datasets
