#include "datasets/airport_scene.h"

#include "core/files.h"
#include "scenes/airport/airport_reader.h"
#include "scenes/new_scene/new_scene.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestCopied_bytes = 1ULL << 30U;

struct Found {
  fs::path file, root;
};

Found find(const std::string& name, const char* field, const CampaignAirport& airport,
           const std::vector<fs::path>& folders, core::ProblemList& problems) {
  if (name.empty()) return {};
  std::string looked;
  for (const fs::path& folder : folders) {
    std::error_code none;
    if (core::lies_inside(folder, folder / name) && fs::is_regular_file(folder / name, none))
      return {folder / name, folder};
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  problems.error(core::ErrorClass::io, airport.place, std::string("airport.") + field,
                 "\"" + name + "\" not found", "a file in one of " + looked);
  return {};
}

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
  std::vector<fs::path> folders = {fs::absolute(campaign.file).parent_path().lexically_normal()};
  folders.insert(folders.end(), data_folders.begin(), data_folders.end());
  core::ProblemList problems;
  const Found runways = find(airport.file, "file", airport, folders, problems);
  const Found elevation = find(airport.elevation, "elevation", airport, folders, problems);
  const Found buildings = find(airport.buildings, "buildings", airport, folders, problems);
  problems.throw_if_errors();

  scenes::NewSceneRequest request;
  request.name = airport.name;
  request.airport = scenes::read_airport(runways.file, airport.ident, problems);
  request.airport_source = runways.file.filename().string();
  request.runway = airport.runway;
  request.elevation = elevation.file;
  request.buildings = buildings.file;
  request.data_folder = elevation.root;
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
