#include "session/signal/detection_readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/constants.h"
#include "core/json_node.h"
#include "core/text.h"
#include "core/units.h"
#include "scenes/line_reader.h"
#include "signal/detection/clusters.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;
using core::JsonNode;

constexpr std::uint64_t kLargestFile_bytes = 256ULL << 20U;
constexpr core::JsonLimits kJsonLimits{16, 20'000'000};
constexpr core::NumberRange kTimes_s{-1e10, 1e10};
constexpr core::NumberRange kRanges_m{0.0, 1e6, true};
constexpr core::NumberRange kSpeeds_mps{-1e5, 1e5};
constexpr core::NumberRange kTurn_rad{-core::kPi, core::kPi};
constexpr core::NumberRange kRise_rad{-0.5 * core::kPi, 0.5 * core::kPi};
constexpr core::NumberRange kRatios_dB{-300.0, 300.0};
constexpr core::NumberRange kPowers_W{0.0, 1e12};
constexpr core::NumberRange kClusters{-1.0, 1e9};

// What a table may say of a detection, and in which column it does.
struct Column {
  const char* name;
  core::NumberRange range;
  bool needed;
};
constexpr std::array<Column, 8> kColumns = {{{"time_s", kTimes_s, true},
                                             {"range_m", kRanges_m, true},
                                             {"radial_speed_mps", kSpeeds_mps, true},
                                             {"azimuth_deg", {-180.0, 180.0}, true},
                                             {"power_W", kPowers_W, false},
                                             {"snr_dB", kRatios_dB, false},
                                             {"cluster", kClusters, false},
                                             {"elevation_deg", {-90.0, 90.0}, false}}};
enum { kTime, kRange, kSpeed, kAzimuth, kPower, kRatio, kCluster, kElevation };

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t comma = std::min(line.find(',', from), line.size());
    cells.push_back(core::trimmed(line.substr(from, comma - from)));
    from = comma + 1;
  }
  return cells;
}

void add(DetectedFrame& frame, const std::array<double, kColumns.size()>& values) {
  signal::RadarDetection detection;
  detection.range_m = values[kRange];
  detection.radial_speed_mps = values[kSpeed];
  detection.azimuth_rad = core::radians(values[kAzimuth]);
  detection.elevation_rad = core::radians(values[kElevation]);
  detection.power_W = values[kPower];
  detection.snr = std::pow(10.0, 0.1 * values[kRatio]);
  frame.detections.push_back(detection);
  frame.clusters.push_back(static_cast<int>(values[kCluster]));
}

class Table {
 public:
  Table(const fs::path& path, core::ProblemList& problems)
      : problems_(problems), lines_(path, problems) {}

  std::vector<DetectedFrame> read() {
    std::string_view line;
    if (!lines_.next(line)) return {};
    if (!read_names(line)) return {};
    while (lines_.next(line) && problems_.all().size() < kMostDetectionProblems) read_row(line);
    return std::move(frames_);
  }

 private:
  bool read_names(std::string_view line) {
    const auto names = cells_of(line);
    width_ = names.size();
    bool good = true;
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (std::count(names.begin(), names.end(), kColumns[i].name) > 1) {
        problems_.error(ErrorClass::parse, lines_.place(), kColumns[i].name, "twice", "one column");
        good = false;
      }
      const auto found = std::find(names.begin(), names.end(), kColumns[i].name);
      place_[i] = found == names.end() ? width_ : static_cast<std::size_t>(found - names.begin());
      if (found != names.end() || !kColumns[i].needed) continue;
      problems_.error(ErrorClass::ref, lines_.place(), kColumns[i].name, "missing",
                      "columns time_s, range_m, radial_speed_mps and azimuth_deg");
      good = false;
    }
    return good;
  }

  void read_row(std::string_view line) {
    const auto cells = cells_of(line);
    if (cells.size() != width_) {
      problems_.error(ErrorClass::parse, lines_.place(), "row",
                      std::to_string(cells.size()) + " cells",
                      std::to_string(width_) + ", as the first line has");
      return;
    }
    std::array<double, kColumns.size()> values{};
    values[kCluster] = signal::kNoCluster;
    values[kRatio] = kRatios_dB.high;  // not told: the errors stand alone
    bool good = true, timed = true;
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (place_[i] >= width_ || take(cells[place_[i]], kColumns[i], values[i])) continue;
      good = false;
      timed = timed && i != kTime;
    }
    if (timed && !follows(values[kTime])) good = false;
    if (good) put(values);
  }

  // Of each row with a time, whatever else is wrong with it or with those before.
  bool follows(double time_s) {
    if (time_s < newest_s_) {
      problems_.error(ErrorClass::time, lines_.place(), "time_s", core::number_text(time_s),
                      "times that do not go back");
      return false;
    }
    newest_s_ = time_s;
    return true;
  }

  bool take(std::string_view text, const Column& column, double& value) {
    if (text.empty() && !column.needed) return true;
    const core::ParsedNumber number = core::parse_number(text);
    const bool whole = &column != &kColumns[kCluster] || number.value == std::floor(number.value);
    if (number.error == core::NumberError::none && column.range.holds(number.value) && whole) {
      value = number.value;
      return true;
    }
    problems_.error(number.error == core::NumberError::not_a_number ? ErrorClass::parse
                    : number.error == core::NumberError::nonfinite  ? ErrorClass::nonfinite
                                                                    : ErrorClass::range,
                    lines_.place(), column.name, core::printable_text(text.substr(0, 40)),
                    to_string(column.range) + (whole ? "" : ", a whole number"));
    return false;
  }

  void put(const std::array<double, kColumns.size()>& values) {
    if (frames_.empty() || values[kTime] > frames_.back().time_s) {
      if (frames_.size() == kMostDetectedFrames) return too_many("frames", kMostDetectedFrames);
      frames_.push_back({values[kTime], {}, {}, {}});
    }
    if (frames_.back().detections.size() == kMostDetections)
      return too_many("detections in a frame", kMostDetections);
    add(frames_.back(), values);
  }

  void too_many(const char* what, std::size_t most) {
    if (!told_) refuse_too_many(what, most, lines_.place(), problems_);
    told_ = true;
  }

  core::ProblemList& problems_;
  scenes::LineReader lines_;
  std::array<std::size_t, kColumns.size()> place_{};
  std::size_t width_ = 0;
  std::vector<DetectedFrame> frames_;
  double newest_s_ = kTimes_s.low;
  bool told_ = false;
};

// Those that this program writes; of some it makes nothing.
const std::vector<const char*> kFrameMembers = {"frame", "time_s", "radar_speed_mps",
                                                "radar_velocity_mps", "detections"};
const std::vector<const char*> kDetectionMembers = {
    "range_m", "radial_speed_mps", "azimuth_rad", "elevation_rad", "power_W",
    "snr_dB",  "forward_m",        "right_m",     "cluster"};

DetectedFrame frame_in(const JsonNode& node) {
  check_keys(node, kFrameMembers);
  DetectedFrame frame;
  frame.time_s = node.required("time_s").number(kTimes_s).value_or(0.0);
  frame.radar_velocity_mps = radar_velocity_in(node);
  const JsonNode list = node.required("detections");
  const std::size_t count = list.size(kMostDetections);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode one = list.element(i);
    check_keys(one, kDetectionMembers);
    std::array<double, kColumns.size()> values{};
    values[kRange] = one.required("range_m").number(kRanges_m).value_or(1.0);
    values[kSpeed] = one.required("radial_speed_mps").number(kSpeeds_mps).value_or(0.0);
    values[kAzimuth] = core::degrees(one.required("azimuth_rad").number(kTurn_rad).value_or(0.0));
    values[kElevation] = core::degrees(one.member("elevation_rad").number(kRise_rad).value_or(0.0));
    values[kPower] = one.member("power_W").number(kPowers_W).value_or(0.0);
    values[kRatio] = one.member("snr_dB").number(kRatios_dB).value_or(kRatios_dB.high);
    values[kCluster] = one.member("cluster").whole(-1, 1'000'000'000).value_or(signal::kNoCluster);
    add(frame, values);
  }
  return frame;
}

}  // namespace

void refuse_too_many(const char* what, std::size_t most, const core::Place& place,
                     core::ProblemList& problems) {
  problems.error(ErrorClass::limit, place, what, "more than " + std::to_string(most),
                 "at most " + std::to_string(most));
}

std::vector<DetectedFrame> read_detection_table(const fs::path& file, core::ProblemList& problems) {
  return Table(file, problems).read();
}

std::vector<DetectedFrame> read_detection_json(const fs::path& path, core::ProblemList& problems) {
  const auto file = core::read_json_file(path, kLargestFile_bytes, kJsonLimits, problems);
  if (!file) return {};
  const JsonNode root(*file, problems);
  const JsonNode list = root.member("frames");
  if (!list.present()) return {frame_in(root)};
  check_keys(root, {"frames"});
  std::vector<DetectedFrame> frames;
  const std::size_t count = list.size(kMostDetectedFrames);
  for (std::size_t i = 0; i < count; ++i) frames.push_back(frame_in(list.element(i)));
  return frames;
}

}  // namespace fanbeam::session
