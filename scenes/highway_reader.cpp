#include "scenes/highway_reader.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/decibel.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/json_size.h"
#include "core/spelling.h"
#include "scenes/json_reader_private.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using nlohmann::json;

constexpr std::uint64_t kLargestFile_bytes = 64ULL << 20;
constexpr core::JsonLimits kLimits{64, 1'000'000};
constexpr double kShortest_s = 1e-9;  // of a segment: rates of change stay finite

core::HighwayRadar radar_of(JsonReader& reader, const json& radar) {
  const std::string path = "radar";
  const auto ratio = [&](const char* key, double least_dB) {
    return core::power_from_dB(reader.number(radar, path, key, least_dB, 200.0));
  };
  core::HighwayRadar result;
  result.centre_frequency_Hz = reader.number(radar, path, "center_frequency_hz", 1e6, 1e13);
  result.bandwidth_Hz = reader.number(radar, path, "sweep_bandwidth_hz", 1.0, 1e13);
  if (result.bandwidth_Hz >= result.centre_frequency_Hz)
    reader.error(ErrorClass::range, "radar.sweep_bandwidth_hz",
                 core::number_text(result.bandwidth_Hz), "below the centre frequency");
  result.transmitted_W = reader.number(radar, path, "tx_power_w", 1e-12, 1e12);
  result.transmit_gain = ratio("tx_gain_db", -200.0);
  result.receive_gain = ratio("rx_gain_db", -200.0);
  result.noise_figure = ratio("noise_figure_db", 0.0);
  result.loss = ratio("system_loss_db", 0.0);
  result.most_range_m = reader.number(radar, path, "max_range_m", 1e-3, 1e9);
  result.array_elements = reader.whole(radar, path, "virtual_ula_elements", 1, 1'000'000);
  result.array_pitch_wavelengths =
      reader.number(radar, path, "virtual_ula_spacing_wavelengths", 1e-6, 1e6);
  result.frame_s = reader.number(radar, path, "frame_period_s", 1e-9, 1e6);
  return result;
}

void read_segments(JsonReader& reader, const json& target, const std::string& path,
                   core::HighwayTarget& result) {
  const json& segments = reader.list(target, path, "segments");
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const json& segment = segments[i];
    const std::string here = JsonReader::entry(path, "segments", i);
    const std::string type = reader.text(segment, here, "type");
    const double start_s = reader.number(segment, here, "t0_s");
    const double end_s = reader.number(segment, here, "t1_s");
    if (!(end_s - start_s >= kShortest_s))
      reader.error(ErrorClass::range, here + ".t1_s", core::number_text(end_s),
                   "at least " + core::number_text(kShortest_s) + " s after t0_s");
    if (type == "acceleration")
      result.accelerations.push_back(
          {start_s, end_s, reader.forward_right(segment, here, "acceleration_mps2")});
    else if (type == "lane-change")
      result.lane_changes.push_back({start_s, end_s, -reader.number(segment, here, "lateral_m")});
    else if (!type.empty())
      reader.error(ErrorClass::unsupported, here + ".type", type,
                   "\"acceleration\" or \"lane-change\"");
  }
}

core::HighwayTarget target_of(JsonReader& reader, const json& target, const std::string& path) {
  core::HighwayTarget result;
  result.id = reader.text(target, path, "id");
  result.kind = reader.text(target, path, "kind");
  result.cross_section_m2 = reader.number(target, path, "rcs_m2", 0.0, 1e12);
  result.fluctuation = static_cast<core::Swerling>(reader.whole(target, path, "swerling", 0, 4));
  if (target.is_object() && target.contains("clutter"))
    result.clutter = reader.flag(target["clutter"], path + ".clutter");
  const std::string motion = reader.text(target, path, "motion");
  if (motion == "circular") {
    result.motion = core::HighwayMotion::circular;
    result.radius_m = reader.number(target, path, "radius_m", 1e-3, 1e9);
    result.azimuth_rad = -reader.number(target, path, "azimuth0_rad", -7.0, 7.0);
    result.angular_rate_rad_per_s = -reader.number(target, path, "angular_rate_rad_s", -1e6, 1e6);
  } else if (motion == "piecewise-acceleration") {
    result.position_m = reader.forward_right(target, path, "position_m");
    result.velocity_mps = reader.forward_right(target, path, "velocity_mps");
    read_segments(reader, target, path, result);
  } else if (!motion.empty()) {
    reader.error(ErrorClass::unsupported, path + ".motion", motion,
                 "\"piecewise-acceleration\" or \"circular\"");
  }
  return result;
}

std::vector<core::HighwayTruth> truth_of(JsonReader& reader, const json& table,
                                         const std::string& path) {
  const json& rows = reader.list(table, path, "rows");
  const json& in_view = reader.list(table, path, "in_view");
  if (rows.size() != in_view.size())
    reader.error(ErrorClass::parse, path + ".in_view", std::to_string(in_view.size()),
                 "one entry for each row");
  std::vector<core::HighwayTruth> result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string here = JsonReader::entry(path, "rows", i);
    if (!rows[i].is_array() || rows[i].size() != 4) {
      reader.error(ErrorClass::parse, here, JsonReader::shown(rows[i]), "four numbers");
      continue;
    }
    double values[4];
    for (std::size_t k = 0; k < 4; ++k)
      values[k] = reader.number(&rows[i][k], here + "[" + std::to_string(k) + "]",
                                -JsonReader::kMost, JsonReader::kMost);
    const bool seen =
        i < in_view.size() && reader.flag(in_view[i], JsonReader::entry(path, "in_view", i));
    result.push_back({values[0], values[1], values[2], -values[3], seen});
  }
  return result;
}

void read_truth(JsonReader& reader, const json& scenario, const std::string& path,
                core::HighwayScenario& result) {
  std::set<std::string> told;
  const json& tables = reader.list(scenario, path, "truth");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string here = JsonReader::entry(path, "truth", i);
    const std::string id = reader.text(tables[i], here, "id");
    std::size_t owner = 0;
    while (owner < result.targets.size() && result.targets[owner].id != id) ++owner;
    if (owner == result.targets.size()) {
      if (reader.problems().is_full()) continue;
      std::vector<std::string> ids;
      for (const core::HighwayTarget& target : result.targets) ids.push_back(target.id);
      reader.error(ErrorClass::ref, here + ".id", id,
                   "the id of a target" + core::names_there_text(id, ids));
    } else if (!told.insert(id).second) {
      reader.error(ErrorClass::ref, here + ".id", id, "one table for each target");
    } else {
      result.truth[owner] = truth_of(reader, tables[i], here);
    }
  }
}

core::HighwayScenario scenario_of(JsonReader& reader, const json& scenario,
                                  const std::string& path) {
  core::HighwayScenario result;
  result.id = reader.text(scenario, path, "id");
  result.title = reader.text(scenario, path, "title");
  result.duration_s = reader.number(scenario, path, "duration_s", 1e-6, 1e6);
  result.radar_speed_mps = reader.number(scenario, path, "ego_speed_mps", -1e4, 1e4);
  std::set<std::string> names;
  const json& targets = reader.list(scenario, path, "targets");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const std::string here = JsonReader::entry(path, "targets", i);
    result.targets.push_back(target_of(reader, targets[i], here));
    if (!names.insert(result.targets.back().id).second)
      reader.error(ErrorClass::ref, here + ".id", result.targets.back().id, "a name used once");
  }
  result.truth.resize(result.targets.size());
  if (scenario.is_object() && scenario.contains("truth"))
    read_truth(reader, scenario, path, result);
  return result;
}

void check_size(JsonReader& reader, const std::string& text) {
  const auto excess = core::json_excess(text, kLimits);
  if (!excess) return;
  const bool deep = excess->of == core::JsonExcess::Of::levels;
  const std::string most =
      std::to_string(deep ? static_cast<std::size_t>(kLimits.levels) : kLimits.values);
  reader.error(ErrorClass::limit, deep ? "nesting" : "values",
               "more than " + most + " at byte " + std::to_string(excess->offset),
               "at most " + most);
  reader.problems().throw_if_errors();
}

}  // namespace

HighwayFile parse_highway(const std::string& text, const std::string& name) {
  JsonReader reader(name);
  HighwayFile result;
  check_size(reader, text);
  const json root = json::parse(text, nullptr, false);
  if (root.is_discarded()) reader.error(ErrorClass::parse, "file", "no JSON", "valid JSON");
  reader.problems().throw_if_errors();
  const std::string format = reader.text(root, "", "format");
  const double version = reader.number(root, "", "version");
  if (format != "highway-scenarios" || version != 1.0)
    reader.error(ErrorClass::unsupported, "format", format + " " + core::number_text(version),
                 "\"highway-scenarios\", version 1");
  reader.problems().throw_if_errors();
  if (const json* radar = reader.member(root, "", "radar"); radar != nullptr)
    result.radar = radar_of(reader, *radar);
  const json& scenarios = reader.list(root, "", "scenarios");
  std::set<std::string> names;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const std::string here = JsonReader::entry("", "scenarios", i);
    result.scenarios.push_back(scenario_of(reader, scenarios[i], here));
    if (const std::string& id = result.scenarios.back().id; !names.insert(id).second)
      reader.error(ErrorClass::ref, here + ".id", id, "a name used once");
  }
  reader.problems().throw_if_errors();
  return result;
}

HighwayFile read_highway_file(const std::filesystem::path& file) {
  return parse_highway(core::read_file(file, kLargestFile_bytes), file.string());
}

}  // namespace fanbeam::scenes
