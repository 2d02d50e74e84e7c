#include "materials/library/material_rows.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/units.h"

namespace fanbeam::materials {

double MaterialRow::level_dB(double grazing_deg) const {
  return 10.0 * std::log10(curve.sigma0(std::sin(core::radians(grazing_deg))));
}

std::vector<MaterialRow> rows_under(const MaterialLibrary& library, double frequency_Hz,
                                    core::Polarisation polarisation, SurfaceState state) {
  std::vector<MaterialRow> rows;
  for (std::size_t i = 0; i < library.size(); ++i) {
    const Material& shown = library[library.in_state(i, state)];
    rows.push_back({library[i], shown, NrcsCurve(shown.model, polarisation, frequency_Hz),
                    extrapolations_of(shown.model, polarisation, frequency_Hz).empty()});
  }
  return rows;
}

const char* polarisation_text(const ModelValidity& known) {
  return known.horizontal && known.vertical ? "any" : known.horizontal ? "HH" : "VV";
}

std::string row_json(const MaterialRow& row) {
  using Json = nlohmann::ordered_json;
  const ModelValidity known = validity_of(row.shown.model);
  Json json = {{"material", row.dry.name},
               {"shown_as", row.shown.name},
               {"model", name_of(row.shown.model)}};
  if (const auto* phong = std::get_if<PhongSurface>(&row.shown.model)) {
    json["a"] = phong->nrcs.a();
    json["b"] = phong->nrcs.b();
    json["c"] = phong->nrcs.c();
    json["reference_frequency_GHz"] = phong->reference_frequency_Hz / 1e9;
    json["frequency_exponent"] = phong->frequency_exponent;
  }
  json["frequency_range_GHz"] = {known.frequency_Hz.low / 1e9, known.frequency_Hz.high / 1e9};
  json["grazing_range_deg"] = {core::degrees(known.grazing_rad.low),
                               core::degrees(known.grazing_rad.high)};
  json["polarisation"] = polarisation_text(known);
  json["extrapolated"] = !row.known;
  json["sigma0_dB"] = Json::object();
  for (const double angle_deg : kListAngles_deg) {
    const double level_dB = row.level_dB(angle_deg);
    json["sigma0_dB"][core::number_text(angle_deg)] =
        std::isfinite(level_dB) ? Json(level_dB) : Json(nullptr);
  }
  if (!row.shown.dielectric.empty()) json["dielectric"] = row.shown.dielectric;
  if (row.shown.rms_height_m) json["rms_height_mm"] = *row.shown.rms_height_m * 1000.0;
  json["confidence"] = name_of(row.shown.confidence);
  json["source"] = row.shown.source;
  return json.dump();
}

}  // namespace fanbeam::materials
