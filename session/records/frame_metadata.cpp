#include "session/records/frame_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "core/effect_plan.h"
#include "core/files.h"
#include "core/text.h"
#include "core/units.h"
#include "sensors/display/grey_scale.h"
#include "session/labels/labels_json.h"
#include "session/labels/run_labels.h"
#include "session/products/frame_table.h"
#include "session/records/output_folder.h"
#include "session/version.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

std::string cscope_text(sensors::Display::CScopeMode mode) {
  using Mode = sensors::Display::CScopeMode;
  if (mode == Mode::true_elevation)
    return "true_elevation: ground truth, a fan beam cannot measure elevation";
  if (mode == Mode::flat_earth) return "flat_earth: elevation from range and height above ground";
  return "shadow: flat_earth with obstacles raised to heights estimated from their shadows";
}

std::string mapping_text(sensors::Display::Mapping mapping) {
  return std::string(sensors::Display::kMappings[static_cast<std::size_t>(mapping)]);
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t blank = std::min(text.find(' ', from), text.size());
    words.push_back(text.substr(from, blank - from));
    from = blank + 1;
  }
  return words;
}

// As frame_metadata writes it: "0.3 cscope 0.2 levels 4", and "missed" behind it or not.
std::optional<renderer::ErrorEstimate> error_of(const std::string& text) {
  const std::vector<std::string> words = words_of(text);
  if (words.size() < 5 || words[1] != "cscope" || words[3] != "levels") return std::nullopt;
  const core::ParsedNumber rms = core::parse_number(words[0]);
  const core::ParsedNumber cscope_rms = core::parse_number(words[2]);
  const core::ParsedNumber levels = core::parse_number(words[4]);
  for (const core::ParsedNumber& number : {rms, cscope_rms, levels})
    if (number.error != core::NumberError::none) return std::nullopt;
  if (!(levels.value >= 0.0 && levels.value <= 1e6)) return std::nullopt;
  renderer::ErrorEstimate error;
  error.rms_grey = rms.value;
  error.cscope_rms_grey = cscope_rms.value;
  error.levels = static_cast<int>(levels.value);
  error.reached = words.size() == 5;
  return error;
}

// Mean noise in the picture's watts, drawn or not.
double noise_W(const scenes::Scene& scene, const FrameRecord& record) {
  const bool noisy = scene.plan.runs(core::EffectId::thermal_noise) &&
                     !record.left_out.contains(core::EffectId::thermal_noise);
  return noisy ? scene.description.sensor.noise_power_W() : 0.0;
}

std::string value_of(const core::Metadata& metadata, const std::string& name) {
  for (const auto& [key, value] : metadata)
    if (key == name) return value;
  return "";
}

// False where there is no count of that name.
bool take_count(const core::Metadata& metadata, const std::string& name, std::uint64_t& count) {
  const std::string text = value_of(metadata, name);
  const char* const end = text.data() + text.size();
  const auto [behind, status] = std::from_chars(text.data(), end, count);
  return status == std::errc() && behind == end;
}

bool take_all(const core::Metadata& metadata, FrameRecord& record) {
  record.error = error_of(value_of(metadata, "fanbeam:estimated_error_grey"));
  record.events = words_of(value_of(metadata, "fanbeam:events"));
  return take_count(metadata, "fanbeam:rays", record.rays) &&
         take_count(metadata, "fanbeam:slices", record.slices) &&
         take_count(metadata, "fanbeam:blanked", record.blanked) &&
         take_count(metadata, "fanbeam:unprojected", record.unprojected);
}

// What metadata_of does not look at. JSON it has read to its end.
bool is_whole(const fs::path& file) {
  if (file.extension() == ".csv") return is_whole_table(file);
  if (file.extension() != ".json") core::read_image(file);  // throws
  return true;
}

}  // namespace

core::Metadata frame_metadata(const scenes::Scene& scene, const renderer::Sampling& sampling,
                              const FrameRecord& record, const std::string& fingerprint) {
  const sensors::Sensor& sensor = scene.description.sensor;
  const sensors::GreyScale grey(sensor);
  const core::Attitude attitude = core::attitude_from(record.pose.q_NB);
  std::string events;
  for (const std::string& event : record.events) events += (events.empty() ? "" : " ") + event;
  return {
      {"Software", "fanbeam " + version_text() + " " + commit_text()},
      {"fanbeam:scene", scene.description.name},
      {"fanbeam:sensor", sensor.name},
      {"fanbeam:input", fingerprint},
      {"fanbeam:frame", std::to_string(record.index)},
      {"fanbeam:time_s", core::number_text(record.time_s)},
      {"fanbeam:latitude_deg", core::number_text(core::degrees(record.pose.position.latitude_rad))},
      {"fanbeam:longitude_deg",
       core::number_text(core::degrees(record.pose.position.longitude_rad))},
      {"fanbeam:height_m", core::number_text(record.pose.position.height_m)},
      {"fanbeam:roll_deg", core::number_text(core::degrees(attitude.roll_rad))},
      {"fanbeam:pitch_deg", core::number_text(core::degrees(attitude.pitch_rad))},
      {"fanbeam:heading_deg", core::number_text(core::degrees(attitude.heading_rad))},
      {"fanbeam:azimuth",
       fmt::format("{} columns, {} deg", sensor.scan.columns,
                   core::number_text(core::rounded_degrees(sensor.scan.field_of_view_rad)))},
      {"fanbeam:range", fmt::format("{} m + {} x {} m", core::number_text(sensor.range.minimum_m),
                                    sensor.range.cells, core::number_text(sensor.range.cell_m))},
      {"fanbeam:display_mapping", mapping_text(sensor.display.mapping)},
      {"fanbeam:display_dB", fmt::format("{} to {}", core::number_text(grey.low_dB()),
                                         core::number_text(grey.high_dB()))},
      {"fanbeam:cscope", cscope_text(sensor.display.cscope_mode)},
      {"fanbeam:realisation", realisation_of(scene.plan)},
      {"fanbeam:noise_W", core::number_text(noise_W(scene, record))},
      {"fanbeam:caster", caster_text(sampling)},
      {"fanbeam:rays", std::to_string(record.rays)},
      {"fanbeam:slices", std::to_string(record.slices)},
      {"fanbeam:blanked", std::to_string(record.blanked)},
      {"fanbeam:unprojected", std::to_string(record.unprojected)},
      {"fanbeam:events", events},
      {"fanbeam:estimated_error_grey",
       record.error ? fmt::format("{} cscope {} levels {}{}", record.error->rms_grey,
                                  record.error->cscope_rms_grey, record.error->levels,
                                  record.error->reached ? "" : " missed")
                    : ""}};
}

core::Metadata metadata_of(const fs::path& file) {
  if (file.extension() == ".csv") return table_metadata(file);
  if (file.extension() != ".json") return core::read_metadata(file);
  return labels_metadata(core::read_file(file, kLargestLabels_bytes), file.string());
}

bool take_over(const fs::path& folder, const ProductSet& products, const std::string& fingerprint,
               FrameRecord& record) {
  if (products.contains("preview")) return false;
  for (const std::string& name : frame_files(products, record.index)) {
    const fs::path file = folder / name;
    if (!fs::is_regular_file(file)) return false;
    try {
      const core::Metadata metadata = metadata_of(file);
      if (value_of(metadata, "fanbeam:input") != fingerprint) return false;
      if (!is_whole(file) || !take_all(metadata, record)) return false;
    } catch (const core::InputError&) {
      return false;  // damaged: render it again
    }
  }
  record.resumed = true;
  return true;
}

}  // namespace fanbeam::session
