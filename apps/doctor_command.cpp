#include "apps/doctor_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/frame_choice.h"
#include "apps/sampling_choice.h"
#include "apps/text_table.h"
#include "core/files.h"
#include "renderer/plan/effects.h"
#include "scenes/doctor/scene_doctor.h"

namespace fanbeam::apps {
namespace {

using scenes::Finding;
using scenes::Findings;
using scenes::Severity;

constexpr std::size_t kFramesMeasured = 3;

std::string name_of(Severity severity) {
  return severity == Severity::wrong      ? "wrong"
         : severity == Severity::delicate ? "delicate"
                                          : "note";
}

std::string figure_text(const Finding& finding) {
  return fmt::format("{:.3g}{}{}", finding.figure, finding.unit.empty() ? "" : " ", finding.unit);
}

std::string table(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += beside(fmt::format("{:<9} ", name_of(finding.severity)),
                   fmt::format("{}: {}", finding.check, figure_text(finding)));
    for (const auto& [label, words] : {std::pair{"what", &finding.what},
                                       {"where", &finding.where},
                                       {"why", &finding.why},
                                       {"do", &finding.remedy}})
      text += beside(fmt::format("          {:<6} ", label), *words);
  }
  return text;
}

std::string json_text(const scenes::Scene& scene, const Findings& findings) {
  nlohmann::ordered_json json;
  json["version"] = version_text();
  json["commit"] = commit_text();
  json["scene"] = scene.description.name;
  json["sensor"] = scene.description.sensor.name;
  json["accuracy_grey"] = scene.accuracy_grey;
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : findings)
    json["findings"].push_back({{"severity", name_of(finding.severity)},
                                {"check", finding.check},
                                {"what", finding.what},
                                {"where", finding.where},
                                {"figure", finding.figure},
                                {"unit", finding.unit},
                                {"why", finding.why},
                                {"do", finding.remedy}});
  return json.dump(1) + "\n";
}

// Frames spread over the flight, refined as --accuracy of render does.
void add_unreached(const scenes::Scene& scene, Findings& findings) {
  const double share_grey = sampling_share_grey(scene.accuracy_grey);
  const renderer::FrameRenderer frames(scene.world,
                                       renderer::refined_sampling(scene.caster.chosen, share_grey),
                                       {}, renderer::effects_of(scene.plan, 0));
  double worst_grey = 0.0;
  int worst_frame = 0, missed = 0;
  const std::vector<int> chosen =
      spread_over(parse_frames("", scene.frame_count()), kFramesMeasured);
  for (const int frame : chosen) {
    const auto error = frames.render(scene.frame_pose(frame)).error;
    if (!error || error->reached) continue;
    ++missed;
    if (error->largest_grey() <= worst_grey) continue;
    worst_grey = error->largest_grey();
    worst_frame = frame;
  }
  if (missed == 0) return;
  findings.insert(
      std::find_if(findings.begin(), findings.end(),
                   [](const Finding& finding) { return finding.severity == Severity::note; }),
      {Severity::delicate, "accuracy-not-reached",
       fmt::format("{} of {} frames miss the {:.3g} grey levels that are for sampling, even at the "
                   "finest",
                   missed, chosen.size(), share_grey),
       fmt::format("frame {}", worst_frame), worst_grey, "grey levels",
       "What rays meet there is finer than 256 times the usual sampling resolves.",
       "Ask for less, or look for what is thinner than a ray."});
}

}  // namespace

int examine_scene(const DoctorOptions& options, const CommonOptions& common) {
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(options, problems);
  scenes::BuildOptions build;
  build.accuracy_grey = options.accuracy_grey;
  const std::unique_ptr<scenes::Scene> scene = scenes::build_scene(description, build, problems);
  if (!common.quiet) print_problems(problems.all());
  Findings findings = scenes::examine(*scene, problems.all());
  if (options.measure) add_unreached(*scene, findings);
  if (!options.json.empty()) core::write_file_atomically(options.json, json_text(*scene, findings));
  const auto count = [&](Severity severity) {
    return std::count_if(findings.begin(), findings.end(),
                         [&](const Finding& finding) { return finding.severity == severity; });
  };
  const auto wrong = count(Severity::wrong);
  fmt::print("{}{}{}: {} wrong, {} delicate, {} to note\n", table(findings),
             findings.empty() ? "" : "\n", description.name, wrong, count(Severity::delicate),
             count(Severity::note));
  return wrong > 0 ? kExitCompareFailed : kExitDone;
}

}  // namespace fanbeam::apps
