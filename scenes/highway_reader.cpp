#include "scenes/highway_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/constants.h"
#include "core/decibel.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/json_node.h"
#include "core/spelling.h"
#include "core/text.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using core::JsonNode;

constexpr std::uint64_t kLargestFile_bytes = 64ULL << 20;
constexpr core::JsonLimits kLimits{64, 1'000'000};
constexpr double kShortest_s = 1e-9;  // of a segment: rates of change stay finite
// Of lengths, speeds and times without a range of their own.
constexpr double kMost = 1e12;
constexpr std::size_t kMostEntries = 1000;

// What reading goes on with after a problem was told: a value in the range.
double number(const JsonNode& owner, const char* key, double low = -kMost, double high = kMost) {
  return owner.required(key).number({low, high}).value_or(low);
}

std::string text(const JsonNode& owner, const char* key) {
  return owner.required(key).text().value_or("");
}

// Refuses a member's value for a reason that only the caller can see.
void refuse(const JsonNode& owner, const char* key, ErrorClass kind, const std::string& value,
            const std::string& expected) {
  owner.problems().error(kind, owner.place(), owner.pointer() + "/" + key, value, expected);
}

// [x, y] with y to the left, to (forward, right).
std::array<double, 2> forward_right(const JsonNode& owner, const char* key) {
  const JsonNode node = owner.required(key);
  const std::vector<double> pair = node.numbers({-kMost, kMost}, kMostEntries);
  if (node.is_array() && node.elements() != 2 && node.elements() <= kMostEntries)
    refuse(owner, key, ErrorClass::parse, std::to_string(node.elements()) + " entries",
           "two numbers");
  return pair.size() == 2 ? std::array{pair[0], -pair[1]} : std::array<double, 2>{};
}

// The names that a list gives are used once each.
void check_unique(const JsonNode& node, const std::string& id, std::set<std::string>& used) {
  if (!used.insert(id).second) refuse(node, "id", ErrorClass::ref, id, "a name used once");
}

// All of it, or of `base` what it says otherwise.
core::HighwayRadar radar_of(const JsonNode& radar, const core::HighwayRadar* base) {
  check_keys(radar, {"center_frequency_hz", "sweep_bandwidth_hz", "tx_power_w", "tx_gain_db",
                     "rx_gain_db", "noise_figure_db", "system_loss_db", "max_range_m",
                     "virtual_ula_elements", "virtual_ula_spacing_wavelengths", "frame_period_s",
                     "reference_temperature_k", "propagation_speed_mps"});
  core::HighwayRadar result = base != nullptr ? *base : core::HighwayRadar{};
  const auto member = [&](const char* key) {
    return base != nullptr ? radar.member(key) : radar.required(key);
  };
  const auto take = [&](const char* key, double low, double high, double& value) {
    if (const auto number = member(key).number({low, high})) value = *number;
  };
  const auto ratio = [&](const char* key, double least_dB, double& value) {
    if (const auto dB = member(key).number({least_dB, 200.0})) value = core::power_from_dB(*dB);
  };
  take("center_frequency_hz", 1e6, 1e13, result.centre_frequency_Hz);
  take("sweep_bandwidth_hz", 1.0, 1e13, result.bandwidth_Hz);
  if (result.bandwidth_Hz >= result.centre_frequency_Hz)
    refuse(radar, "sweep_bandwidth_hz", ErrorClass::range, core::number_text(result.bandwidth_Hz),
           "below the centre frequency");
  take("tx_power_w", 1e-12, 1e12, result.transmitted_W);
  ratio("tx_gain_db", -200.0, result.transmit_gain);
  ratio("rx_gain_db", -200.0, result.receive_gain);
  ratio("noise_figure_db", 0.0, result.noise_figure);
  ratio("system_loss_db", 0.0, result.loss);
  take("max_range_m", 1e-3, 1e9, result.most_range_m);
  if (const auto count = member("virtual_ula_elements").whole(1, 1'000'000))
    result.array_elements = *count;
  take("virtual_ula_spacing_wavelengths", 1e-6, 1e6, result.array_pitch_wavelengths);
  take("frame_period_s", 1e-9, 1e6, result.frame_s);
  // Nothing can be made of others: noise figures refer to 290 K, and light is as fast as it is.
  const auto fixed = [&](const char* key, double value) {
    if (const auto told = radar.member(key).number({-kMost, kMost}); told && *told != value)
      refuse(radar, key, ErrorClass::unsupported, core::number_text(*told),
             core::number_text(value));
  };
  fixed("reference_temperature_k", 290.0);
  fixed("propagation_speed_mps", core::kSpeedOfLight_mps);
  return result;
}

void read_segment(const JsonNode& segment, core::HighwayTarget& result) {
  const std::string type = text(segment, "type");
  std::vector<const char*> known = {"type", "t0_s", "t1_s"};
  if (type != "lane-change") known.push_back("acceleration_mps2");
  if (type != "acceleration") known.push_back("lateral_m");
  check_keys(segment, known);
  const double start_s = number(segment, "t0_s"), end_s = number(segment, "t1_s");
  if (!(end_s - start_s >= kShortest_s))
    refuse(segment, "t1_s", ErrorClass::range, core::number_text(end_s),
           "at least " + core::number_text(kShortest_s) + " s after t0_s");
  if (type == "acceleration")
    result.accelerations.push_back({start_s, end_s, forward_right(segment, "acceleration_mps2")});
  else if (type == "lane-change")
    result.lane_changes.push_back({start_s, end_s, -number(segment, "lateral_m")});
  else if (!type.empty())
    refuse(segment, "type", ErrorClass::unsupported, type, "\"acceleration\" or \"lane-change\"");
}

// It stands in a table's cell.
void check_target_id(const JsonNode& owner, const std::string& name) {
  const bool fits = std::all_of(name.begin(), name.end(), [](char one) {
    return one != ',' && one != '"' && static_cast<unsigned char>(one) >= 0x20;
  });
  if (!fits || name.empty())
    refuse(owner, "id", ErrorClass::range, '"' + core::printable_text(name.substr(0, 60)) + '"',
           "a name without commas, quotes and control characters");
}

core::HighwayTarget target_of(const JsonNode& target) {
  const std::string motion = text(target, "motion");
  std::vector<const char*> known = {"id", "kind", "rcs_m2", "swerling", "clutter", "motion"};
  if (motion != "piecewise-acceleration")
    known.insert(known.end(), {"radius_m", "azimuth0_rad", "angular_rate_rad_s"});
  if (motion != "circular") known.insert(known.end(), {"position_m", "velocity_mps", "segments"});
  check_keys(target, known);
  core::HighwayTarget result;
  if (const auto id = target.required("id").text()) check_target_id(target, result.id = *id);
  result.kind = text(target, "kind");
  result.cross_section_m2 = number(target, "rcs_m2", 0.0, 1e12);
  result.fluctuation =
      static_cast<core::Swerling>(target.required("swerling").whole(0, 4).value_or(0));
  result.clutter = target.member("clutter").flag().value_or(false);
  if (motion == "circular") {
    result.motion = core::HighwayMotion::circular;
    result.radius_m = number(target, "radius_m", 1e-3, 1e9);
    result.azimuth_rad = -number(target, "azimuth0_rad", -7.0, 7.0);
    result.angular_rate_rad_per_s = -number(target, "angular_rate_rad_s", -1e6, 1e6);
  } else if (motion == "piecewise-acceleration") {
    result.position_m = forward_right(target, "position_m");
    result.velocity_mps = forward_right(target, "velocity_mps");
    const JsonNode segments = target.required("segments");
    const std::size_t count = segments.size(kMostEntries);
    for (std::size_t i = 0; i < count; ++i) read_segment(segments.element(i), result);
  } else if (!motion.empty()) {
    refuse(target, "motion", ErrorClass::unsupported, motion,
           "\"piecewise-acceleration\" or \"circular\"");
  }
  return result;
}

std::vector<core::HighwayTruth> truth_of(const JsonNode& table) {
  check_keys(table, {"id", "rows", "in_view", "columns", "snr_2ms_ramp_db_at_start",
                     "snr_2ms_ramp_db_worst"});
  const JsonNode rows = table.required("rows"), in_view = table.required("in_view");
  const std::size_t count = rows.size(kMostEntries), seen_count = in_view.size(kMostEntries);
  if (count != seen_count)
    refuse(table, "in_view", ErrorClass::parse, std::to_string(seen_count) + " entries",
           "one entry for each row");
  std::vector<core::HighwayTruth> result;
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode row = rows.element(i);
    const std::vector<double> values = row.numbers({-kMost, kMost}, kMostEntries);
    if (values.size() != 4) {
      row.error(ErrorClass::parse, "four numbers");
      continue;
    }
    const bool told = i < seen_count;
    if (told && !in_view.element(i).present())
      in_view.element(i).error(ErrorClass::parse, "true or false");
    const bool seen = told && in_view.element(i).flag().value_or(false);
    result.push_back({values[0], values[1], values[2], -values[3], seen});
  }
  return result;
}

// The place of the target with the id that `node` gives; told where there is none.
std::optional<std::size_t> target_named(const JsonNode& node,
                                        const core::HighwayScenario& scenario) {
  const std::string id = text(node, "id");
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < scenario.targets.size(); ++i) {
    if (scenario.targets[i].id == id) return i;
    ids.push_back(scenario.targets[i].id);
  }
  if (!node.problems().is_full())
    refuse(node, "id", ErrorClass::ref, id, "the id of a target" + core::names_there_text(id, ids));
  return std::nullopt;
}

std::string words_of(double range_m, double range_rate_mps, double azimuth_rad) {
  return core::number_text(range_m) + " m, " + core::number_text(range_rate_mps) + " m/s, " +
         core::number_text(-azimuth_rad) + " rad";
}

// The first row that its target's motion contradicts: a sign or a unit that was mistaken.
void check_truth(const JsonNode& rows, const std::vector<core::HighwayTruth>& told,
                 const core::HighwayTarget& target, const core::HighwayScenario& scenario) {
  constexpr double kMost_m = 0.1, kMost_mps = 0.1, kMost_rad = 2e-3;
  for (std::size_t i = 0; i < told.size(); ++i) {
    const core::HighwayTruth moved =
        truth_at(target, scenario.radar_speed_mps, scenario.radar, told[i].time_s);
    if (std::abs(moved.range_m - told[i].range_m) <= kMost_m &&
        std::abs(moved.range_rate_mps - told[i].range_rate_mps) <= kMost_mps &&
        std::abs(std::remainder(moved.azimuth_rad - told[i].azimuth_rad, 2.0 * core::kPi)) <=
            kMost_rad)
      continue;
    const JsonNode row = rows.element(i);
    row.problems().error(ErrorClass::range, row.place(), row.pointer(),
                         words_of(told[i].range_m, told[i].range_rate_mps, told[i].azimuth_rad),
                         "what the target's motion makes, " +
                             words_of(moved.range_m, moved.range_rate_mps, moved.azimuth_rad) +
                             ", within 0.1 m, 0.1 m/s and 2 mrad");
    return;
  }
}

// `sound`: of each target, that nothing was wrong with its motion, so that it can judge truth.
void read_truth(const JsonNode& tables, core::HighwayScenario& result,
                const std::vector<bool>& sound) {
  std::set<std::size_t> told;
  const std::size_t count = tables.size(kMostEntries);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode table = tables.element(i);
    const std::optional<std::size_t> owner = target_named(table, result);
    if (!owner) continue;
    if (!told.insert(*owner).second) {
      refuse(table, "id", ErrorClass::ref, result.targets[*owner].id, "one table for each target");
      continue;
    }
    std::vector<core::HighwayTruth>& rows = result.truth[*owner];
    rows = truth_of(table);
    // Rows that are no rows are told already.
    const JsonNode list = table.member("rows");
    if (sound[*owner] && rows.size() == list.elements())
      check_truth(list, rows, result.targets[*owner], result);
  }
}

void read_suppressed(const JsonNode& list, core::HighwayScenario& result) {
  const std::size_t count = list.size(kMostEntries);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode one = list.element(i);
    check_keys(one, {"id", "from_s", "to_s"});
    const double from_s = number(one, "from_s"), to_s = number(one, "to_s");
    if (!(to_s > from_s))
      refuse(one, "to_s", ErrorClass::range, core::number_text(to_s), "after from_s");
    if (const std::optional<std::size_t> target = target_named(one, result))
      result.targets[*target].suppressed.push_back({from_s, to_s});
  }
}

// A waveform of the file: of its timing what its type has.
struct NamedWaveform {
  std::string type;
  core::HighwayWaveforms timing;
};
using Waveforms = std::map<std::string, NamedWaveform>;

void take(const NamedWaveform& from, core::HighwayWaveforms& to) {
  const core::HighwayWaveforms& told = from.timing;
  if (from.type == "triangle") {
    to.triangle_ramp_s = told.triangle_ramp_s;
    to.triangle_rate_Hz = told.triangle_rate_Hz;
  }
  if (from.type == "triangle-pair") to.two_slopes_ramp_s = told.two_slopes_ramp_s;
  if (from.type == "two-stage") {
    to.coarse_chirps = told.coarse_chirps;
    to.coarse_chirp_s = told.coarse_chirp_s;
    to.coarse_rate_Hz = told.coarse_rate_Hz;
    to.fine_ramp_s = told.fine_ramp_s;
    to.fine_rate_Hz = told.fine_rate_Hz;
  }
  if (from.type == "up-flat-down") {
    to.coded_ramp_s = told.coded_ramp_s;
    to.flat_s = told.flat_s;
    to.hop_Hz = told.hop_Hz;
  }
}

double time_of(const JsonNode& owner, const char* key, double fallback_s) {
  return owner.member(key).number({1e-9, 10.0}).value_or(fallback_s);
}

double rate_of(const JsonNode& owner, double fallback_Hz) {
  return owner.member("sample_rate_hz").number({1.0, 1e12}).value_or(fallback_Hz);
}

void read_two_stages(const JsonNode& node, core::HighwayWaveforms& result) {
  const JsonNode coarse = node.required("coarse"), fine = node.required("fine");
  check_keys(coarse, {"chirps", "chirp_s", "sample_rate_hz"});
  check_keys(fine, {"ramp_s", "sample_rate_hz"});
  result.coarse_chirps = coarse.member("chirps").whole(2, 65536).value_or(result.coarse_chirps);
  result.coarse_chirp_s = time_of(coarse, "chirp_s", result.coarse_chirp_s);
  result.coarse_rate_Hz = rate_of(coarse, result.coarse_rate_Hz);
  result.fine_ramp_s = time_of(fine, "ramp_s", result.fine_ramp_s);
  result.fine_rate_Hz = rate_of(fine, result.fine_rate_Hz);
}

// Of the rates beside the two stages' own, that of a triangle counts: a study makes samples of it. Buffers are for people.
void read_waveform(const JsonNode& node, NamedWaveform& named) {
  core::HighwayWaveforms& result = named.timing;
  const std::string type = named.type = text(node, "type");
  std::vector<const char*> known = {"type", "complex_baseband"};
  if (type == "two-stage")
    known.insert(known.end(), {"coarse", "fine"});
  else
    known.insert(known.end(), {"ramp_s", "sample_rate_hz", "ramps_per_buffer"});
  if (type == "up-flat-down") known.insert(known.end(), {"flat_s", "flat_code", "flat_step_hz"});
  check_keys(node, known);
  if (node.member("complex_baseband").flag() == false)
    refuse(node, "complex_baseband", ErrorClass::unsupported, "false", "complex samples");
  node.member("ramps_per_buffer").whole(1, 1'000'000);
  result.triangle_rate_Hz = rate_of(node, result.triangle_rate_Hz);
  if (type == "triangle") {
    result.triangle_ramp_s = time_of(node, "ramp_s", result.triangle_ramp_s);
  } else if (type == "triangle-pair") {
    const std::vector<double> ramps = node.required("ramp_s").numbers({1e-9, 10.0}, 2);
    if (ramps.size() != 2)
      refuse(node, "ramp_s", ErrorClass::parse, std::to_string(ramps.size()) + " entries",
             "two numbers");
    else if (ramps[0] == ramps[1])
      refuse(node, "ramp_s", ErrorClass::range, core::number_text(ramps[1]) + " twice",
             "two times: the second slope tells which beats belong together");
    else
      result.two_slopes_ramp_s = {ramps[0], ramps[1]};
  } else if (type == "two-stage") {
    read_two_stages(node, result);
  } else if (type == "up-flat-down") {
    result.coded_ramp_s = time_of(node, "ramp_s", result.coded_ramp_s);
    result.flat_s = time_of(node, "flat_s", result.flat_s);
    result.hop_Hz = node.member("flat_step_hz").number({1.0, 1e9}).value_or(result.hop_Hz);
    if (const auto code = node.member("flat_code").text(); code && *code != "m-sequence-127")
      refuse(node, "flat_code", ErrorClass::unsupported, *code, "\"m-sequence-127\"");
  } else if (!type.empty()) {
    refuse(node, "type", ErrorClass::unsupported, type,
           "\"triangle\", \"triangle-pair\", \"two-stage\" or \"up-flat-down\"");
  }
}

// Of all its ramps, one after the other.
double length_s(const NamedWaveform& one) {
  const core::HighwayWaveforms& timing = one.timing;
  if (one.type == "triangle") return timing.triangle_s();
  if (one.type == "triangle-pair") return timing.two_slopes_s();
  if (one.type == "two-stage") return timing.two_stage_s();
  return one.type == "up-flat-down" ? timing.coded_s() : 0.0;
}

// All of the file; of each type the first name in the order of letters (members of JSON have none of their own) counts for
// every scenario that names no other.
Waveforms waveforms_of(const JsonNode& table, core::HighwayRadar& radar) {
  Waveforms named;
  std::set<std::string> types;
  if (!table.present()) return named;
  for (const std::string& name : table.keys()) {
    NamedWaveform& one = named[name];
    read_waveform(table.member(name), one);
    if (types.insert(one.type).second) take(one, radar.waveforms);
  }
  return named;
}

// The first that a scenario names of a type replaces the file's, and has to end within this scenario's frames.
void choose_waveforms(const JsonNode& names, const Waveforms& named,
                      core::HighwayScenario& scenario) {
  if (!names.present()) return;
  std::vector<std::string> known;
  for (const auto& [name, waveform] : named) known.push_back(name);
  const std::size_t count = names.size(kMostEntries);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = names.element(i).text().value_or("");
    const auto found = named.find(name);
    if (found == named.end()) {
      if (names.problems().is_full()) return;
      names.element(i).error(ErrorClass::ref,
                             "the name of one of /waveforms" + core::names_there_text(name, known));
      continue;
    }
    std::vector<std::string>& types = scenario.waveform_types;
    if (std::find(types.begin(), types.end(), found->second.type) != types.end()) continue;
    types.push_back(found->second.type);
    take(found->second, scenario.radar.waveforms);
    const double frame_s = scenario.radar.frame_s;
    if (const double ramps_s = length_s(found->second); ramps_s > frame_s)
      refuse(names, std::to_string(i).c_str(), ErrorClass::range,
             name + " with " + core::number_text(ramps_s) + " s of ramps",
             "no more than the frame period of " + core::number_text(frame_s) + " s");
  }
}

core::HighwayScenario scenario_of(const JsonNode& scenario, const core::HighwayRadar& radar,
                                  const Waveforms& waveforms) {
  check_keys(scenario, {"id", "title", "duration_s", "ego_speed_mps", "targets", "truth",
                        "radar_overrides", "suppressed_detections", "purpose", "waveforms",
                        "events", "acceptance", "seeds", "sweeps", "triangle_intersections_max"});
  core::HighwayScenario result;
  result.id = text(scenario, "id");
  result.title = text(scenario, "title");
  result.duration_s = number(scenario, "duration_s", 1e-6, 1e6);
  const auto problems = [&] { return scenario.problems().all().size(); };
  std::size_t before = problems();
  result.radar_speed_mps = number(scenario, "ego_speed_mps", -1e4, 1e4);
  const bool speed_sound = problems() == before;
  result.radar = radar;
  if (const JsonNode other = scenario.member("radar_overrides"); other.present())
    result.radar = radar_of(other, &radar);
  choose_waveforms(scenario.member("waveforms"), waveforms, result);
  std::set<std::string> names;
  const JsonNode targets = scenario.required("targets");
  const std::size_t count = targets.size(kMostEntries);
  std::vector<bool> sound;
  for (std::size_t i = 0; i < count; ++i) {
    before = problems();
    result.targets.push_back(target_of(targets.element(i)));
    sound.push_back(speed_sound && problems() == before);
    check_unique(targets.element(i), result.targets.back().id, names);
  }
  result.truth.resize(result.targets.size());
  read_truth(scenario.member("truth"), result, sound);
  read_suppressed(scenario.member("suppressed_detections"), result);
  return result;
}

HighwayFile file_of(const JsonNode& root) {
  const auto format = root.required("format").text();
  const auto version = root.required("version").number({-kMost, kMost});
  if (format && version && (*format != "highway-scenarios" || *version != 1.0))
    refuse(root, "format", ErrorClass::unsupported, *format + " " + core::number_text(*version),
           "\"highway-scenarios\", version 1");
  root.problems().throw_if_errors();
  check_keys(root, {"format", "version", "radar", "scenarios", "conventions", "waveforms",
                    "lane_centres_note"});
  HighwayFile result;
  const JsonNode radar = root.required("radar");
  if (radar.present()) result.radar = radar_of(radar, nullptr);
  const Waveforms waveforms = waveforms_of(root.member("waveforms"), result.radar);
  const JsonNode scenarios = root.required("scenarios");
  std::set<std::string> names;
  const std::size_t count = scenarios.size(kMostEntries);
  if (scenarios.is_array() && scenarios.elements() == 0)
    scenarios.error(ErrorClass::range, "one scenario at least");
  for (std::size_t i = 0; i < count; ++i) {
    result.scenarios.push_back(scenario_of(scenarios.element(i), result.radar, waveforms));
    check_unique(scenarios.element(i), result.scenarios.back().id, names);
  }
  return result;
}

}  // namespace

HighwayFile parse_highway(const std::string& text, const std::string& name) {
  core::ProblemList problems;
  const auto json = core::parse_json(text, name, kLimits, problems);
  problems.throw_if_errors();
  HighwayFile result = file_of(JsonNode(*json, problems));
  result.name = name;
  problems.throw_if_errors();
  return result;
}

HighwayFile read_highway_file(const std::filesystem::path& file) {
  return parse_highway(core::read_file(file, kLargestFile_bytes), file.string());
}

}  // namespace fanbeam::scenes
