// fanbeam_bench: google-benchmark cases, then the report of docs/performance.md.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include "benchmarks/cases.h"
#include "benchmarks/report.h"
#include "core/errors.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/text.h"

namespace fanbeam::benchmarks {
namespace {

constexpr double kDistances_m[] = {2500.0, 1000.0};
constexpr int kSequenceFrames = 48;

constexpr const char* kUsage =
    "Usage: fanbeam_bench [--report FILE] [--no-report] [--no-cases] [--threads N] "
    "[--benchmark_...]\n"
    "\n"
    "  --report FILE   write the report there instead of to the standard output\n"
    "  --no-report     only the google-benchmark cases\n"
    "  --no-cases      only the report\n"
    "  --threads N     threads to use (2, which the targets are set for; 0 for all cores)\n"
    "  --benchmark_... options of google-benchmark, as --benchmark_filter=frame\n";

struct Options {
  std::string report_file;
  bool report = true;
  bool cases = true;
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

Report measure(const std::vector<BenchScene>& scenes, std::vector<std::string> skipped,
               int threads) {
  Report report;
  report.threads = threads;
  report.skipped = std::move(skipped);
  for (const BenchScene& scene : scenes) {
    SceneFigures figures;
    figures.scene = &scene;
    const View farthest = view_at(scene, kDistances_m[0]);
    figures.sequence = measure_sequence(farthest, kSequenceFrames, threads);
    for (const double distance_m : kDistances_m) {
      Extras extras;
      extras.second_reference = figures.views.empty();
      // Over a city the split between azimuth and range matters most.
      extras.splits = figures.views.empty() && &scene == &scenes.back();
      figures.views.push_back(measure_view(view_at(scene, distance_m), extras));
    }
    report.scenes.push_back(std::move(figures));
  }
  return report;
}

double load_average() {
  double load = 0.0;
  return getloadavg(&load, 1) == 1 ? load : 0.0;
}

void run(const Options& options) {
  const double load_before = load_average();
  const core::ThreadLimit threads(options.threads);
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
  Report report = measure(scenes, std::move(skipped), threads.threads());
  report.load_before = load_before;
  const std::string text = markdown(report);
  if (options.report_file.empty()) {
    fmt::print("\n{}", text);
  } else {
    core::write_file_atomically(options.report_file, text);
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
