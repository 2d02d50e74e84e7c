#include "benchmarks/campaign_cost.h"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

#include "benchmarks/process_memory.h"
#include "benchmarks/reasons.h"
#include "benchmarks/scratch_folder.h"
#include "core/files.h"
#include "measure/clock.h"

namespace fanbeam::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShared = R"([campaign]
name = "bench"
scenes = ["obstacle-field"]
plan = "sobol"
runs = {}
frames = {{ count = {}, from = 0.2, to = 0.9 }}
products = ["bscope", "cscope"]
isa = "v3"
[parameters]
weather.visibility_m = {{ log_uniform = [150, 2000] }}
weather.rain_rate_mm_per_h = {{ values = [0, 1, 4] }}
)";

constexpr const char* kMillion = R"([campaign]
name = "million"
scenes = ["braunschweig-26"]
plan = "sobol"
runs = 1000000
[parameters]
weather.visibility_m = { log_uniform = [150, 2000] }
weather.rain_rate_mm_per_h = { uniform = [0, 10] }
weather.temperature_C = { uniform = [-10, 30] }
weather.pressure_hPa = { normal = [1013, 10], within = [980, 1040] }
weather.humidity = { uniform = [0.3, 1] }
sensor.tilt_deg = { uniform = [-3, 0] }
sensor.noise_figure_dB = { uniform = [4, 8] }
flight.lateral_m = { normal = [0, 10], within = [-40, 40] }
flight.vertical_m = { normal = [0, 5], within = [-15, 20] }
flight.heading_deg = { uniform = [-3, 3] }
flight.pitch_deg = { uniform = [-2, 2] }
flight.roll_deg = { uniform = [-5, 5] }
flight.speed_factor = { uniform = [0.8, 1.2] }
flight.turbulence_m = { uniform = [0, 3] }
flight.turbulence_deg = { uniform = [0, 2] }
)";

constexpr const char* kCity = R"([scene]
name = "city"
origin = { latitude_deg = 52.1561, longitude_deg = 5.3872, height_m = 0.0 }
vertical_datum = "egm96"
[terrain]
half_extent_m = 6000.0
spacing_m = 20.0
[[buildings]]
file = "city.json"
[trajectory.fixed]
at = { latitude_deg = 52.1161, longitude_deg = 5.3872 }
above_ground_m = 200.0
)";

// Houses of 8 m to 20 m in rows, with gabled roofs, around Amersfoort in Dutch coordinates.
std::string city_json(int houses) {
  nlohmann::json city = {
      {"type", "CityJSON"},
      {"version", "2.0"},
      {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/7415"}}},
      {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {155000, 463000, 0}}}}};
  const int side = static_cast<int>(std::ceil(std::sqrt(houses)));
  for (int n = 0; n < houses; ++n) {
    const int x = 28'000 * (n % side - side / 2), y = 28'000 * (n / side - side / 2);
    const int a = 6000 + 37 * (n % 135), b = 4000 + 53 * (n % 113), z = 4000 + 71 * (n % 97);
    const int base = 10 * n;
    const int corners[10][3] = {{-a, -b, 0},       {a, -b, 0},      {a, b, 0}, {-a, b, 0},
                                {-a, -b, z},       {a, -b, z},      {a, b, z}, {-a, b, z},
                                {-a, 0, z + 3000}, {a, 0, z + 3000}};
    for (const auto& corner : corners)
      city["vertices"].push_back({x + corner[0], y + corner[1], corner[2]});
    nlohmann::json shell;
    for (const std::vector<int>& face :
         {std::vector{3, 2, 1, 0}, std::vector{0, 1, 5, 4}, std::vector{1, 2, 6, 9, 5},
          std::vector{2, 3, 7, 6}, std::vector{3, 0, 4, 8, 7}, std::vector{4, 5, 9, 8},
          std::vector{8, 9, 6, 7}}) {
      nlohmann::json ring;
      for (const int corner : face) ring.push_back(base + corner);
      shell.push_back(nlohmann::json::array({ring}));
    }
    city["CityObjects"][fmt::format("house-{:05}", n)] = {
        {"type", "Building"},
        {"geometry",
         {{{"type", "Solid"}, {"lod", "2.2"}, {"boundaries", nlohmann::json::array({shell})}}}}};
  }
  return city.dump();
}

constexpr std::chrono::milliseconds kLook{5};  // how often at what runs

struct Ended {
  double seconds = 0.0, peak_bytes = 0.0;
};

// All at once; the time until the last has ended. Throws std::runtime_error when one fails.
Ended run(const std::vector<std::vector<std::string>>& commands) {
  const auto begin = measure::Clock::now();
  std::vector<pid_t> children;
  for (const std::vector<std::string>& words : commands) {
    const pid_t child = fork();
    if (child == 0) {
      std::vector<char*> arguments;
      for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
      arguments.push_back(nullptr);
      if (std::freopen("/dev/null", "w", stdout) == nullptr) _exit(127);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    children.push_back(child);
  }
  Ended ended;
  std::vector<double> peaks_bytes(children.size(), 0.0);
  for (std::size_t running = children.size(); running > 0;) {
    std::this_thread::sleep_for(kLook);
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (children[i] == 0) continue;
      // Asked while it runs: what the system tells of one that has ended includes the memory of the
      // process that it was forked from, this one. For the same reason the last answer counts.
      if (const double peak = process_memory_bytes("VmHWM", children[i]); peak > 0.0)
        peaks_bytes[i] = peak;
      int status = 0;
      const pid_t found = waitpid(children[i], &status, WNOHANG);
      if (found == 0) continue;
      if (found != children[i] || status != 0)
        throw std::runtime_error("ended with " + std::to_string(status));
      children[i] = 0;
      --running;
    }
  }
  ended.peak_bytes = *std::ranges::max_element(peaks_bytes);
  ended.seconds = measure::milliseconds_since(begin) / 1000.0;
  return ended;
}

class Measurement {
 public:
  explicit Measurement(const Effort& effort) : effort_(effort) {}

  CampaignFigures all() {
    workers();
    overhead();
    write("million.toml", kMillion);
    const Ended plan = run({{program_, "campaign", "plan", path("million.toml"), "--no-pilot"}});
    figures_.plan_s = plan.seconds;
    figures_.plan_bytes = plan.peak_bytes;
    city();
    return figures_;
  }

 private:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    core::write_file_atomically(scratch_.path() / name, text);
  }
  std::vector<std::string> worker(int threads) const {
    return {program_, "campaign",  "run",       path("shared.toml"),
            "-o",     path("out"), "--threads", std::to_string(threads),
            "-q"};
  }

  // In turns, so that all see the same machine.
  void workers() {
    figures_.runs = effort_.quick ? 2 : 40;
    figures_.frames = effort_.quick ? 2 : 5;
    write("shared.toml", fmt::format(kShared, figures_.runs, figures_.frames));
    figures_.one_thread_s = figures_.two_threads_s = figures_.two_workers_s = 1e300;
    for (int turn = 0; turn < (effort_.quick ? 1 : 3); ++turn) {
      const auto best = [&](double& least_s,
                            const std::vector<std::vector<std::string>>& commands) {
        least_s = std::min(least_s, run(commands).seconds);
        fs::remove_all(scratch_.path() / "out");
      };
      best(figures_.two_threads_s, {worker(2)});
      best(figures_.two_workers_s, {worker(1), worker(1)});
      best(figures_.one_thread_s, {worker(1)});
    }
  }

  // The first frames of the flight, one after the other.
  void overhead() {
    constexpr double kLastFrame = 565.0;  // of obstacle-field
    figures_.overhead_frames = effort_.quick ? 4 : 100;
    write(
        "one.toml",
        fmt::format("[campaign]\nname = \"one\"\nscenes = [\"obstacle-field\"]\nruns = 1\n"
                    "frames = {{ count = {}, to = {:.9f} }}\nproducts = [\"bscope\", \"cscope\"]\n"
                    "isa = \"v3\"\n",
                    figures_.overhead_frames, (figures_.overhead_frames - 1) / kLastFrame));
    figures_.render_s = figures_.campaign_s = 1e300;
    const std::string frames = fmt::format("0:{}", figures_.overhead_frames);
    for (int turn = 0; turn < (effort_.quick ? 1 : 3); ++turn) {
      const auto best = [&](double& least_s, const std::vector<std::string>& words) {
        least_s = std::min(least_s, run({words}).seconds);
      };
      best(figures_.campaign_s, {program_, "campaign", "run", path("one.toml"), "-o", path("one"),
                                 "--threads", "2", "-q"});
      best(figures_.render_s, {program_, "render", "obstacle-field", "--isa", "v3", "--frames",
                               frames, "--threads", "2", "-o", path("render"), "-q"});
      if (files_of("one/runs/000000/bscope") != files_of("render/bscope"))
        throw std::runtime_error("the campaign and fanbeam render made other pictures");
      fs::remove_all(scratch_.path() / "one");
      fs::remove_all(scratch_.path() / "render");
    }
  }

  // Of all files of a folder, by their names.
  std::map<std::string, std::string> files_of(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(scratch_.path() / folder))
      files[entry.path().filename().string()] = core::read_file(entry.path(), 1U << 28U);
    return files;
  }

  void city() {
    figures_.houses = effort_.quick ? 200 : 20'000;
    write("city.json", city_json(figures_.houses));
    write("scene.toml", kCity);
    run({{program_, "render", path("scene.toml"), "-o", path("city"), "--frames", "0", "-q"}});
    const nlohmann::json record =
        nlohmann::json::parse(core::read_file(scratch_.path() / "city/timing.json", 1U << 28U));
    figures_.city_s = record.at("summary").at("scene_build_s").get<double>();
  }

  const Effort& effort_;
  ScratchFolder scratch_;
  std::string program_ = program_beside().string();
  CampaignFigures figures_;
};

}  // namespace

std::optional<CampaignFigures> measure_campaigns(const Effort& effort) {
  fmt::print(stderr, "campaigns, and a city of CityJSON\n");
  try {
    return Measurement(effort).all();
  } catch (const std::exception& error) {
    fmt::print(stderr, "[skipped] campaigns: {}\n", error.what());
    return std::nullopt;
  }
}

std::string campaigns_markdown(const CampaignFigures& f) {
  return fmt::format(
      "## Campaigns\n\n"
      "By the program, from its start to its end. {} runs of {} frames of obstacle-field: {:.2f} s "
      "by one\n"
      "worker of one thread, {:.2f} s by one of two threads, {:.2f} s by two of one thread each. "
      "{} frames:\n"
      "{:.2f} s by `fanbeam render`, {:.2f} s as a campaign of one run, hashes and all.\n\n",
      f.runs, f.frames, f.one_thread_s, f.two_threads_s, f.two_workers_s, f.overhead_frames,
      f.render_s, f.campaign_s);
}

TargetRows campaign_rows(const CampaignFigures& f) {
  TargetRow workers("campaign, rate of two workers over one of two threads", kNotKnown,
                    "at least 0.97");
  workers.add(fmt::format("{:.2f} (one worker: {:.2f} from one thread to two)",
                          f.workers_over_threads(), f.one_thread_s / f.two_threads_s));
  workers.judge(f.workers_over_threads(), {0.97, 0.97, true});
  TargetRow overhead("campaign of one run, time beyond that of fanbeam render, per cent", kNotKnown,
                     "3");
  overhead.add(fmt::format("{:.1f}", 100.0 * f.overhead()));
  overhead.judge(100.0 * f.overhead(), {3.0, 3.0});
  TargetRow plan("campaign, plan of a million runs with 15 parameters, s", kNotKnown, "5");
  plan.add(fmt::format("{:.1f}", f.plan_s));
  plan.judge(f.plan_s, {5.0, 5.0});
  TargetRow memory("the same, MB", kNotKnown, "200");
  memory.add(fmt::format("{:.0f}", f.plan_bytes / 1e6));
  memory.judge(f.plan_bytes / 1e6, {200.0, 200.0});
  TargetRow city(fmt::format("scene of {} houses of CityJSON, building it, s", f.houses), kNotKnown,
                 "5");
  city.add(fmt::format("{:.1f}", f.city_s));
  city.judge(f.city_s, {5.0, 5.0});
  return {workers, overhead, plan, memory, city};
}

}  // namespace fanbeam::benchmarks
