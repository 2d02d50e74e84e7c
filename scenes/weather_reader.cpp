#include "scenes/weather_reader.h"

#include <algorithm>
#include <initializer_list>

#include "core/units.h"
#include "scenes/object_reader.h"

namespace fanbeam::scenes {
namespace {

using core::ConfigTable;
using core::radians;

constexpr core::NumberRange kHeight_m{atmosphere::kLowestWeather_m, atmosphere::kHighestWeather_m};
constexpr core::NumberRange kVisibility_m{10, 100000};
constexpr core::NumberRange kLiquidWater_g_per_m3{0, atmosphere::kLargestLiquidWater_g_per_m3};
constexpr core::NumberRange kRainRate_mm_per_h{0, atmosphere::kLargestRainRate_mm_per_h};

// A choice that atmosphere knows by name.
template <typename Parse, typename Choice>
void named(ConfigTable& table, const char* key, const char* fallback, Parse parse, Choice& into) {
  try {
    into = parse(table.text(key, fallback));
  } catch (const core::InputError& error) {
    for (const core::Problem& problem : error.problems())
      table.error(core::ErrorClass::ref, key, problem.value, problem.expected);
  }
}

// Every path asks every cell: a frame takes some 10 ms for each.
constexpr std::size_t kMostRainCells = 256;

// The entries of an array of tables that could be read without an error, and the tables they came
// from: problems found later are told there.
template <typename Entry, typename Read>
std::vector<Entry> read_list(ConfigTable& parent, const char* key, Read read,
                             std::vector<ConfigTable>& kept, std::size_t most = 10'000) {
  std::vector<Entry> entries;
  for (ConfigTable& table : parent.tables(key, most)) {
    const std::size_t problems = table.problems().all().size();
    const Entry entry = read(table);
    if (table.problems().all().size() != problems) continue;
    entries.push_back(entry);
    kept.push_back(table);
  }
  return entries;
}

atmosphere::FogLayer read_fog_layer(ConfigTable& table) {
  atmosphere::FogLayer layer;
  layer.visibility_m = table.optional_number("visibility_m", kVisibility_m);
  layer.liquid_water_g_per_m3 =
      table.optional_number("liquid_water_g_per_m3", kLiquidWater_g_per_m3);
  named(table, "fog_type", "kunkel", atmosphere::fog_water_model_named, layer.water_model);
  named(table, "fog_law", "itu-p840", atmosphere::fog_law_named, layer.law);
  layer.base_m = table.number("base_m", kHeight_m, layer.base_m);
  layer.top_m = table.required_number("top_m", kHeight_m);
  return layer;
}

atmosphere::AirLevel read_level(ConfigTable& table) {
  atmosphere::AirLevel level;
  level.height_m = table.required_number("height_m", kHeight_m);
  level.temperature_C = table.required_number("temperature_C", {-90, 50});
  level.humidity = table.required_number("humidity", {0, 1});
  level.pressure_hPa = table.optional_number("pressure_hPa", {100, 1100});
  return level;
}

RainCellDescription read_rain_cell(ConfigTable& table) {
  RainCellDescription described;
  described.at = read_spot(table, "at");
  atmosphere::RainCell& cell = described.cell;
  cell.rain_rate_mm_per_h = table.required_number("rain_rate_mm_per_h", kRainRate_mm_per_h);
  cell.base_m = table.number("base_m", kHeight_m, cell.base_m);
  cell.top_m = table.number("top_m", kHeight_m, cell.top_m);
  if (table.has("length_m") || table.has("width_m")) {
    cell.length_m = table.required_number("length_m", {1, 200000});
    cell.width_m = table.required_number("width_m", {1, 200000});
    cell.heading_rad = radians(table.number("heading_deg", {-360, 360}, 0.0));
    if (table.optional_number("radius_m", {1, 100000}))
      table.error(core::ErrorClass::range, "radius_m", "given beside length_m and width_m",
                  "either a circle or a rectangle");
  } else {
    cell.radius_m = table.required_number("radius_m", {1, 100000});
  }
  return described;
}

void read_layers(ConfigTable& table, const SceneDescription& scene, atmosphere::Weather& weather) {
  weather.visibility_m = table.optional_number("visibility_m", kVisibility_m);
  weather.liquid_water_g_per_m3 =
      table.optional_number("liquid_water_g_per_m3", kLiquidWater_g_per_m3);
  named(table, "fog_type", "kunkel", atmosphere::fog_water_model_named, weather.fog_water_model);
  named(table, "fog_law", "itu-p840", atmosphere::fog_law_named, weather.fog_law);
  weather.fog_top_m = table.number("fog_top_m", kHeight_m, weather.fog_top_m);

  weather.rain_rate_mm_per_h = table.number("rain_rate_mm_per_h", kRainRate_mm_per_h, 0.0);
  named(table, "rain_law", "itu-p838", atmosphere::rain_law_named, weather.rain_law);
  named(table, "rain_echo_law", "mie", atmosphere::rain_echo_law_named, weather.rain_echo_law);
  named(table, "drop_sizes", "marshall-palmer", atmosphere::drop_sizes_named, weather.drop_sizes);
  const bool upright = scene.sensor.waveform.polarisation == core::Polarisation::vertical;
  weather.polarisation_tilt_rad =
      radians(table.number("polarisation_tilt_deg", {-180, 180}, upright ? 90.0 : 0.0));

  weather.melting_layer = table.boolean("melting_layer", table.has("melting_height_m"));
  weather.melting_height_m = table.optional_number(
      "melting_height_m", {kHeight_m.low, kHeight_m.high - atmosphere::kRainHeightAboveZeroC_m});
  if (!weather.melting_layer && weather.melting_height_m)
    table.error(core::ErrorClass::range, "melting_height_m", "given without a melting layer",
                "melting_layer = true, or neither key");
  if (weather.melting_layer && table.has("rain_top_m"))
    table.error(core::ErrorClass::range, "rain_top_m", "given beside a melting layer",
                "one of them: the rain ends where the melting layer begins");
  weather.rain_top_m = table.number("rain_top_m", kHeight_m, weather.rain_top_m);
  weather.snow_rate_mm_per_h =
      table.number("snow_rate_mm_per_h", {0, atmosphere::kLargestSnowRate_mm_per_h}, 0.0);
  weather.snow_top_m = table.number("snow_top_m", kHeight_m, weather.snow_top_m);
}

// Keys about fog, rain or snow of which the file tells no amount.
void warn_of_idle_keys(ConfigTable& table) {
  const auto need = [&table](std::initializer_list<const char*> amounts,
                             std::initializer_list<const char*> keys, const char* needed) {
    if (std::any_of(amounts.begin(), amounts.end(),
                    [&](const char* key) { return table.has(key); }))
      return;
    for (const char* key : keys)
      if (table.has(key))
        table.warning("UNUSED", key, "given", std::string("nothing comes of it without ") + needed);
  };
  need({"visibility_m"}, {"fog_type"}, "visibility_m");
  need({"visibility_m", "liquid_water_g_per_m3"}, {"fog_law", "fog_top_m"},
       "visibility_m or liquid_water_g_per_m3");
  // Beside a melting layer it is an error.
  need({"rain_rate_mm_per_h", "melting_layer", "melting_height_m"}, {"rain_top_m"},
       "rain_rate_mm_per_h");
  need({"rain_rate_mm_per_h", "rain_cell"},
       {"rain_law", "rain_echo_law", "drop_sizes", "polarisation_tilt_deg"},
       "rain_rate_mm_per_h or a rain_cell");
  need({"rain_rate_mm_per_h", "snow_rate_mm_per_h"}, {"melting_layer", "melting_height_m"},
       "rain_rate_mm_per_h or snow_rate_mm_per_h");
  need({"snow_rate_mm_per_h"}, {"snow_top_m"}, "snow_rate_mm_per_h");
}

void read_air(ConfigTable& table, const SceneDescription& scene, atmosphere::Weather& weather) {
  weather.origin_height_m = table.number("origin_height_m", {-500, 6000},
                                         std::clamp(scene.origin.height_m, -500.0, 6000.0));
  weather.temperature_C = table.optional_number("temperature_C", {-60, 50});
  weather.pressure_hPa = table.optional_number("pressure_hPa", {300, 1100});
  weather.humidity = table.optional_number("humidity", {0, 1});
}

// Tables by the name that atmosphere's problems use for their entries: "fog_layer[0].".
using ListTables = std::vector<std::pair<std::string, std::vector<ConfigTable>>>;

// The table and key that a field of a problem stands for.
std::pair<ConfigTable, std::string> place_of(const std::string& field, const ConfigTable& table,
                                             const ListTables& lists) {
  for (const auto& [name, tables] : lists)
    for (std::size_t i = 0; i < tables.size(); ++i)
      if (const std::string prefix = name + "[" + std::to_string(i) + "].";
          field.starts_with(prefix))
        return {tables[i], field.substr(prefix.size())};
  return {table, field};
}

}  // namespace

void read_weather(ConfigTable& root, SceneDescription& scene) {
  ConfigTable table = root.table("weather");
  atmosphere::Weather& weather = scene.weather;
  read_layers(table, scene, weather);
  warn_of_idle_keys(table);
  read_air(table, scene, weather);
  ListTables lists = {{"fog_layer", {}}, {"level", {}}, {"rain_cell", {}}};
  weather.fog_layers =
      read_list<atmosphere::FogLayer>(table, "fog_layer", read_fog_layer, lists[0].second);
  weather.levels = read_list<atmosphere::AirLevel>(table, "level", read_level, lists[1].second);
  scene.rain_cells = read_list<RainCellDescription>(table, "rain_cell", read_rain_cell,
                                                    lists[2].second, kMostRainCells);

  if (!(scene.sensor.waveform.frequency_Hz > 0.0)) return;  // no usable sensor: already reported
  atmosphere::Weather with_cells = weather;
  for (const RainCellDescription& described : scene.rain_cells)
    with_cells.rain_cells.push_back(described.cell);
  const core::ProblemList found =
      atmosphere::problems_in(with_cells, scene.sensor.waveform.frequency_Hz);
  // A value outside the range was reported with its line already and replaced by its default.
  for (const core::Problem& problem : found.all()) {
    const auto [at, key] = place_of(problem.field, table, lists);
    core::Problem placed = problem;
    // No key of the weather, but where the weather's law and the sensor do not go together.
    placed.field = key == "frequency" ? "frequency of the sensor" : at.path(key);
    placed.place = at.place(key);
    table.problems().append({placed});
  }
}

}  // namespace fanbeam::scenes
