// fanbeam_bench: google-benchmark cases, then the report of docs/performance.md.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "benchmarks/bench_report.h"
#include "benchmarks/cases.h"
#include "benchmarks/estimate_check.h"
#include "benchmarks/machine_load.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/text.h"
#include "measure/ladder_plot.h"

namespace fanbeam::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestNotes_bytes = 1 << 20;

constexpr const char* kUsage =
    "Usage: fanbeam_bench [--report FILE] [--no-report] [--no-cases] [--estimates] "
    "[--no-estimates] [--campaigns] [--layers] "
    "[--quick] [--threads N] [--benchmark_...]\n"
    "\n"
    "  --report FILE   write the report there instead of to the standard output, and its plots\n"
    "                  into the folder images beside it\n"
    "  --no-report     only the google-benchmark cases\n"
    "  --no-cases      only the report\n"
    "  --estimates     only the report's section on the errors that frames state; not timed\n"
    "  --no-estimates  the report without that section, in a quarter of the time\n"
    "  --campaigns     only what campaigns and city models cost\n"
    "  --layers        only what layers cost, of every scene\n"
    "  --quick         coarse and short, to try the report: its figures mean nothing\n"
    "  --threads N     threads to use (2, which the targets are set for; 0 for all cores)\n"
    "  --benchmark_... options of google-benchmark, as --benchmark_filter=frame\n";

struct Options {
  std::string report_file;
  bool report = true;
  bool cases = true;
  bool estimates = true, estimates_alone = false, campaigns_alone = false, layers_alone = false;
  bool quick = false;
  int threads = 2;
};

// Throws InputError for anything unknown.
Options parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    const bool has_value = i + 1 < count;
    if (argument == "--no-report") {
      options.report = false;
    } else if (argument == "--no-cases") {
      options.cases = false;
    } else if (argument == "--no-estimates") {
      options.estimates = false;
    } else if (argument == "--estimates") {
      options.estimates_alone = true;
    } else if (argument == "--campaigns") {
      options.campaigns_alone = true;
    } else if (argument == "--layers") {
      options.layers_alone = true;
    } else if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--report" && has_value) {
      options.report_file = arguments[++i];
    } else if (argument == "--threads" && has_value) {
      const core::ParsedNumber number = core::parse_number(arguments[++i]);
      if (number.error != core::NumberError::none || !(number.value >= 0 && number.value <= 1024))
        core::throw_input_error(core::ErrorClass::range, "--threads", arguments[i], "0 to 1024");
      options.threads = static_cast<int>(number.value);
    } else {
      core::throw_input_error(core::ErrorClass::ref, "argument", std::string(argument),
                              "an option that --help lists, with its value");
    }
  }
  return options;
}

SceneFigures measure(const BenchScene& scene, bool city, const Effort& effort, int threads) {
  SceneFigures figures;
  figures.scene = &scene;
  const View farthest = view_at(scene, kDistances_m[0]);
  std::vector<SequenceWish> wishes = {{renderer::CasterWish::rays},
                                      {renderer::CasterWish::profile}};
  if (city) wishes.push_back({renderer::CasterWish::automatic, "v3"});
  for (const SequenceWish& wish : wishes)
    if (auto sequence = measure_sequence(farthest, wish, effort.sequence_frames, threads))
      figures.sequences.push_back(*sequence);
  for (const double distance_m : kDistances_m) {
    Extras extras;
    extras.second_reference = figures.views.empty();
    // Over a city the split between azimuth and range matters most.
    extras.splits = figures.views.empty() && city;
    figures.views.push_back(measure_view(view_at(scene, distance_m), effort, extras));
  }
  if (city) figures.scaling = measure_scaling(farthest, effort);
  figures.plan = measure_plan(farthest, effort);
  return figures;
}

Report measure(const std::vector<BenchScene>& scenes, const Effort& effort, int threads,
               bool estimates, const MachineLoad& machine) {
  Report report;
  report.threads = threads;
  report.quick = effort.quick;
  for (const BenchScene& scene : scenes)
    report.scenes.push_back(measure(scene, &scene == &scenes.back(), effort, threads));
  if (const auto obstacles = load(kObstacleScene))
    report.agreement.push_back(measure_agreement(view_at(*obstacles, kDistances_m[1]), effort));
  report.rain = measure_defaults(kRainScene, effort, threads);
  report.layers = measure_layers(effort);
  report.campaigns = measure_campaigns(effort);
  report.other_cores = machine.other_cores();  // what follows is not timed
  report.bounds = check_bounds(effort);
  if (estimates) report.estimates = check_estimates(effort);
  return report;
}

// docs/performance-notes.md of the source tree without its own title; empty where there is none.
std::string notes() {
  const fs::path file = fs::path(FANBEAM_SOURCE_DIR) / "docs" / "performance-notes.md";
  if (!fs::exists(file)) return "";
  std::string text = core::read_file(file, kLargestNotes_bytes);
  if (text.starts_with("# ")) text.erase(0, std::min(text.size(), text.find('\n')) + 1);
  text.erase(0, text.find_first_not_of('\n'));
  return text;
}

// The error of the B-scope as displayed; the views after the first are dashed.
session::Plot ladder_plot(const SceneFigures& scene) {
  std::vector<measure::LadderCurve> curves;
  for (const ViewFigures& view : scene.views)
    for (std::size_t i = 0; i < measure::kWays.size(); ++i) {
      const Way way = measure::kWays[i];
      const bool first = &view == &scene.views.front();
      curves.push_back({first ? std::string(measure::words_of(way)) : "", i, !first,
                        way == Way::slices ? view.slices.ladder
                        : way == Way::rays ? view.rays.ladder
                                           : measure::steps_of(view.naive, way),
                        measure::bscope_with_noise, first});
    }
  const std::vector<ViewFigures>& views = scene.views;
  std::string title =
      fmt::format("{}, B-scope: error over frame time, {:.0f} m before the threshold",
                  views.front().view.scene->name, views.front().view.distance_m);
  if (views.size() > 1) title += fmt::format(" (dashed: {:.0f} m)", views.back().view.distance_m);
  return measure::ladder_plot(title, curves);
}

void draw(Report& report, const fs::path& folder) {
  for (const SceneFigures& scene : report.scenes) {
    const std::string name = "performance-" + scene.views.front().view.scene->name;
    try {
      session::write_plots(ladder_plot(scene), folder / name);
      report.plots.push_back(name);
    } catch (const core::InputError& error) {
      fmt::print(stderr, "[skipped] {}\n", error.what());
    }
  }
}

void write(Report& report, const fs::path& file) {
  draw(report, fs::absolute(file).parent_path() / "images");
  core::write_file_atomically(file, markdown(report));
}

void run(const Options& options) {
  const MachineLoad machine;
  const core::ThreadLimit threads(options.threads);
  const Effort effort = options.quick ? quick_effort() : full_effort();
  if (options.estimates_alone) {
    fmt::print("{}", estimates_markdown(check_estimates(effort)));
    return;
  }
  if (options.campaigns_alone) {
    if (const auto figures = measure_campaigns(effort))
      fmt::print("{}{}", campaigns_markdown(*figures), markdown_of(campaign_rows(*figures)));
    return;
  }
  if (options.layers_alone) {
    const std::vector<LayerCost> costs = measure_layers(effort);
    fmt::print("{}{}", layers_row(costs).markdown(), unasked_layers_row(costs).markdown());
    return;
  }
  std::vector<BenchScene> scenes;
  std::vector<std::string> skipped;
  for (const char* name : {kDefaultScene, kCityScene}) {
    if (auto scene = load(name)) {
      scenes.push_back(std::move(*scene));
    } else {
      skipped.emplace_back(name);
    }
  }
  if (options.cases) {
    register_cases(scenes);
    benchmark::RunSpecifiedBenchmarks();
  }
  if (!options.report) return;
  Report report = measure(scenes, effort, core::ThreadLimit::threads(), options.estimates, machine);
  report.skipped = std::move(skipped);
  report.notes = notes();
  if (options.report_file.empty()) {
    fmt::print("\n{}", markdown(report));
  } else {
    write(report, options.report_file);
  }
}

}  // namespace
}  // namespace fanbeam::benchmarks

int main(int count, char** arguments) {
  using namespace fanbeam;
  constexpr int kExitUsage = 2;
  constexpr int kExitFailed = 5;
  for (int i = 1; i < count; ++i) {
    if (std::string_view(arguments[i]) != "--help") continue;
    fmt::print("{}", benchmarks::kUsage);
    return 0;
  }
  try {
    benchmark::Initialize(&count, arguments);
    benchmarks::run(benchmarks::parse(count, arguments));
    return 0;
  } catch (const core::InputError& error) {
    for (const core::Problem& problem : error.problems())
      fmt::print(stderr, "{}\n", core::to_string(problem));
    return kExitUsage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "fanbeam_bench: {}\n", error.what());
    return kExitFailed;
  }
}
