// Weather, targets and sampling: milliseconds each, and nothing changed where one is refused.
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/c/arguments.h"
#include "bindings/c/handle.h"
#include "bindings/c/last_call.h"
#include "renderer/casting/sampling.h"
#include "scenes/objects.h"

using namespace fanbeam;
using bindings::Arguments;
using bindings::kOpened;

namespace {

void check_weather(const fanbeam_weather& weather, Arguments& arguments) {
  arguments.bits(weather.given, FANBEAM_VISIBILITY | FANBEAM_NO_FOG | FANBEAM_RAIN_RATE,
                 "weather.given", "FANBEAM_VISIBILITY, FANBEAM_NO_FOG, FANBEAM_RAIN_RATE");
  const bool fog = (weather.given & FANBEAM_VISIBILITY) != 0;
  if (fog) arguments.number(weather.visibility_m, "weather.visibility_m", {10.0, 100000.0}, "m");
  if (fog && (weather.given & FANBEAM_NO_FOG) != 0)
    arguments.refuse(core::ErrorClass::range, "weather.given",
                     "FANBEAM_VISIBILITY and FANBEAM_NO_FOG", "one of the two");
  if ((weather.given & FANBEAM_RAIN_RATE) != 0)
    arguments.number(weather.rain_rate_mm_per_h, "weather.rain_rate_mm_per_h", {0.0, 300.0},
                     "mm/h");
}

void check_target(const fanbeam_target& target, const std::string& name, Arguments& arguments) {
  arguments.bits(target.given, FANBEAM_ATTITUDE | FANBEAM_RCS, name + ".given",
                 "FANBEAM_ATTITUDE, FANBEAM_RCS");
  if (arguments.there(target.name, name + ".name", "a text") && *target.name == '\0')
    arguments.refuse(core::ErrorClass::ref, name + ".name", "\"\"", "a name");
  bindings::check_place(arguments, name, target.latitude_rad, target.longitude_rad,
                        target.height_m);
  if ((target.given & FANBEAM_ATTITUDE) != 0)
    bindings::check_attitude(arguments, name, target.roll_rad, target.pitch_rad,
                             target.heading_rad);
  if ((target.given & FANBEAM_RCS) != 0)
    arguments.number(target.rcs_m2, name + ".rcs_m2", {0.0, 1.0e9}, "m2");
}

// Of one that is not `right`, which is told of it, the name and what nothing is wrong with.
session::TargetState state_of(const fanbeam_target& target, bool right) {
  session::TargetState state;
  state.name = bindings::text_of(target.name);
  if (!right) {
    if ((target.given & FANBEAM_RCS) != 0) state.rcs = materials::ConstantRcs{0.0};
    return state;
  }
  state.position = {target.latitude_rad, target.longitude_rad, target.height_m};
  if ((target.given & FANBEAM_ATTITUDE) != 0)
    state.q_NB = core::quaternion_from({target.roll_rad, target.pitch_rad, target.heading_rad});
  if ((target.given & FANBEAM_RCS) != 0) state.rcs = materials::ConstantRcs{target.rcs_m2};
  return state;
}

// Where the state before had an attitude or an rcs and this one has not, they stay.
void complete(session::TargetState& state, const session::TargetState& before) {
  if (!state.q_NB) state.q_NB = before.q_NB;
  if (!state.rcs) state.rcs = before.rcs;
}

void complete(std::vector<session::TargetState>& states,
              const std::vector<session::TargetState>& all_before) {
  std::map<std::string_view, const session::TargetState*> told;
  for (const session::TargetState& before : all_before) told.emplace(before.name, &before);
  for (session::TargetState& state : states)
    if (const auto before = told.find(state.name); before != told.end())
      complete(state, *before->second);
}

// Its index.
std::size_t merge(session::TargetState state, std::vector<session::TargetState>& states) {
  const auto before = std::find_if(states.begin(), states.end(),
                                   [&](const auto& known) { return known.name == state.name; });
  if (before == states.end()) {
    states.push_back(std::move(state));
    return states.size() - 1;
  }
  complete(state, *before);
  *before = std::move(state);
  return static_cast<std::size_t>(before - states.begin());
}

// What the session calls `theirs`, "target[2]", is the caller's `ours`.
std::vector<core::Problem> in_words_of_caller(std::vector<core::Problem> problems,
                                              const std::string& theirs, const std::string& ours) {
  for (core::Problem& problem : problems)
    if (problem.field.starts_with(theirs)) problem.field.replace(0, theirs.size(), ours);
  return problems;
}

// Of a field that `arguments` tell of nothing more is said.
void add_untold(const std::vector<core::Problem>& problems, Arguments& arguments) {
  const std::vector<core::Problem> told = arguments.problems().all();
  for (const core::Problem& problem : problems) {
    if (std::none_of(told.begin(), told.end(),
                     [&](const auto& before) { return before.field == problem.field; }))
      arguments.problems().append({problem});
  }
}

// The caller holds handle.changing. Of the targets one is given by the caller, or all are. What the
// session refuses is told beside what `arguments` do.
void put(fanbeam_session& handle, std::vector<session::TargetState> states, Arguments& arguments,
         const std::string& theirs, const std::string& ours) {
  const std::span<const session::TargetState> all(states);
  if (arguments.problems().has_errors())
    add_untold(in_words_of_caller(handle.held.problems_in(all).all(), theirs, ours), arguments);
  arguments.done();
  core::ProblemList warnings;
  try {
    warnings = handle.held.set(all);
  } catch (const core::InputError& error) {
    throw core::InputError(in_words_of_caller(error.problems(), theirs, ours));
  }
  handle.targets = std::move(states);
  bindings::tell_warnings(warnings);
}

}  // namespace

extern "C" {

fanbeam_status fanbeam_set_weather(fanbeam_session* session,
                                   const fanbeam_weather* weather) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    if (arguments.sized(weather, "weather")) check_weather(*weather, arguments);
    arguments.done();
    const std::lock_guard<std::mutex> one(session->changing);
    atmosphere::Weather next = session->held.scene()->weather;
    if ((weather->given & (FANBEAM_VISIBILITY | FANBEAM_NO_FOG)) != 0) {
      next.visibility_m.reset();
      next.liquid_water_g_per_m3.reset();
    }
    if ((weather->given & FANBEAM_VISIBILITY) != 0) next.visibility_m = weather->visibility_m;
    if ((weather->given & FANBEAM_RAIN_RATE) != 0)
      next.rain_rate_mm_per_h = weather->rain_rate_mm_per_h;
    bindings::tell_warnings(session->held.set(next));
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_set_target(fanbeam_session* session, const fanbeam_target* target) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    const bool opened = arguments.there(session, "session", kOpened);
    const bool sized = arguments.sized(target, "target");
    if (sized) check_target(*target, "target", arguments);
    if (!opened || !sized) arguments.done();
    const std::lock_guard<std::mutex> one(session->changing);
    std::vector<session::TargetState> states = session->targets;
    const bool right = !arguments.problems().has_errors();
    const std::size_t index = merge(state_of(*target, right), states);
    put(*session, std::move(states), arguments, "target[" + std::to_string(index) + "]", "target");
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_set_targets(fanbeam_session* session, const fanbeam_target* targets,
                                   size_t count) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    if (count > 0) arguments.there(targets, "targets", "as many as `count`");
    arguments.done();
    if (count > scenes::kMostPointTargets)
      arguments.refuse(core::ErrorClass::limit, "count", std::to_string(count),
                       "at most " + std::to_string(scenes::kMostPointTargets));
    arguments.done();
    std::vector<session::TargetState> states;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = "targets[" + std::to_string(i) + "]";
      // Those behind one of another size lie elsewhere than this loop looks.
      if (!arguments.sized(targets + i, name)) break;
      const std::size_t before = arguments.problems().errors();
      check_target(targets[i], name, arguments);
      states.push_back(state_of(targets[i], arguments.problems().errors() == before));
    }
    const std::lock_guard<std::mutex> one(session->changing);
    complete(states, session->targets);
    put(*session, std::move(states), arguments, "target[", "targets[");
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_set_samples(fanbeam_session* session, double samples_per_cell) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    arguments.number(samples_per_cell, "samples_per_cell", renderer::kSamplesOrDefault);
    arguments.done();
    bindings::tell_warnings(session->held.set(session::Samples{samples_per_cell}));
    return FANBEAM_OK;
  });
}

}  // extern "C"
