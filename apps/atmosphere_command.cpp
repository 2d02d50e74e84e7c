#include "apps/atmosphere_command.h"

#include <fmt/core.h>

#include <cmath>

#include "apps/scene_choice.h"
#include "atmosphere/loss_table.h"
#include "atmosphere/loss_text.h"
#include "core/constants.h"
#include "core/files.h"
#include "measure/frequency_choice.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/sensor_file.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

// The weather and the sensor that are asked about, before the options have changed it.
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
    const scenes::SceneDescription scene =
        read_chosen_scene({options.scene, {}, options.data}, problems);
    question = {scene.weather, scene.sensor, scene.rain_cells};
  }
  problems.throw_if_errors();
  return question;
}

// The problem in the words of the command line, where an option gave the value.
core::Problem in_words_of_options(core::Problem problem, const AtmosphereOptions& options) {
  const bool compares = !options.compare_GHz.empty();
  std::string option = option_behind(options.weather, problem.field);
  if (problem.field == "frequency" && (compares || !options.frequency_GHz.empty()))
    option = compares ? "--compare" : "--frequency";
  if (!option.empty()) problem.field = option;
  return problem;
}

// dB of an echo that may be none.
std::string dB_text(double value_dB) {
  return std::isfinite(value_dB) ? fmt::format("{:.1f}", value_dB) : "-";
}

void print_table(const atmosphere::AtmosphereTable& table) {
  constexpr const char* kHeadings =
      "{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>11} {:>10}\n";
  fmt::print("\n{} GHz\n", table.frequency_Hz / 1e9);
  fmt::print(kHeadings, "range", "oxygen", "vapour", "fog", "rain", "snow", "one way", "two-way",
             "eta", "as sigma0");
  fmt::print(kHeadings, "m", "dB", "dB", "dB", "dB", "dB", "dB", "dB", "m2/m3", "dB");
  for (const atmosphere::AtmosphereRow& row : table.rows)
    fmt::print(
        "{:>8.0f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>9.3f} {:>9.3f} {:>11.3g} "
        "{:>10}\n",
        row.range_m, row.oxygen_dB, row.vapour_dB, row.fog_dB, row.rain_dB, row.snow_dB,
        row.one_way_dB(), row.two_way_dB(), row.eta_m2_per_m3, dB_text(row.equivalent_sigma0_dB));
  if (table.rain)
    fmt::print("  rain: k = {:.5g}, alpha = {:.4f}\n", table.rain->k, table.rain->alpha);
}

void print_notes(const atmosphere::AtmospherePath& path,
                 const std::vector<atmosphere::AtmosphereModel>& models) {
  fmt::print(
      "Path from {} m to {} m above the origin; eta where it ends, and the sigma0 of ground "
      "that would\nreturn as much as a beam of {:.2f} deg (two-way) full of it.\n",
      path.from_height_m, path.to_height_m, path.beam_height_rad * 180.0 / core::kPi);
  for (const atmosphere::AtmosphereModel& model : models)
    fmt::print("  {:<10} {:<42} {}\n", model.cause, model.model, model.source);
}

void print_tables(const Question& question,
                  const std::vector<atmosphere::AtmosphereTable>& tables) {
  for (const atmosphere::AtmosphereTable& table : tables) {
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

session::Plot plot_of(const std::vector<atmosphere::AtmosphereTable>& tables) {
  session::Plot plot;
  plot.title = "Two-way loss over range";
  plot.x = {"range [km]", false, 0.0, {}};
  plot.y = {"loss [dB]", false, 0.0, {}};
  for (const atmosphere::AtmosphereTable& table : tables) {
    session::PlotSeries total{fmt::format("{} GHz", table.frequency_Hz / 1e9), {}, {}};
    for (const atmosphere::AtmosphereRow& row : table.rows) {
      total.x.push_back(1e-3 * row.range_m);
      total.y.push_back(row.two_way_dB());
    }
    plot.series.push_back(total);
  }
  return plot;
}

void write_files(const fs::path& folder, const std::vector<atmosphere::AtmosphereTable>& tables,
                 const std::vector<atmosphere::AtmosphereModel>& models) {
  fs::create_directories(folder);
  core::write_file_atomically(folder / "atmosphere.csv", atmosphere::loss_csv(tables));
  core::write_file_atomically(folder / "atmosphere.json", atmosphere::loss_json(tables, models));
  for (const char* name : {"atmosphere.svg", "atmosphere.png"})
    session::write_plot(plot_of(tables), folder / name);
}

// No point of the other height is nearer than the two are apart.
void require_rows(const AtmosphereOptions& options) {
  const double apart_m = std::abs(options.height_m - options.to_height_m);
  if (options.range_m < apart_m)
    core::throw_input_error(
        core::ErrorClass::range, "--range", options.range_m,
        "at least " + core::number_text(apart_m) + " m, what --height and --to-height are apart");
}

void answer(const Question& question, const AtmosphereOptions& options,
            const CommonOptions& common) {
  const bool compares = !options.compare_GHz.empty();
  core::ProblemList idle;
  if (!compares)  // which has fog and rain of its own
    check_amounts(options.weather, question.weather, !question.rain_cells.empty(), idle);
  check_laws(options.weather, question.weather, idle);
  idle.throw_if_errors();
  if (compares) {
    fmt::print("{}", measure::compare_frequencies(question.weather, 1e9 * options.compare_GHz[0],
                                                  1e9 * options.compare_GHz[1], options.output));
    return;
  }
  require_rows(options);
  const atmosphere::AtmospherePath path{options.height_m, options.to_height_m, options.range_m,
                                        options.step_m,
                                        sensors::two_way_width(question.sensor.antenna.elevation)};
  std::vector<double> frequencies_GHz = options.frequency_GHz;
  if (frequencies_GHz.empty())
    frequencies_GHz.push_back(question.sensor.waveform.frequency_Hz * 1e-9);
  std::vector<atmosphere::AtmosphereTable> tables;
  for (const double frequency_GHz : frequencies_GHz)
    tables.push_back(atmosphere::atmosphere_table(question.weather, 1e9 * frequency_GHz, path));
  const std::vector<atmosphere::AtmosphereModel> models = atmosphere_models(question.weather);
  if (options.json) {
    fmt::print("{}", atmosphere::loss_json(tables, models));
  } else if (options.csv) {
    fmt::print("{}", atmosphere::loss_csv(tables));
  } else {
    if (!common.quiet) print_notes(path, models);
    print_tables(question, tables);
  }
  if (!options.output.empty()) write_files(options.output, tables, models);
}

}  // namespace

int atmosphere(const AtmosphereOptions& options, const CommonOptions& common) {
  Question question = question_of(options);
  try {
    put_over(options.weather, question.weather);
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
