#include "atmosphere/loss_text.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace fanbeam::atmosphere {

std::string loss_csv(const std::vector<AtmosphereTable>& tables) {
  std::string text =
      "frequency_GHz,range_m,gas_dB,oxygen_dB,vapour_dB,fog_dB,rain_dB,snow_dB,one_way_dB,"
      "two_way_dB,eta_m2_per_m3,equivalent_sigma0_dB\n";
  for (const AtmosphereTable& table : tables)
    for (const AtmosphereRow& row : table.rows)
      text += fmt::format(
          "{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n",
          table.frequency_Hz / 1e9, row.range_m, row.gas_dB(), row.oxygen_dB, row.vapour_dB,
          row.fog_dB, row.rain_dB, row.snow_dB, row.one_way_dB(), row.two_way_dB(),
          row.eta_m2_per_m3,
          std::isfinite(row.equivalent_sigma0_dB) ? fmt::format("{:.4f}", row.equivalent_sigma0_dB)
                                                  : "");
  return text;
}

std::string loss_json(const std::vector<AtmosphereTable>& tables,
                      const std::vector<AtmosphereModel>& models) {
  nlohmann::ordered_json json;
  for (const AtmosphereModel& model : models)
    json["models"].push_back(
        {{"cause", model.cause}, {"model", model.model}, {"source", model.source}});
  for (const AtmosphereTable& table : tables) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const AtmosphereRow& row : table.rows) {
      nlohmann::ordered_json entry = {
          {"range_m", row.range_m},         {"gas_dB", row.gas_dB()},
          {"oxygen_dB", row.oxygen_dB},     {"vapour_dB", row.vapour_dB},
          {"fog_dB", row.fog_dB},           {"rain_dB", row.rain_dB},
          {"snow_dB", row.snow_dB},         {"one_way_dB", row.one_way_dB()},
          {"two_way_dB", row.two_way_dB()}, {"eta_m2_per_m3", row.eta_m2_per_m3}};
      if (std::isfinite(row.equivalent_sigma0_dB))
        entry["equivalent_sigma0_dB"] = row.equivalent_sigma0_dB;
      rows.push_back(entry);
    }
    nlohmann::ordered_json entry = {{"frequency_GHz", table.frequency_Hz / 1e9}};
    if (table.rain) entry["rain"] = {{"k", table.rain->k}, {"alpha", table.rain->alpha}};
    entry["rows"] = rows;
    json["frequencies"].push_back(entry);
  }
  return json.dump(2) + "\n";
}

}  // namespace fanbeam::atmosphere
