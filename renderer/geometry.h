// What stands in a scene: seconds to build, then const and shared by all that looks at it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "terrain/buildings/solids.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

enum class ObjectKind { terrain, surface, runway, marking, box, building, model };

// One model of the scene: its parts have `objects` numbers in a row, from `first` on.
struct ModelObjects {
  std::string name;
  terrain::ObjectId first = 0;
  std::size_t objects = 0;
};

struct Geometry {
  std::unique_ptr<const terrain::RayScene> surfaces;
  terrain::Solids solids{};                   // the buildings of `surfaces`, for the profile caster
  std::vector<std::string> material_names{};  // by material id
  std::vector<std::string> object_names{};    // by terrain::ObjectId
  std::vector<ObjectKind> object_kinds{};     // the same
  std::vector<ModelObjects> models{};         // by rising first
};

}  // namespace fanbeam::renderer
