// The plan of a single frame: what of the sequence's plan it can go without.
//
// On request; a sequence is planned once by default, so that all its frames go through the same
// stages. Rendering a frame by its plan changes its pixels by at most
// half of the accuracy asked for, so nothing is seen to switch (renderer::frame_plan).
#pragma once

#include "core/effect_plan.h"
#include "renderer/plan/scene_facts.h"
#include "scenes/scene.h"

namespace fanbeam::scenes {

// Pure functions of the scene and the frame's pose, in any order and from any thread.
renderer::SceneFacts frame_facts(const Scene& scene, int frame_index);
core::EffectPlan frame_plan(const Scene& scene, int frame_index);

// Whether the scene's plan holds at a pose: inside a stated flight volume, or, where the plan was
// made for the frames of a flight, wherever nothing is seen that those frames do not see, at their
// heights, and verticals turn no more than the bounds of the losses count on. Up to two milliseconds in a large scene.
bool planned_for(const Scene& scene, const renderer::FramePose& pose);
// The plan of a frame at any other pose: of all that the scene has, with that pose in its volume.
core::EffectPlan plan_alone(const Scene& scene, const renderer::FramePose& pose);

}  // namespace fanbeam::scenes
