// Ground truth by name.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/c/arguments.h"
#include "bindings/c/handle.h"
#include "bindings/c/last_call.h"

using namespace fanbeam;
using bindings::Arguments;
using renderer::LayerSet;

namespace {

constexpr const char* kOfFrame = "what fanbeam_render left in output.truth";

struct ValueLayer {
  std::string_view name;
  std::vector<float> LayerSet::*values;
  bool of_bscope, of_cscope;
};

constexpr std::array<ValueLayer, 6> kValueLayers = {{
    {"visibility", &LayerSet::visibility, true, true},
    {"range_m", &LayerSet::range_m, false, true},
    {"grazing_rad", &LayerSet::grazing_rad, true, true},
    {"nrcs", &LayerSet::nrcs, true, true},
    {"elevation_rad", &LayerSet::elevation_rad, true, false},
    {"double_bounce", &LayerSet::double_bounce, true, true},
}};

// What both kinds of layers are asked for with; false where there is nothing to look into.
bool checked(Arguments& arguments, const fanbeam_layers* layers, std::uint32_t scope,
             const char* name, const void* buffer, std::size_t count) {
  const bool named = arguments.there(name, "name", "the name of a layer");
  const bool buffered = arguments.there(buffer, "buffer", "rows x columns elements");
  if (!arguments.there(layers, "layers", kOfFrame)) return false;
  if (scope != FANBEAM_BSCOPE && !(scope == FANBEAM_CSCOPE && layers->with_cscope)) {
    arguments.refuse(core::ErrorClass::range, "scope", std::to_string(scope),
                     layers->with_cscope ? "FANBEAM_BSCOPE or FANBEAM_CSCOPE"
                                         : "FANBEAM_BSCOPE, as these are of a B-scope alone");
    return false;
  }
  const bindings::Shape& shape = layers->shape;
  if (buffered)
    arguments.room(buffer, count, scope == FANBEAM_BSCOPE ? shape.bscope() : shape.cscope(),
                   "buffer");
  return named;
}

const LayerSet& set_of(const fanbeam_layers& layers, std::uint32_t scope) {
  return scope == FANBEAM_BSCOPE ? layers.layers.bscope : layers.layers.cscope;
}

const ValueLayer* layer_called(std::string_view name, std::uint32_t scope) {
  for (const ValueLayer& layer : kValueLayers)
    if (layer.name == name && (scope == FANBEAM_BSCOPE ? layer.of_bscope : layer.of_cscope))
      return &layer;
  return nullptr;
}

std::string names_of(std::uint32_t scope) {
  std::string names;
  for (const ValueLayer& layer : kValueLayers)
    if (scope == FANBEAM_BSCOPE ? layer.of_bscope : layer.of_cscope)
      names.append(names.empty() ? "" : ", ").append(layer.name);
  return names;
}

}  // namespace

extern "C" {

fanbeam_status fanbeam_layer_values(const fanbeam_layers* layers, uint32_t scope, const char* name,
                                    float* values, size_t count) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    const ValueLayer* layer = nullptr;
    if (checked(arguments, layers, scope, name, values, count)) {
      layer = layer_called(name, scope);
      if (layer == nullptr)
        arguments.refuse(core::ErrorClass::ref, "name", "\"" + std::string(name) + "\"",
                         names_of(scope));
    }
    arguments.done();
    const std::vector<float>& found = set_of(*layers, scope).*(layer->values);
    std::copy(found.begin(), found.end(), values);
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_layer_ids(const fanbeam_layers* layers, uint32_t scope, const char* name,
                                 uint32_t* ids, size_t count) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    bool materials = false;
    if (checked(arguments, layers, scope, name, ids, count)) {
      materials = std::string_view(name) == "material";
      if (!materials && std::string_view(name) != "object")
        arguments.refuse(core::ErrorClass::ref, "name", "\"" + std::string(name) + "\"",
                         "material, object");
    }
    arguments.done();
    const LayerSet& set = set_of(*layers, scope);
    if (materials)
      std::copy(set.material.begin(), set.material.end(), ids);
    else
      std::copy(set.object.begin(), set.object.end(), ids);
    return FANBEAM_OK;
  });
}

const char* fanbeam_layer_id_name(const fanbeam_layers* layers, const char* name,
                                  uint32_t id) noexcept {
  if (layers == nullptr || name == nullptr) return nullptr;
  const renderer::World& world = layers->scene->world;
  const std::vector<std::string>& materials = world.geometry->material_names;
  if (std::string_view(name) == "material")
    return id < materials.size() ? materials[id].c_str() : nullptr;
  if (std::string_view(name) != "object") return nullptr;
  const std::string* object = renderer::object_name(world, id);
  return object != nullptr ? object->c_str() : nullptr;
}

void fanbeam_free_layers(fanbeam_layers* layers) noexcept { delete layers; }

}  // extern "C"
