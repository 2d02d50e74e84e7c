// fanbeam doctor: what makes a scene numerically delicate, and what to do about it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/scene_choice.h"
#include "apps/text_table.h"
#include "core/files.h"
#include "core/text.h"
#include "core/units.h"
#include "renderer/frame_renderer.h"
#include "renderer/plan/effects.h"
#include "renderer/plan/plan.h"
#include "scenes/doctor/approach.h"
#include "scenes/doctor/scene_doctor.h"
#include "scenes/scene.h"
#include "session/blank_pictures.h"
#include "session/frame_choice.h"
#include "session/session.h"
#include "session/version.h"

namespace fanbeam::apps {
namespace {

using scenes::Finding;
using scenes::Findings;
using scenes::Severity;

struct DoctorOptions : SceneChoice {
  std::string json;            // file to write as well; empty for none
  double accuracy_grey = 0.0;  // 0: the scene's, else the default
  bool measure = false;        // refine frames to see whether the accuracy can be reached
};

CLI::App& declare_doctor(CLI::App& program, DoctorOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "doctor", "Tell what makes a scene numerically delicate, why it matters and what to do");
  add_scene_choice(command, options);
  add_file(command, "--json", options.json, "Write the findings to this file as well");
  add_accuracy_option(
      command, options.accuracy_grey,
      "Grey levels that will be asked for: is that possible? (default: the scene's, else " +
          core::number_text(scenes::kDefaultAccuracy_grey) + ")");
  command.add_flag("--measure", options.measure,
                   "Refine three frames to the accuracy as well and tell where it is not reached; "
                   "takes up to minutes");
  return command;
}

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
      text += beside(fmt::format("          {:<6} ", label), core::printable_text(*words));
  }
  return text;
}

std::string approach_text(const scenes::Approach& approach) {
  const std::string where =
      approach.passes_threshold
          ? fmt::format("{:.1f} m over the threshold", approach.height_m)
          : fmt::format("ends {:.0f} m before the threshold, {:.1f} m over it",
                        approach.before_threshold_m, approach.height_m);
  return beside(
      "approach  ",
      fmt::format("runway {}: {}, {:.1f} m {} of the centre line; glide angle {:.2f} deg, "
                  "fitted from {:.1f} km to {:.1f} km before the threshold",
                  approach.runway, where, std::abs(approach.right_m),
                  approach.right_m < 0.0 ? "left" : "right", core::degrees(approach.glide_path_rad),
                  approach.fitted_from_m / 1e3, approach.fitted_to_m / 1e3));
}

nlohmann::ordered_json approach_json(const std::optional<scenes::Approach>& approach) {
  if (!approach) return nullptr;
  return {{"runway", approach->runway},
          {"passes_threshold", approach->passes_threshold},
          {"before_threshold_m", approach->before_threshold_m},
          {"height_over_threshold_m", approach->height_m},
          {"right_of_centre_line_m", approach->right_m},
          {"glide_angle_deg", core::degrees(approach->glide_path_rad)},
          {"fitted_from_m", approach->fitted_from_m},
          {"fitted_to_m", approach->fitted_to_m}};
}

std::string json_text(const scenes::Scene& scene, const std::optional<scenes::Approach>& approach,
                      const Findings& findings) {
  nlohmann::ordered_json json;
  json["version"] = session::version_text();
  json["commit"] = session::commit_text();
  json["scene"] = scene.description.name;
  json["sensor"] = scene.description.sensor.name;
  json["accuracy_grey"] = scene.accuracy_grey;
  json["approach"] = approach_json(approach);
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
  if (scene.frame_count() == 0) return;
  const double share_grey = renderer::sampling_share_grey(scene.accuracy_grey);
  const renderer::FrameRenderer frames(scene.world,
                                       renderer::refined_sampling(scene.caster.chosen, share_grey),
                                       {}, renderer::effects_of(scene.plan, 0));
  double worst_grey = 0.0;
  int worst_frame = 0, missed = 0;
  const std::vector<int> chosen =
      session::spread_over(session::parse_frames("", scene.frame_count()), kFramesMeasured);
  for (const int frame : chosen) {
    const auto error = frames.render(scene.frame_pose(frame)).error;
    if (!error || error->reached) continue;
    ++missed;
    if (error->largest_grey() <= worst_grey) continue;
    worst_grey = error->largest_grey();
    worst_frame = frame;
  }
  if (missed == 0) return;
  scenes::add_in_order(
      findings,
      {Severity::delicate, "accuracy-not-reached",
       fmt::format("{} of {} frames miss the {:.3g} grey levels that are for sampling, even at the "
                   "finest",
                   missed, chosen.size(), share_grey),
       fmt::format("frame {}", worst_frame), worst_grey, "grey levels",
       "What rays meet there is finer than 256 times the usual sampling resolves.",
       "Ask for less, or look for what is thinner than a ray."});
}

// Writes the findings as a table to standard output. kExitDone when none is worse than delicate, else
// kExitCompareFailed.
int examine_scene(const DoctorOptions& options, const CommonOptions& common) {
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(options, problems);
  scenes::BuildOptions build;
  build.accuracy_grey = options.accuracy_grey;
  const auto scene =
      session::Session(description, {.build = build, .pictures = false}, problems).scene();
  refuse_output_among(files_of_scene(options, scene->description), options.json, "--json");
  if (!common.quiet) print_problems(problems.all());
  Findings findings = scenes::examine(*scene, problems.all());
  session::add_blank_pictures(*scene, findings);
  if (options.measure) add_unreached(*scene, findings);
  const std::optional<scenes::Approach> approach = scenes::approach_of(*scene);
  if (!options.json.empty())
    core::write_file_atomically(options.json, json_text(*scene, approach, findings));
  const auto count = [&](Severity severity) {
    return std::count_if(findings.begin(), findings.end(),
                         [&](const Finding& finding) { return finding.severity == severity; });
  };
  const auto wrong = count(Severity::wrong);
  if (approach) fmt::print("{}\n", approach_text(*approach));
  fmt::print("{}{}{}: {} wrong, {} delicate, {} to note\n", table(findings),
             findings.empty() ? "" : "\n", description.name, wrong, count(Severity::delicate),
             count(Severity::note));
  return wrong > 0 ? kExitCompareFailed : kExitDone;
}

}  // namespace

void add_doctor(CommandLine& line) { line.add(declare_doctor, examine_scene); }

}  // namespace fanbeam::apps
