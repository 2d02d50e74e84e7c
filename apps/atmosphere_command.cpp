#include "apps/atmosphere_command.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/atmosphere_table.h"
#include "apps/frequency_choice.h"
#include "apps/gnuplot.h"
#include "core/constants.h"
#include "core/files.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/sensor_file.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

// The weather and the sensor that are asked about.
struct Question {
  atmosphere::Weather weather;
  sensors::Sensor sensor;
  std::vector<scenes::RainCellDescription> rain_cells;
};

Question question_of(const AtmosphereOptions& options) {
  Question question;
  core::ProblemList problems;
  if (options.scene.empty()) {
    question.sensor =
        sensors::read_sensor((shipped_folder() / "sensors/hivision.toml").string(), problems);
  } else {
    const scenes::SceneDescription scene = scenes::read_scene(
        find_scene(options.scene), {shipped_folder(), data_folders(options.data), {}}, problems);
    question = {scene.weather, scene.sensor, scene.rain_cells};
  }
  problems.throw_if_errors();
  put_over(options.weather, question.weather);
  return question;
}

// The problem in the words of the command line, where an option gave the value.
core::Problem in_words_of_options(core::Problem problem, const AtmosphereOptions& options) {
  const bool compares = !options.compare_GHz.empty();
  std::string option = option_behind(options.weather, problem.field);
  if (problem.field == "frequency_Hz" && (compares || !options.frequency_GHz.empty())) {
    option = compares ? "--compare" : "--frequency";
    problem.value = core::number_text(std::stod(problem.value) * 1e-9) + " GHz";
  }
  if (!option.empty()) problem.field = option;
  return problem;
}

// dB of an echo that may be none.
std::string dB_text(double value_dB) {
  return std::isfinite(value_dB) ? fmt::format("{:.1f}", value_dB) : "-";
}

std::string csv_of(const std::vector<AtmosphereTable>& tables) {
  std::string text =
      "frequency_GHz,range_m,gas_dB,fog_dB,rain_dB,snow_dB,one_way_dB,two_way_dB,eta_m2_per_m3,"
      "equivalent_sigma0_dB\n";
  for (const AtmosphereTable& table : tables)
    for (const AtmosphereRow& row : table.rows)
      text += fmt::format(
          "{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", table.frequency_Hz * 1e-9,
          row.range_m, row.one_way_dB.gas_dB_per_km, row.one_way_dB.fog_dB_per_km,
          row.one_way_dB.rain_dB_per_km, row.one_way_dB.snow_dB_per_km, row.total_one_way_dB(),
          2.0 * row.total_one_way_dB(), row.eta_m2_per_m3,
          std::isfinite(row.equivalent_sigma0_dB) ? fmt::format("{:.4f}", row.equivalent_sigma0_dB)
                                                  : "");
  return text;
}

std::string json_of(const std::vector<AtmosphereTable>& tables,
                    const std::vector<AtmosphereModel>& models) {
  nlohmann::ordered_json json;
  for (const AtmosphereModel& model : models)
    json["models"].push_back(
        {{"cause", model.cause}, {"model", model.model}, {"source", model.source}});
  for (const AtmosphereTable& table : tables) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const AtmosphereRow& row : table.rows) {
      nlohmann::ordered_json entry = {{"range_m", row.range_m},
                                      {"gas_dB", row.one_way_dB.gas_dB_per_km},
                                      {"fog_dB", row.one_way_dB.fog_dB_per_km},
                                      {"rain_dB", row.one_way_dB.rain_dB_per_km},
                                      {"snow_dB", row.one_way_dB.snow_dB_per_km},
                                      {"one_way_dB", row.total_one_way_dB()},
                                      {"two_way_dB", 2.0 * row.total_one_way_dB()},
                                      {"eta_m2_per_m3", row.eta_m2_per_m3}};
      if (std::isfinite(row.equivalent_sigma0_dB))
        entry["equivalent_sigma0_dB"] = row.equivalent_sigma0_dB;
      rows.push_back(entry);
    }
    json["frequencies"].push_back({{"frequency_GHz", table.frequency_Hz * 1e-9}, {"rows", rows}});
  }
  return json.dump(2) + "\n";
}

void print_table(const AtmosphereTable& table) {
  fmt::print("\n{} GHz\n{:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>11} {:>10}\n",
             table.frequency_Hz * 1e-9, "range", "gas", "fog", "rain", "snow", "one way", "two-way",
             "eta", "as sigma0");
  fmt::print("{:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>11} {:>10}\n", "m", "dB", "dB", "dB",
             "dB", "dB", "dB", "m2/m3", "dB");
  for (const AtmosphereRow& row : table.rows)
    fmt::print("{:>8.0f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>9.3f} {:>9.3f} {:>11.3g} {:>10}\n",
               row.range_m, row.one_way_dB.gas_dB_per_km, row.one_way_dB.fog_dB_per_km,
               row.one_way_dB.rain_dB_per_km, row.one_way_dB.snow_dB_per_km, row.total_one_way_dB(),
               2.0 * row.total_one_way_dB(), row.eta_m2_per_m3, dB_text(row.equivalent_sigma0_dB));
}

void print_notes(const AtmospherePath& path, const std::vector<AtmosphereModel>& models) {
  fmt::print(
      "Path from {} m to {} m above the origin; eta where it ends, and the sigma0 of ground "
      "that would\nreturn as much as a beam of {:.2f} deg (two-way) full of it.\n",
      path.from_height_m, path.to_height_m, path.beam_height_rad * 180.0 / core::kPi);
  for (const AtmosphereModel& model : models)
    fmt::print("  {:<10} {:<42} {}\n", model.cause, model.model, model.source);
}

void print_tables(const Question& question, const std::vector<AtmosphereTable>& tables) {
  for (const AtmosphereTable& table : tables) {
    print_table(table);
    for (const scenes::RainCellDescription& described : question.rain_cells) {
      const double rate_mm_per_h = described.cell.rain_rate_mm_per_h;
      fmt::print("  {} of {} mm/h: {:.3f} dB/km one way and eta {:.3g} m2/m3 more inside\n",
                 described.at.field.substr(0, described.at.field.rfind('.')), rate_mm_per_h,
                 rain_dB_per_km(question.weather, rate_mm_per_h, table.frequency_Hz),
                 rain_eta_m2_per_m3(question.weather.rain_echo_law, rate_mm_per_h,
                                    table.frequency_Hz, rain_drops(question.weather)));
    }
  }
}

Plot plot_of(const std::vector<AtmosphereTable>& tables) {
  Plot plot;
  plot.title = "Two-way loss over range";
  plot.x = {"range [km]", false, 0.0, {}};
  plot.y = {"loss [dB]", false, 0.0, {}};
  for (const AtmosphereTable& table : tables) {
    PlotSeries total{fmt::format("{} GHz", table.frequency_Hz * 1e-9), {}, {}};
    for (const AtmosphereRow& row : table.rows) {
      total.x.push_back(1e-3 * row.range_m);
      total.y.push_back(2.0 * row.total_one_way_dB());
    }
    plot.series.push_back(total);
  }
  return plot;
}

void write_files(const fs::path& folder, const std::vector<AtmosphereTable>& tables,
                 const std::vector<AtmosphereModel>& models) {
  fs::create_directories(folder);
  core::write_file_atomically(folder / "atmosphere.csv", csv_of(tables));
  core::write_file_atomically(folder / "atmosphere.json", json_of(tables, models));
  for (const char* name : {"atmosphere.svg", "atmosphere.png"})
    write_plot(plot_of(tables), folder / name);
}

void answer(const Question& question, const AtmosphereOptions& options,
            const CommonOptions& common) {
  if (!options.compare_GHz.empty()) {
    compare_frequencies(question.weather, 1e9 * options.compare_GHz[0],
                        1e9 * options.compare_GHz[1], options.output);
    return;
  }
  const AtmospherePath path{options.height_m, options.to_height_m, options.range_m, options.step_m,
                            sensors::two_way_width(question.sensor.antenna.elevation)};
  std::vector<double> frequencies_GHz = options.frequency_GHz;
  if (frequencies_GHz.empty())
    frequencies_GHz.push_back(question.sensor.waveform.frequency_Hz * 1e-9);
  std::vector<AtmosphereTable> tables;
  for (const double frequency_GHz : frequencies_GHz)
    tables.push_back(atmosphere_table(question.weather, 1e9 * frequency_GHz, path));
  const std::vector<AtmosphereModel> models = atmosphere_models(question.weather);
  if (options.json) {
    fmt::print("{}", json_of(tables, models));
  } else if (options.csv) {
    fmt::print("{}", csv_of(tables));
  } else {
    if (!common.quiet) print_notes(path, models);
    print_tables(question, tables);
  }
  if (!options.output.empty()) write_files(options.output, tables, models);
}

}  // namespace

int atmosphere(const AtmosphereOptions& options, const CommonOptions& common) {
  const Question question = question_of(options);
  try {
    answer(question, options, common);
  } catch (const core::InputError& error) {
    std::vector<core::Problem> problems;
    for (const core::Problem& problem : error.problems())
      problems.push_back(in_words_of_options(problem, options));
    throw core::InputError(problems);
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
