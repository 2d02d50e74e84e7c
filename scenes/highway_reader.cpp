#include "scenes/highway_reader.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/decibel.h"
#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using nlohmann::json;

constexpr std::uint64_t kLargestFile_bytes = 64ULL << 20;
constexpr int kDeepest = 64;
constexpr std::size_t kMostEntries = 1000;
constexpr double kMost = 1e12;

// Brackets outside strings, before the parser, which recurses.
int depth_of(const std::string& text) {
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{'))
      deepest = std::max(deepest, ++depth);
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
  }
  return deepest;
}

// Reads members of one object and collects what is wrong with them.
class Reader {
 public:
  explicit Reader(std::string file) { place_.file = std::move(file); }

  void error(ErrorClass kind, const std::string& path, const std::string& value,
             const std::string& expected) {
    problems_.error(kind, place_, path, value, expected);
  }
  const core::ProblemList& problems() const { return problems_; }

  const json* member(const json& owner, const std::string& path, const char* key) {
    if (!owner.is_object()) {
      error(ErrorClass::parse, path, owner.type_name(), "an object");
      return nullptr;
    }
    const auto found = owner.find(key);
    if (found != owner.end()) return &*found;
    error(ErrorClass::parse, joined(path, key), "nothing", "a value");
    return nullptr;
  }

  double number(const json* value, const std::string& path, double least, double most) {
    if (value == nullptr) return least;
    if (!value->is_number()) {
      error(ErrorClass::parse, path, value->dump().substr(0, 40), "a number");
      return least;
    }
    const double result = value->get<double>();
    if (!std::isfinite(result)) {
      error(ErrorClass::nonfinite, path, core::number_text(result), "a finite number");
      return least;
    }
    if (result < least || result > most)
      error(ErrorClass::range, path, core::number_text(result),
            core::number_text(least) + " to " + core::number_text(most));
    return result;
  }
  double number(const json& owner, const std::string& path, const char* key, double least = -kMost,
                double most = kMost) {
    return number(member(owner, path, key), joined(path, key), least, most);
  }

  std::string text(const json& owner, const std::string& path, const char* key) {
    const json* value = member(owner, path, key);
    if (value == nullptr) return {};
    if (value->is_string()) return value->get<std::string>();
    error(ErrorClass::parse, joined(path, key), value->dump().substr(0, 40), "a text");
    return {};
  }

  // Empty where there is none.
  const json& list(const json& owner, const std::string& path, const char* key) {
    static const json kEmpty = json::array();
    const json* value = member(owner, path, key);
    if (value == nullptr) return kEmpty;
    if (!value->is_array()) {
      error(ErrorClass::parse, joined(path, key), value->type_name(), "a list");
      return kEmpty;
    }
    if (value->size() <= kMostEntries) return *value;
    error(ErrorClass::limit, joined(path, key), std::to_string(value->size()),
          "at most " + std::to_string(kMostEntries) + " entries");
    return kEmpty;
  }

  // [x, y] with y to the left, to (forward, right).
  std::array<double, 2> forward_right(const json& owner, const std::string& path, const char* key) {
    const json& pair = list(owner, path, key);
    if (pair.size() != 2) {
      error(ErrorClass::parse, joined(path, key), pair.dump().substr(0, 40), "two numbers");
      return {};
    }
    return {number(&pair[0], joined(path, key) + "[0]", -kMost, kMost),
            -number(&pair[1], joined(path, key) + "[1]", -kMost, kMost)};
  }

  static std::string joined(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }
  static std::string entry(const std::string& path, const char* key, std::size_t index) {
    return joined(path, key) + "[" + std::to_string(index) + "]";
  }

 private:
  core::Place place_;
  core::ProblemList problems_;
};

core::HighwayRadar radar_of(Reader& reader, const json& radar) {
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
  result.array_elements =
      static_cast<int>(reader.number(radar, path, "virtual_ula_elements", 1.0, 1e6));
  result.array_pitch_wavelengths =
      reader.number(radar, path, "virtual_ula_spacing_wavelengths", 1e-6, 1e6);
  result.frame_s = reader.number(radar, path, "frame_period_s", 1e-9, 1e6);
  return result;
}

void read_segments(Reader& reader, const json& target, const std::string& path,
                   core::HighwayTarget& result) {
  const json& segments = reader.list(target, path, "segments");
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const json& segment = segments[i];
    const std::string here = Reader::entry(path, "segments", i);
    const std::string type = reader.text(segment, here, "type");
    const double start_s = reader.number(segment, here, "t0_s");
    const double end_s = reader.number(segment, here, "t1_s");
    if (!(end_s > start_s))
      reader.error(ErrorClass::range, here + ".t1_s", core::number_text(end_s), "after t0_s");
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

core::HighwayTarget target_of(Reader& reader, const json& target, const std::string& path) {
  core::HighwayTarget result;
  result.id = reader.text(target, path, "id");
  result.kind = reader.text(target, path, "kind");
  result.cross_section_m2 = reader.number(target, path, "rcs_m2", 0.0, 1e12);
  const double swerling = reader.number(target, path, "swerling", 0.0, 4.0);
  result.fluctuation = static_cast<core::Swerling>(static_cast<int>(swerling));
  if (swerling != std::floor(swerling))
    reader.error(ErrorClass::range, path + ".swerling", core::number_text(swerling),
                 "a whole number");
  if (target.is_object() && target.contains("clutter"))
    result.clutter = target["clutter"].is_boolean() && target["clutter"].get<bool>();
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

std::vector<core::HighwayTruth> truth_of(Reader& reader, const json& table,
                                         const std::string& path) {
  const json& rows = reader.list(table, path, "rows");
  const json& in_view = reader.list(table, path, "in_view");
  if (rows.size() != in_view.size())
    reader.error(ErrorClass::parse, path + ".in_view", std::to_string(in_view.size()),
                 "one entry for each row");
  std::vector<core::HighwayTruth> result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string here = Reader::entry(path, "rows", i);
    if (!rows[i].is_array() || rows[i].size() != 4) {
      reader.error(ErrorClass::parse, here, rows[i].dump().substr(0, 40), "four numbers");
      continue;
    }
    double values[4];
    for (std::size_t k = 0; k < 4; ++k)
      values[k] = reader.number(&rows[i][k], here + "[" + std::to_string(k) + "]", -kMost, kMost);
    const bool seen = i < in_view.size() && in_view[i].is_boolean() && in_view[i].get<bool>();
    result.push_back({values[0], values[1], values[2], -values[3], seen});
  }
  return result;
}

core::HighwayScenario scenario_of(Reader& reader, const json& scenario, const std::string& path) {
  core::HighwayScenario result;
  result.id = reader.text(scenario, path, "id");
  result.title = reader.text(scenario, path, "title");
  result.duration_s = reader.number(scenario, path, "duration_s", 1e-6, 1e6);
  result.radar_speed_mps = reader.number(scenario, path, "ego_speed_mps", -1e4, 1e4);
  std::set<std::string> names;
  const json& targets = reader.list(scenario, path, "targets");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const std::string here = Reader::entry(path, "targets", i);
    result.targets.push_back(target_of(reader, targets[i], here));
    if (!names.insert(result.targets.back().id).second)
      reader.error(ErrorClass::ref, here + ".id", result.targets.back().id, "a name used once");
  }
  result.truth.resize(result.targets.size());
  if (!scenario.is_object() || !scenario.contains("truth")) return result;
  const json& tables = reader.list(scenario, path, "truth");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string here = Reader::entry(path, "truth", i);
    const std::string id = reader.text(tables[i], here, "id");
    std::size_t owner = 0;
    while (owner < result.targets.size() && result.targets[owner].id != id) ++owner;
    if (owner == result.targets.size())
      reader.error(ErrorClass::ref, here + ".id", id, "the id of a target");
    else
      result.truth[owner] = truth_of(reader, tables[i], here);
  }
  return result;
}

}  // namespace

HighwayFile parse_highway(const std::string& text, const std::string& name) {
  Reader reader(name);
  HighwayFile result;
  if (const int depth = depth_of(text); depth > kDeepest) {
    reader.error(ErrorClass::limit, "nesting", std::to_string(depth),
                 "at most " + std::to_string(kDeepest));
    reader.problems().throw_if_errors();
  }
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
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    result.scenarios.push_back(
        scenario_of(reader, scenarios[i], Reader::entry("", "scenarios", i)));
  reader.problems().throw_if_errors();
  return result;
}

HighwayFile read_highway_file(const std::filesystem::path& file) {
  return parse_highway(core::read_file(file, kLargestFile_bytes), file.string());
}

}  // namespace fanbeam::scenes
