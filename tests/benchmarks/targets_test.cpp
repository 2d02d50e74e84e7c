// The table of targets and the list of what was missed: no target is missed without a reason.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "benchmarks/bench_report.h"
#include "benchmarks/reasons.h"

using namespace fanbeam::benchmarks;

namespace {

// Of a line "| a | b |".
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t at = 2; at < line.size();) {
    const std::size_t end = line.find(" |", at);
    cells.push_back(line.substr(at, end - at));
    at = end + 3;
  }
  return cells;
}

std::vector<std::vector<std::string>> table_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("| ") && !line.starts_with("| ---") && !line.starts_with("| what |"))
      rows.push_back(cells_of(line));
  return rows;
}

constexpr double kFar = 99.0;
constexpr PictureError kWrong{{kFar, kFar, kFar}, {kFar, kFar, kFar}};

LadderStep slow_step(Way way) {
  LadderStep step;
  step.way = way;
  step.time.ms = 1e4;
  step.error = {kWrong, kWrong};
  return step;
}

CasterFigures slow_caster(Way way) {
  const LadderStep step = slow_step(way);
  return {{step}, step, step, step, {1.0, 1.0}};
}

ViewFigures bad_view() {
  ViewFigures view;
  view.view.distance_m = 2500.0;
  view.reference_s = 1e4;
  view.reference_error = FrameError{kWrong, kWrong};
  view.at_default = {kWrong, kWrong};
  view.rays = slow_caster(Way::rays);
  view.slices = view.surfaces = slow_caster(Way::slices);
  view.slices_agreement.agreement.bscope.error = view.slices_agreement.agreement.cscope.error =
      kWrong;
  view.bare = {.rays = 1, .bare_ms = 1.0, .frame_ms = 1e4, .shape = ""};
  return view;
}

// The names of sequences are those that the program measures.
SceneFigures bad_scene(const BenchScene& scene) {
  SceneFigures figures;
  figures.scene = &scene;
  for (const char* isa : {"", "v3"})
    for (const char* caster : {"rays", "profile", "auto"})
      figures.sequences.push_back(
          {std::string("--caster ") + caster + (*isa == '\0' ? "" : std::string(" --isa ") + isa),
           isa, "", 1, 1e4, 0.1});
  figures.views = {bad_view()};
  figures.scaling = {{10.0, 1, 1.0, 1.0}, {1.0, 2, 1e4, 1e4}};
  PlanFigures plan;
  plan.scene = &scene;
  plan.plan_ms = plan.conditions_ms = plan.off_over_absent = 1e4;
  plan.planned_ms = plan.forced_ms = plan.forced_sample_ms = 1.0;
  figures.plan = plan;
  return figures;
}

// Every kind of figure, all of them bad.
Report bad_report(const BenchScene& standard, const BenchScene& city) {
  Report report;
  report.threads = 2;
  report.scenes = {bad_scene(standard), bad_scene(city)};
  AgreementFigures line;
  line.scene = kObstacleScene;
  line.agreement.bscope.error = line.agreement.cscope.error = kWrong;
  report.agreement = {line};
  report.rain = DefaultFigures{kRainScene,
                               SequenceFigures{"--caster auto", "", "", 1, 1e4, 0.1},
                               {{2500.0, {kWrong, kWrong}}}};
  report.layers = {{kDefaultScene, 1.0, kFar, kFar}};
  CampaignFigures campaigns;
  campaigns.one_thread_s = campaigns.two_threads_s = campaigns.render_s = 1.0;
  campaigns.two_workers_s = campaigns.campaign_s = campaigns.plan_s = campaigns.city_s = 1e4;
  campaigns.plan_bytes = 1e12;
  report.campaigns = campaigns;
  report.bounds = {{kDefaultScene, "gas", 255.0, 60.0, 0.0, 0.25, 0.235}};
  report.estimates = {{kDefaultScene, 0, "rays", "B-scope", 1.0, kFar}};
  return report;
}

TargetRows all_missed() {
  BenchScene standard, city;
  standard.name = kDefaultScene;
  city.name = kCityScene;
  standard.scene = city.scene = build("flat-grass");  // of which the table wants the time it took
  city.peak_memory_bytes = 1e12;
  return target_rows(bad_report(standard, city));
}

std::string published() {
  std::ifstream stream(FANBEAM_SOURCE_DIR "/docs/performance.md");
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("A missed target is listed with its reason, a met one is not", "[bench]") {
  TargetRow missed("frames/s", Reason{"the frame is slow"}, "at least 16");
  missed.add("9.6");
  missed.judge(9.6, {16.0, 16.0, true});
  TargetRow met("error", Reason{"noise"}, "1", "0.5");
  met.add("0.7");
  met.judge(0.7, {1.0, 0.5});
  CHECK(missed.markdown() == "| frames/s | at least 16 | - | 9.6 | missed |\n");
  CHECK(met.markdown() == "| error | 1 | 0.5 | 0.7 | must met |\n");
  const std::string summary = summary_markdown({}, {missed, met});
  CHECK(
      summary.ends_with("| what | must | aim | measured | why |\n| --- | --- | --- | --- | --- |\n"
                        "| frames/s | at least 16 | - | 9.6 | the frame is slow |\n\n"));
  CHECK(summary_markdown({}, {met}).ends_with("Every target is met.\n\n"));
}

TEST_CASE("Every target of the report has a reason for when it is missed", "[bench]") {
  const TargetRows rows = all_missed();
  CHECK(rows.size() > 80);
  for (const TargetRow& row : rows) {
    INFO(row.markdown());
    CHECK(row.missed());
    const std::vector<std::string> cells = cells_of(row.missed_markdown());
    REQUIRE(cells.size() == 5);
    CHECK(cells.back().size() > 20);
  }
}

TEST_CASE("What the published report has missed has a reason that is known", "[bench]") {
  std::map<std::string, std::string> reasons;
  for (const TargetRow& row : all_missed()) {
    const std::vector<std::string> cells = cells_of(row.missed_markdown());
    reasons[cells.front()] = cells.back();
  }
  const std::string report = published();
  const std::size_t begin = report.find("## Targets and measured figures");
  REQUIRE(begin != std::string::npos);
  int missed = 0;
  for (const auto& cells : table_rows(report.substr(begin, report.find("\n## ", begin) - begin))) {
    if (cells.back() != "missed") continue;
    ++missed;
    INFO(cells.front());
    REQUIRE(reasons.count(cells.front()) == 1);
    CHECK(reasons[cells.front()] != kNotKnown.text);
  }
  CHECK(missed > 0);
}
