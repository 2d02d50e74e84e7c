#include "session/products/layers_product.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/units.h"

namespace fanbeam::session {
namespace {

using renderer::LayerSet;

// A layer of the files: its name says its unit.
struct FileLayer {
  const char* name;
  const char* what;
  bool of_bscope, of_cscope;
  std::function<double(const LayerSet&, std::size_t)> value;
};

double whole_dB(float nrcs) {
  return nrcs > 0.0F ? std::max(10.0 * std::log10(static_cast<double>(nrcs)), kNoNrcs_dB)
                     : kNoNrcs_dB;
}

const std::vector<FileLayer>& file_layers() {
  static const std::vector<FileLayer> kLayers = {
      {"visibility_share",
       "share of the column's width in which something in the cell is seen: 0 in shadow", true,
       true,
       [](const LayerSet& set, std::size_t i) { return static_cast<double>(set.visibility[i]); }},
      {"range_m", "mean slant range, weighted with the echo's power", false, true,
       [](const LayerSet& set, std::size_t i) { return static_cast<double>(set.range_m[i]); }},
      {"elevation_deg", "elevation of a strong part of the object told, in the antenna's frame",
       true, false,
       [](const LayerSet& set, std::size_t i) {
         return core::degrees(static_cast<double>(set.elevation_rad[i]));
       }},
      {"grazing_deg",
       "local grazing angle whose sine is the mean one, weighted with the echo's power", true, true,
       [](const LayerSet& set, std::size_t i) {
         return core::degrees(static_cast<double>(set.grazing_rad[i]));
       }},
      {"nrcs_dB", "mean NRCS sigma0, weighted with the echo's power; -400 where nothing is seen",
       true, true, [](const LayerSet& set, std::size_t i) { return whole_dB(set.nrcs[i]); }},
      {"material_id",
       "of what sends most of the object told; -1 of a point target and where nothing is seen",
       true, true,
       [](const LayerSet& set, std::size_t i) {
         return set.material[i] == renderer::kNoMaterial ? -1.0
                                                         : static_cast<double>(set.material[i]);
       }},
      {"object_id",
       "of what sends more than half of the power, if something does; 0, the terrain, where "
       "nothing is seen too",
       true, true,
       [](const LayerSet& set, std::size_t i) { return static_cast<double>(set.object[i]); }},
      {"double_bounce_share",
       "share of the power from surfaces and rain that came by two or three reflections", true,
       true, [](const LayerSet& set, std::size_t i) {
         return static_cast<double>(set.double_bounce[i]);
       }}};
  return kLayers;
}

}  // namespace

core::Image bscope_layers(const LayerSet& layers, const sensors::Sensor& sensor) {
  core::Image image{sensor.scan.columns, sensor.range.cells, {}};
  const auto columns = static_cast<std::size_t>(image.columns);
  const auto rows = static_cast<std::size_t>(image.rows);
  for (const FileLayer& layer : file_layers()) {
    if (!layer.of_bscope) continue;
    std::vector<double> values;
    values.reserve(rows * columns);
    for (std::size_t row = rows; row-- > 0;)
      for (std::size_t column = 0; column < columns; ++column)
        values.push_back(layer.value(layers, row * columns + column));
    image.layers.push_back({layer.name, std::move(values)});
  }
  return image;
}

core::Image cscope_layers(const LayerSet& layers, const sensors::Sensor& sensor) {
  core::Image image{sensor.scan.columns, sensor.display.cscope_rows, {}};
  const auto cells = static_cast<std::size_t>(image.columns) * static_cast<std::size_t>(image.rows);
  for (const FileLayer& layer : file_layers()) {
    if (!layer.of_cscope) continue;
    std::vector<double> values(cells);
    for (std::size_t i = 0; i < cells; ++i) values[i] = layer.value(layers, i);
    image.layers.push_back({layer.name, std::move(values)});
  }
  return image;
}

std::string layers_json(const scenes::Scene& scene) {
  nlohmann::ordered_json json;
  for (const FileLayer& layer : file_layers()) json["layers"][layer.name] = layer.what;
  json["materials"] = scene.world.geometry->material_names;
  nlohmann::ordered_json& objects = json["objects"] = nlohmann::ordered_json::array();
  while (const std::string* name =
             renderer::object_name(scene.world, static_cast<terrain::ObjectId>(objects.size())))
    objects.push_back(*name);
  return json.dump(1) + "\n";
}

}  // namespace fanbeam::session
