#include "session/targets.h"

#include <cmath>
#include <set>
#include <string>

#include "core/spelling.h"
#include "core/text.h"
#include "scenes/objects.h"
#include "terrain/local_frame.h"

namespace fanbeam::session {
namespace {

using renderer::PointTarget;

// Boresight to the north of the scene, y to the left of it, z up.
const glm::dmat3 kNorth(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);

bool is_unit(const glm::dquat& q) {
  return std::abs(glm::dot(q, q) - 1.0) < 1e-3;  // false for what is not finite
}

void place(const scenes::Scene& scene, const TargetState& state, PointTarget& target) {
  target.path = {{0.0, scene.frame.to_local_m(state.position)}};
  if (state.q_NB) {
    const glm::dmat3 body = scene.frame.north_east_down_at(state.position) *
                            glm::mat3_cast(glm::normalize(*state.q_NB));
    target.axes = {body[0], -body[1], -body[2]};  // x ahead, y left, z up
  }
  if (state.rcs) target.rcs = *state.rcs;
  if (state.swerling) target.swerling = *state.swerling;
}

bool is_good(const TargetState& state, const std::string& field, core::ProblemList& problems) {
  const std::size_t before = problems.all().size();
  const auto tried = [&](const auto& check) {
    try {
      check();
    } catch (const core::InputError& error) {
      for (core::Problem problem : error.problems()) {
        if (!problem.field.starts_with(field)) problem.field = field + ": " + problem.field;
        problems.append({problem});
      }
    }
  };
  tried([&] { terrain::check_geodetic(state.position, field.c_str()); });
  if (state.rcs) tried([&] { materials::check_rcs_model(*state.rcs); });
  if (state.q_NB && !is_unit(*state.q_NB))
    problems.error(core::ErrorClass::range, {}, field + ".q_NB", "no attitude",
                   "a quaternion of length 1");
  return problems.all().size() == before;
}

}  // namespace

std::vector<PointTarget> placed_targets(const scenes::Scene& scene,
                                        std::span<const TargetState> states,
                                        core::ProblemList& problems) {
  std::vector<PointTarget> targets = scene.world.targets;
  const std::size_t own = targets.size();
  std::set<std::string> named;
  if (states.size() > scenes::kMostPointTargets) {
    problems.error(core::ErrorClass::limit, {}, "targets", std::to_string(states.size()),
                   "at most " + std::to_string(scenes::kMostPointTargets));
    return targets;
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const TargetState& state = states[i];
    const std::string field = "target[" + std::to_string(i) + "]";
    // It stands in tables and on terminals.
    if (state.name.empty() || !core::is_printable_text(state.name))
      problems.error(core::ErrorClass::range, {}, field + ".name", "\"" + state.name + "\"",
                     "a name of UTF-8 without control characters");
    if (!named.insert(state.name).second)
      problems.error(core::ErrorClass::ref, {}, field + ".name", "\"" + state.name + "\" again",
                     "every target once");
    const bool good = is_good(state, field, problems);
    bool found = false;
    for (std::size_t k = 0; k < own; ++k) {
      if (targets[k].name != state.name) continue;
      found = true;
      if (good) place(scene, state, targets[k]);
    }
    if (found) continue;
    if (!state.rcs) {
      std::vector<std::string> known;  // each once, in the scene's order
      std::set<std::string> told;
      for (const PointTarget& target : scene.world.targets)
        if (told.insert(target.name).second) known.push_back(target.name);
      problems.error(core::ErrorClass::ref, {}, field + ".name", "\"" + state.name + "\"",
                     "a target of the scene, or an rcs for a new one" +
                         core::names_there_text(state.name, known));
      continue;
    }
    if (!good) continue;
    targets.push_back({state.name, *state.rcs, {}, kNorth});
    place(scene, state, targets.back());
  }
  return targets;
}

}  // namespace fanbeam::session
