#include "session/listing.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "core/units.h"
#include "materials/library/material_library.h"
#include "renderer/plan/effect_catalogue.h"
#include "scenes/scene_reader.h"
#include "sensors/sensor_file.h"
#include "session/shipped.h"

namespace fanbeam::session {
namespace {

using Json = nlohmann::ordered_json;

// Letters of IEEE Std 521-2019.
const char* band_of(double frequency_Hz) {
  struct Band {
    double below_GHz;
    const char* letter;
  };
  for (const Band& band :
       {Band{1.0, "below L"}, Band{2.0, "L"}, Band{4.0, "S"}, Band{8.0, "C"}, Band{12.0, "X"},
        Band{18.0, "Ku"}, Band{27.0, "K"}, Band{40.0, "Ka"}, Band{75.0, "V"}, Band{110.0, "W"}})
    if (frequency_Hz * 1e-9 < band.below_GHz) return band.letter;
  return "mm";
}

// The values of E-IO problems that a line of the scene asks for: what it names and is not there.
std::vector<std::string> missing_files(const core::ProblemList& problems) {
  std::vector<std::string> files;
  for (const core::Problem& problem : problems.all())
    if (problem.code == code(core::ErrorClass::io)) {
      const std::size_t from = problem.value.find('"') + 1;
      files.push_back(problem.value.substr(from, problem.value.find('"', from) - from));
    }
  return files;
}

}  // namespace

Listing listed_scenes(const std::filesystem::path& shipped,
                      const std::vector<std::filesystem::path>& data_folders) {
  Listing listing{{"data", "what it shows"}, {}, {}};
  bool complete = true;
  for (const std::string& name : shipped_scenes(shipped)) {
    core::ProblemList problems;
    const scenes::SceneDescription scene =
        scenes::read_scene(find_scene(name, shipped), {shipped, data_folders, {}}, problems);
    const std::vector<std::string> missing = missing_files(problems);
    complete = complete && missing.empty();
    listing.things.push_back({name,
                              {missing.empty() ? "there" : "missing", scene.title},
                              Json{{"name", name},
                                   {"title", scene.title},
                                   {"folder", scene.folder.string()},
                                   {"data_found", missing.empty()},
                                   {"missing", missing}}
                                  .dump()});
  }
  listing.note = "fanbeam render NAME makes its pictures; README.md in its folder tells more.";
  if (!complete)
    listing.note +=
        " Scenes without data need files that do not ship with the program: fanbeam validate NAME "
        "names them, --data or FANBEAM_DATA tells where they are.";
  return listing;
}

Listing listed_sensors(const std::filesystem::path& shipped) {
  Listing listing{{"band", "range", "field of view", "cells", "radar"},
                  {},
                  "fanbeam render --sensor NAME looks with it."};
  for (const std::string& name : shipped_sensors(shipped)) {
    core::ProblemList problems;
    const std::filesystem::path file = find_sensor(name, shipped, "--sensor");
    const sensors::Sensor sensor = sensors::read_sensor(file, problems);
    problems.throw_if_errors();
    const double frequency_GHz = sensor.waveform.frequency_Hz * 1e-9;
    const double view_deg = core::degrees(sensor.scan.field_of_view_rad);
    const double beam_deg = core::degrees(sensor.antenna.elevation.half_power_width_rad);
    const std::string band = band_of(sensor.waveform.frequency_Hz);
    listing.things.push_back(
        {name,
         {fmt::format("{:g} GHz, {}", frequency_GHz, band),
          fmt::format("{:.4g} to {:.4g} m", sensor.range.minimum_m, sensor.range.maximum_m()),
          fmt::format("{:.4g} x {:.4g} deg", view_deg, beam_deg),
          fmt::format("{} x {}", sensor.scan.columns, sensor.range.cells), sensor.name},
         Json{{"name", name},
              {"file", file.string()},
              {"radar", sensor.name},
              {"frequency_GHz", frequency_GHz},
              {"band", band},
              {"minimum_range_m", sensor.range.minimum_m},
              {"maximum_range_m", sensor.range.maximum_m()},
              {"range_cell_m", sensor.range.cell_m},
              {"field_of_view_deg", view_deg},
              {"elevation_beam_deg", beam_deg},
              {"columns", sensor.scan.columns},
              {"cells", sensor.range.cells},
              {"frame_rate_Hz", sensor.scan.frame_rate_Hz}}
             .dump()});
  }
  return listing;
}

Listing listed_materials(const std::filesystem::path& shipped) {
  Listing listing{
      {"GHz", "figures", "source"},
      {},
      "fanbeam materials prints their reflectivity; figures say how sure they are: seen "
      "in a source, fitted to one, recalled, or assumed."};
  core::ProblemList problems;
  const auto library =
      materials::MaterialLibrary::from_file(shipped / "materials" / "library.toml", problems);
  problems.throw_if_errors();
  for (const materials::Material& material : library.all()) {
    const materials::ModelValidity known = validity_of(material.model);
    const double low_GHz = known.frequency_Hz.low * 1e-9;
    const double high_GHz = known.frequency_Hz.high * 1e-9;
    const std::string confidence = name_of(material.confidence);
    listing.things.push_back(
        {material.name,
         {fmt::format("{:g}-{:g}", low_GHz, high_GHz), confidence, material.source},
         Json{{"name", material.name},
              {"model", name_of(material.model)},
              {"frequency_range_GHz", {low_GHz, high_GHz}},
              {"confidence", confidence},
              {"source", material.source},
              {"note", material.note}}
             .dump()});
  }
  return listing;
}

Listing listed_effects() {
  Listing listing{
      {"in", "what it is, and its source"},
      {},
      "fanbeam plan SCENE tells which a scene calls for; --effects +NAME,-NAME overrules "
      "it. Effects in samples are those of fanbeam fmcw."};
  for (const renderer::Touches touched :
       {renderer::Touches::pictures, renderer::Touches::samples}) {
    const char* where = touched == renderer::Touches::pictures ? "pictures" : "samples";
    for (const renderer::Effect& effect : renderer::effect_catalogue(touched))
      listing.things.push_back({std::string(effect.name()),
                                {where, fmt::format("{} ({})", effect.what, effect.source)},
                                Json{{"name", effect.name()},
                                     {"what", effect.what},
                                     {"source", effect.source},
                                     {"touches", where}}
                                    .dump()});
  }
  return listing;
}

Listing listed_products(std::span<const CommandProducts> all) {
  Listing listing{
      {"command", "files of frame 0", "what it is"},
      {},
      "fanbeam render --products NAME,NAME makes them, below the output folder; so does "
      "fanbeam fmcw with its own."};
  for (const CommandProducts& made : all)
    for (const Product& product : made.products)
      listing.things.push_back(
          {std::string(product.name),
           {made.command, std::string(product.files), std::string(product.what)},
           Json{{"name", product.name},
                {"command", made.command},
                {"what", product.what},
                {"files", product.files}}
               .dump()});
  return listing;
}

}  // namespace fanbeam::session
