#include "scenes/scene_names.h"

#include <set>
#include <string>

namespace fanbeam::scenes {
namespace {

constexpr const char* kDefault = ", the default";

class NameCheck {
 public:
  NameCheck(const SceneDescription& scene, const MaterialNames& materials, bool read_well,
            core::ProblemList& problems)
      : scene_(scene), materials_(materials), read_well_(read_well), problems_(problems) {
    for (const RunwayDescription& runway : scene.runways)
      for (const RunwayEndDescription& end : runway.ends)
        if (ends_.insert(end.name).second)
          listed_ends_ += (listed_ends_.empty() ? "\"" : ", \"") + end.name + "\"";
  }

  // `unwritten` is said behind the path of a key that is not there; none: then its default may not be needed.
  void material(const std::string& name, const std::string& path, const core::Place& table,
                const char* unwritten) {
    if (materials_.knows(name) || was_told(name)) return;
    const std::optional<core::Place> written = place_of(path);
    if (written)
      materials_.refuse(name, *written, path);
    else if (unwritten != nullptr)
      materials_.refuse(name, table, path + unwritten);
  }

  void runway(const std::string& name, const std::string& path, const core::Place& table) {
    if (ends_.contains(name) || was_told(name) || !(read_well_ || scene_.runways_known)) return;
    problems_.error(
        core::ErrorClass::ref, place_of(path).value_or(table), path, "\"" + name + "\"",
        ends_.empty() ? "a [[runway]] in this scene" : "one of the runway ends " + listed_ends_);
  }

  void spot(const Spot& spot) {
    if (spot.on_runway) runway(spot.runway_end, spot.field + ".runway", spot.place);
  }

 private:
  // One that could not be read is empty.
  bool was_told(const std::string& name) const {
    return problems_.is_full() || (!read_well_ && name.empty());
  }

  std::optional<core::Place> place_of(const std::string& path) const {
    return scene_.place_of_key ? scene_.place_of_key(path) : std::nullopt;
  }

  const SceneDescription& scene_;
  const MaterialNames& materials_;
  bool read_well_;
  core::ProblemList& problems_;
  std::set<std::string> ends_;
  std::string listed_ends_;  // in the order of the file
};

// Of every entry, with its path: "box[2]".
template <class Entry, class CheckOne>
void check_each(const std::vector<Entry>& entries, const char* key, NameCheck& check,
                CheckOne check_one) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    check_one(entries[i], std::string(key) + "[" + std::to_string(i) + "]", check);
}

void check_terrain(const TerrainDescription& terrain, NameCheck& check) {
  check.material(terrain.material, "terrain.material", terrain.place, kDefault);
  for (const auto& [number, name] : terrain.classes)
    check.material(name, "terrain.land_cover.classes." + std::to_string(number), terrain.place, "");
  if (terrain.source != TerrainDescription::Source::rolling) return;
  for (std::size_t i = 0; i < terrain.fields.size(); ++i)
    check.material(terrain.fields[i], "terrain.fields[" + std::to_string(i) + "]", terrain.place,
                   kDefault);
  check.material(terrain.wood_material, "terrain.wood_material", terrain.place, kDefault);
  check.material(terrain.airfield_material, "terrain.airfield_material", terrain.place, kDefault);
}

void check_runway(const RunwayDescription& runway, const std::string& path, NameCheck& check) {
  if (runway.from_airport) return;  // has no keys, and ends of its own alone
  check.material(runway.surface, path + ".surface", runway.place, kDefault);
  check.material(runway.shoulder_material, path + ".shoulder", runway.place, kDefault);
  check.material(runway.marking_material, path + ".marking", runway.place, kDefault);
  for (const std::string& end : runway.approach_lights)
    check.runway(end, path + ".approach_lights", runway.place);
}

void check_surface(const SurfaceDescription& surface, const std::string& path, NameCheck& check) {
  check.runway(surface.runway_end, path + ".runway", surface.place);
  check.material(surface.material, path + ".material", surface.place, "");
}

void check_model(const ModelDescription& model, const std::string& path, NameCheck& check) {
  check.spot(model.at);
  check.material(model.default_material, path + ".default_material", model.place, nullptr);
  for (const auto& [own, name] : model.materials)
    check.material(name, path + ".materials." + own, model.place, "");
}

void check_box(const BoxDescription& box, const std::string& path, NameCheck& check) {
  check.spot(box.at);
  check.material(box.wall_material, path + ".wall", box.place, kDefault);
  check.material(box.roof_material, path + ".roof", box.place, kDefault);
}

void check_buildings(const BuildingsDescription& buildings, const std::string& path,
                     NameCheck& check) {
  check.material(buildings.wall_material, path + ".wall", buildings.place, nullptr);
  check.material(buildings.roof_material, path + ".roof", buildings.place, nullptr);
  for (const auto& [surface, name] : buildings.surface_materials)
    check.material(name, path + ".surfaces." + surface, buildings.place, "");
}

void check_way(const TargetDescription& target, NameCheck& check) {
  const std::string* before = nullptr;  // all of a highway's way stands at one key
  for (const TargetDescription::Waypoint& waypoint : target.path) {
    if (before == nullptr || *before != waypoint.at.field) check.spot(waypoint.at);
    before = &waypoint.at.field;
  }
}

void check_trajectory(const TrajectoryDescription& trajectory, NameCheck& check) {
  using Kind = TrajectoryDescription::Kind;
  if (trajectory.kind == Kind::ils)
    check.runway(trajectory.ils_end, "trajectory.ils.runway", trajectory.place);
  if (trajectory.kind == Kind::file && trajectory.transplanted)
    check.runway(trajectory.onto_end, "trajectory.transplant.onto_runway", trajectory.place);
  if (trajectory.kind == Kind::fixed) check.spot(trajectory.at);
}

}  // namespace

void check_names(const SceneDescription& scene, const MaterialNames& materials, bool read_well,
                 core::ProblemList& problems) {
  NameCheck check(scene, materials, read_well, problems);
  check_terrain(scene.terrain, check);
  check_each(scene.runways, "runway", check, check_runway);
  check_each(scene.surfaces, "surface", check, check_surface);
  check_each(scene.models, "model", check, check_model);
  check_each(scene.boxes, "box", check, check_box);
  check_each(scene.buildings, "buildings", check, check_buildings);
  for (const TargetDescription& target : scene.targets) check_way(target, check);
  for (const LineDescription& line : scene.lines) {
    check.spot(line.from);
    check.spot(line.to);
  }
  for (const RainCellDescription& cell : scene.rain_cells) check.spot(cell.at);
  check_trajectory(scene.trajectory, check);
}

}  // namespace fanbeam::scenes
