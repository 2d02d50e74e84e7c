// A scene that any program can drive: open it once, change conditions in milliseconds, ask for a
// frame at any pose.
//
//   core::ProblemList problems;
//   session::Session session(scene_folder, {.shipped = share}, problems);   // seconds
//   session.set(weather);                                                   // milliseconds
//   const renderer::Frame frame = session.render(pose, 0);                  // pictures
//
// Who reads watts opens with Setup::build.read.power: else noise and echoes that the display hides may
// be left out of them.
// Thread-safe throughout: any number of threads, or tasks of the caller's own oneTBB, render and set
// at once. A `set` publishes new conditions; frames under way keep those that they began with, and
// a frame depends on its conditions, pose and number alone: the bytes are those of a serial run.
// Nothing here prints, reads the environment, or limits other loops of the process.
//
// Errors: InputError with every problem, and then nothing has changed; E-REF for detections, obstacles
// and heights that the session was not opened for; core::Stopped when a token asks. What is
// neglected: docs/effects.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/errors.h"
#include "core/stop.h"
#include "renderer/frame.h"
#include "scenes/scene.h"
#include "session/conditions.h"

namespace fanbeam::session {

struct SamplingChoice;

struct Setup {
  std::filesystem::path shipped{};                    // holds scenes/, sensors/ and materials/
  std::vector<std::filesystem::path> data_folders{};  // in the order of preference
  std::filesystem::path sensor{};                     // instead of the scene's; empty to keep it
  // Wishes about effects, caster, accuracy; and what is read of frames beside their pictures, which
  // the plan must know: watts, labels, detections, obstacles (plan_for in products/products.h).
  scenes::BuildOptions build{};
  std::optional<bool> sample{};  // frames show one realisation; else as the scene says
  // The scene's time budget is measured when it is opened, where nothing else says how to sample: for
  // a second or some. Else it is for whoever has a clock.
  bool keeps_time_budget = false;
  std::uint64_t seed = 0;  // of everything random
  int threads = 0;         // at most so many for a frame; 0: as many as the caller's tasks have
  // Frames are wanted, not the scene for signals alone. Their powers have no range shift by own-ship
  // Doppler: a sensor that leaves it in (waveform.doppler_compensated) is refused, E-UNSUPPORTED.
  bool pictures = true;
};

class Session {
 public:
  // `scene` is a folder with scene.toml, or that file. Warnings stay in `problems`. A scene needs no
  // [trajectory] (scenes/flight_volume.h). E-UNSUPPORTED for wishes for effects of a draw where `sample`
  // is false.
  Session(const std::filesystem::path& scene, const Setup& setup, core::ProblemList& problems);
  // The same of a scene that was read, and perhaps changed; of `setup` without its folders and
  // sensor.
  Session(const scenes::SceneDescription& scene, const Setup& setup, core::ProblemList& problems);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Each gives the warnings that the same conditions in a scene's file would have.
  // Rain cells in local metres of the scene. The weather replaces the one before, all of it.
  core::ProblemList set(const atmosphere::Weather& weather);
  // What its weather left on the ground and on buildings.
  core::ProblemList set(materials::SurfaceState state);
  // What is not set goes back to the scene's own.
  core::ProblemList set(const SensorSettings& settings);
  // What is wrong with them by themselves and together; sets nothing.
  core::ProblemList problems_in(const SensorSettings& settings) const;
  // The scene's own targets are where it says but for those named; new ones stay until the next call.
  core::ProblemList set(std::span<const TargetState> targets);
  // What is wrong with each and with their names together; sets nothing.
  core::ProblemList problems_in(std::span<const TargetState> targets) const;
  // An accuracy is for effects left out as well, and stays for them until the next one.
  core::ProblemList set(const SamplingWish& wish);

  // `frame_index` keys what is random: live pictures count it up. A frame whose pose the plan was
  // not made for (scenes/frame_plan.h, planned_for) is made by a plan of its own and has the event
  // "outside_volume": tens of milliseconds more.
  renderer::Frame render(const core::Pose& pose, std::uint64_t frame_index,
                         const renderer::Products& wanted = {},
                         const core::StopToken& stop = core::StopScope::current()) const;
  // A frame of the scene's trajectory by `plan`: that of scene(), or of the frame
  // (scenes::frame_plan), with no `set` in between.
  renderer::Frame render_flown(int frame, const core::EffectPlan& plan,
                               const renderer::Products& wanted = {},
                               const core::StopToken& stop = core::StopScope::current()) const;

  // Conditions and sampling of now, for frames to be made under whatever is set meanwhile.
  struct Published;
  using Moment = std::shared_ptr<const Published>;
  Moment now() const;
  // Conditions that scene() told earlier, with the sampling of now.
  Moment moment(std::shared_ptr<const scenes::Scene> earlier) const;
  std::shared_ptr<const scenes::Scene> scene(const Moment& under) const;
  renderer::Sampling sampling(const Moment& under) const;
  renderer::Frame render(const Moment& under, const core::Pose& pose, std::uint64_t frame_index,
                         const renderer::Products& wanted = {},
                         const core::StopToken& stop = core::StopScope::current()) const;

  // The scene as it is now: plan, facts, sensor, trajectory. It stays as it is when conditions
  // change.
  std::shared_ptr<const scenes::Scene> scene() const;
  // The scene as it was before anything was set.
  std::shared_ptr<const scenes::Scene> opened() const;
  renderer::Sampling sampling() const;
  // Of that, as Samples takes them; 0 where every frame is refined to an accuracy.
  double samples() const;
  std::uint64_t seed() const;
  int threads() const;  // as it was opened, for what is made of its frames too

 private:
  struct Asked;
  void open(scenes::SceneDescription description, const Setup& setup, core::ProblemList& problems);
  // `as_before`: the scene stays as it is.
  core::ProblemList change(const std::function<void(Asked&)>& ask, bool as_before = false);
  SamplingChoice timed(const TimeBudget& budget) const;

  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace fanbeam::session
