#include "session/session.h"

#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "core/number_range.h"
#include "core/parallel.h"
#include "renderer/plan/effects.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/planned_frames.h"
#include "scenes/frame_plan.h"
#include "scenes/scene_caster.h"
#include "scenes/scene_reader.h"
#include "session/products/products.h"
#include "session/sampling_choice.h"
#include "session/targets.h"

namespace fanbeam::session {
namespace {

renderer::Sampling sampling_of(const SamplingWish& wish, renderer::CasterKind caster) {
  if (const auto* sampling = std::get_if<renderer::Sampling>(&wish)) return *sampling;
  if (const auto* accuracy = std::get_if<Accuracy>(&wish))
    return renderer::refined_sampling(caster, renderer::sampling_share_grey(accuracy->grey_levels));
  const double per_cell = std::get<Samples>(wish).per_cell;
  return renderer::sampling_for(caster,
                                per_cell > 0.0 ? per_cell : renderer::default_samples(caster));
}

// What the scene's [accuracy] says unless the caller does; a time budget is for whoever has a clock.
SamplingWish wish_of(const scenes::SceneDescription& scene, const scenes::BuildOptions& build) {
  if (build.accuracy_grey > 0.0) return Accuracy{build.accuracy_grey};
  if (scene.accuracy_grey > 0.0 && !(scene.rays_per_cell > 0.0))
    return Accuracy{scene.accuracy_grey};
  return Samples{scene.rays_per_cell};
}

// The plan's bounds count on rays that give to no cell farther away than this.
void check_spread(const renderer::Sampling& sampling, core::ProblemList& problems) {
  if (!sampling.deposit_intervals || !(sampling.rays_per_cell > 0.0)) return;
  const double spread_cells = sampling.gap_cells / 2 * std::max(1.0, 1.0 / sampling.rays_per_cell);
  if (spread_cells > renderer::kSpreadCells * (1.0 + 1e-9))
    problems.error(core::ErrorClass::range, {}, "sampling.gap_cells",
                   core::number_text(sampling.gap_cells) + " with rays_per_cell " +
                       core::number_text(sampling.rays_per_cell),
                   "at most " +
                       core::number_text(2.0 * renderer::kSpreadCells *
                                         std::min(1.0, sampling.rays_per_cell)) +
                       ", so that a ray gives to cells up to two away");
}

void check(const renderer::Sampling& sampling, core::ProblemList& problems) {
  const auto within = [&](const char* field, double value, double low, double high) {
    core::check_range(problems, std::string("sampling.") + field, value, {low, high});
  };
  within("slices_per_sub_column", sampling.slices_per_sub_column, 1, 4096);
  within("sub_columns", sampling.sub_columns, 1, 4096);
  within("rays_per_cell", sampling.rays_per_cell, 0.01, 10000.0);
  within("refinement_depth", sampling.refinement_depth, 0, 16);
  within("gap_cells", sampling.gap_cells, 0.1, 1e6);
  check_spread(sampling, problems);
  within("largest_step_rad", sampling.largest_step_rad, 1e-6, 1.0);
  within("largest_step_rows", sampling.largest_step_rows, 0.01, 1e6);
  within("bounce_share", sampling.bounce_share, 0.01, 100.0);
  within("jittered_passes", sampling.jittered_passes, 0, 4096);
  within("target_grey", sampling.target_grey, 0.0, 100.0);
  // Jittered rays of all levels are the same ones: their difference tells no error.
  if (sampling.jittered_passes > 0 && (sampling.estimate_error || sampling.target_grey > 0.0))
    problems.error(
        core::ErrorClass::unsupported, {}, "sampling.jittered_passes",
        std::to_string(sampling.jittered_passes) + " with estimate_error or a target_grey above 0",
        "0, or neither of the two");
}

void check(const SamplingWish& wish, core::ProblemList& problems) {
  if (const auto* accuracy = std::get_if<Accuracy>(&wish)) {
    return core::check_range(problems, "accuracy", accuracy->grey_levels,
                             renderer::kAccuracies_grey, "grey levels");
  }
  if (const auto* sampling = std::get_if<renderer::Sampling>(&wish))
    return check(*sampling, problems);
  if (const auto* budget = std::get_if<TimeBudget>(&wish))
    return core::check_range(problems, "time budget", budget->ms, renderer::kTimeBudgets_ms, "ms");
  core::check_range(problems, "samples per cell", std::get<Samples>(wish).per_cell,
                    renderer::kSamplesOrDefault);
}

sensors::Sensor with_settings(sensors::Sensor sensor, const SensorSettings& settings,
                              core::ProblemList& problems) {
  if (settings.boresight_elevation_rad) {
    const double tilt_rad = *settings.boresight_elevation_rad;
    core::check_range(problems, "boresight_elevation_rad", tilt_rad,
                      {-core::kPi / 2, core::kPi / 2});
    sensor.display.cscope_top_rad += tilt_rad - sensor.antenna.boresight_elevation_rad;
    sensor.antenna.boresight_elevation_rad = tilt_rad;
  }
  if (settings.noise_figure) {
    core::check_range(problems, "noise_figure", *settings.noise_figure, {1.0, 1e6});
    sensor.receiver.noise_figure = *settings.noise_figure;
  }
  sensors::Display& display = sensor.display;
  sensor.scan.stabilised = settings.stabilised.value_or(sensor.scan.stabilised);
  display.cscope_mode = settings.cscope_mode.value_or(display.cscope_mode);
  if ((settings.low_dB || settings.high_dB) && display.mapping == sensors::Display::Mapping::seed)
    problems.error(core::ErrorClass::unsupported, {}, "low_dB, high_dB", "with mapping \"seed\"",
                   R"(mapping "stc" or "log"; "seed" has a window of its own)");
  constexpr core::NumberRange kLevels_dB = SensorSettings::kLevels_dB;
  if (settings.low_dB) core::check_range(problems, "low_dB", *settings.low_dB, kLevels_dB, "dB");
  if (settings.high_dB) core::check_range(problems, "high_dB", *settings.high_dB, kLevels_dB, "dB");
  display.low_dB = settings.low_dB.value_or(display.low_dB);
  display.high_dB = settings.high_dB.value_or(display.high_dB);
  if (kLevels_dB.holds(display.low_dB) && kLevels_dB.holds(display.high_dB) &&
      !(display.low_dB < display.high_dB))
    problems.error(core::ErrorClass::range, {}, "low_dB, high_dB",
                   core::number_text(display.low_dB) + ", " + core::number_text(display.high_dB),
                   "low_dB below high_dB");
  return sensor;
}

// Of what a frame itself may be asked for; its watts are whoever opened the session's to tell of.
void check(const renderer::Products& wanted, const scenes::Scene& scene) {
  scenes::BuildOptions needed;
  needed.heights_shown = show_heights(wanted);
  needed.read.detections = wanted.detections;
  needed.read.obstacles = wanted.obstacles;
  core::ProblemList problems;
  check_told(needed, scene.options, problems);
  problems.throw_if_errors();
}

// What a frame is made under.
class Work {
 public:
  Work(core::StopToken&&, int) = delete;  // which must outlive it
  Work(const core::StopToken& stop, int threads) : scope_(stop) {
    if (threads > 0) limit_.emplace(threads);
  }

 private:
  core::StopScope scope_;
  std::optional<core::ThreadLimit> limit_;
};

}  // namespace

// Immutable once published, but for renderers that are made when first asked for.
struct Session::Published {
  Published(std::shared_ptr<const scenes::Scene> of, const SamplingWish& wish, std::uint64_t seed)
      : scene(std::move(of)),
        sampling(sampling_of(wish, scene->caster.chosen)),
        frames(scene->world, sampling, seed) {}

  std::shared_ptr<const scenes::Scene> scene;
  renderer::Sampling sampling;
  mutable renderer::PlannedFrames frames;
};

// All that was ever set, of which a published scene is made.
struct Session::Asked {
  scenes::Conditions conditions;
  SamplingWish sampling;
  core::ProblemList problems;
};

struct Session::Inside {
  std::uint64_t seed = 0;
  int threads = 0;
  std::shared_ptr<const scenes::Scene> opened;
  std::mutex setting;  // one change after the other
  Asked asked;
  mutable std::mutex looking;
  std::shared_ptr<const Published> published;
};

Session::Session(const std::filesystem::path& scene, const Setup& setup,
                 core::ProblemList& problems)
    : inside_(std::make_unique<Inside>()) {
  open(scenes::read_scene(scene, {setup.shipped, setup.data_folders, setup.sensor}, problems),
       setup, problems);
}

Session::Session(const scenes::SceneDescription& scene, const Setup& setup,
                 core::ProblemList& problems)
    : inside_(std::make_unique<Inside>()) {
  open(scene, setup, problems);
}

void Session::open(scenes::SceneDescription description, const Setup& setup,
                   core::ProblemList& problems) {
  if (setup.build.accuracy_grey != 0.0) check(Accuracy{setup.build.accuracy_grey}, problems);
  if (setup.pictures && !description.sensor.waveform.doppler_compensated)
    problems.error(core::ErrorClass::unsupported, description.sensor.waveform.doppler_place,
                   "waveform.doppler_compensated", "false",
                   "true: pictures have no range shift by own-ship Doppler; fanbeam fmcw "
                   "--products bscope has");
  if (setup.sample) description.sample = *setup.sample;
  if (setup.sample && !*setup.sample) renderer::refuse_draws(setup.build.wishes, problems);
  inside_->seed = setup.seed;
  inside_->threads = setup.threads;
  inside_->opened = scenes::build_scene(description, setup.build, problems);
  inside_->asked.sampling = wish_of(description, setup.build);
  inside_->published =
      std::make_shared<const Published>(inside_->opened, inside_->asked.sampling, setup.seed);
  if (!setup.keeps_time_budget || !(description.time_budget_ms > 0.0) ||
      setup.build.accuracy_grey > 0.0)
    return;
  if (inside_->opened->frame_count() > 0)
    problems.append(set(TimeBudget{description.time_budget_ms}).all());
  else
    problems.warning("BUDGET", {}, "accuracy.time_budget_ms",
                     core::number_text(description.time_budget_ms),
                     "not kept: a scene without a trajectory has no poses to measure it at");
}

Session::~Session() = default;

Session::Moment Session::now() const {
  const std::lock_guard<std::mutex> lock(inside_->looking);
  return inside_->published;
}

Session::Moment Session::moment(std::shared_ptr<const scenes::Scene> earlier) const {
  const SamplingWish wish = [&] {
    const std::lock_guard<std::mutex> one(inside_->setting);
    return inside_->asked.sampling;
  }();
  return std::make_shared<const Published>(std::move(earlier), wish, inside_->seed);
}

std::shared_ptr<const scenes::Scene> Session::scene(const Moment& under) const {
  return under->scene;
}

renderer::Sampling Session::sampling(const Moment& under) const { return under->sampling; }

std::shared_ptr<const scenes::Scene> Session::scene() const { return now()->scene; }

std::shared_ptr<const scenes::Scene> Session::opened() const { return inside_->opened; }

renderer::Sampling Session::sampling() const { return now()->sampling; }

double Session::samples() const {
  const renderer::Sampling own = sampling();
  return own.target_grey > 0.0 ? 0.0 : samples_in(own);
}

std::uint64_t Session::seed() const { return inside_->seed; }

int Session::threads() const { return inside_->threads; }

core::ProblemList Session::change(const std::function<void(Asked&)>& ask, bool as_before) {
  const std::lock_guard<std::mutex> one(inside_->setting);
  Asked asked = inside_->asked;
  ask(asked);
  asked.problems.throw_if_errors();
  core::ProblemList warnings;
  std::shared_ptr<const scenes::Scene> scene =
      as_before ? now()->scene
                : scenes::under_conditions(*inside_->opened, asked.conditions, warnings);
  auto next = std::make_shared<const Published>(std::move(scene), asked.sampling, inside_->seed);
  inside_->asked = std::move(asked);
  const std::lock_guard<std::mutex> lock(inside_->looking);
  inside_->published = std::move(next);
  return warnings;
}

core::ProblemList Session::set(const atmosphere::Weather& weather) {
  return change([&](Asked& asked) { asked.conditions.weather = weather; });
}

core::ProblemList Session::set(materials::SurfaceState state) {
  return change([&](Asked& asked) { asked.conditions.surface_state = state; });
}

core::ProblemList Session::set(const SensorSettings& settings) {
  return change([&](Asked& asked) {
    asked.conditions.sensor =
        with_settings(inside_->opened->description.sensor, settings, asked.problems);
  });
}

core::ProblemList Session::problems_in(const SensorSettings& settings) const {
  core::ProblemList problems;
  with_settings(inside_->opened->description.sensor, settings, problems);
  return problems;
}

core::ProblemList Session::problems_in(std::span<const TargetState> targets) const {
  core::ProblemList problems;
  placed_targets(*inside_->opened, targets, problems);
  return problems;
}

core::ProblemList Session::set(std::span<const TargetState> targets) {
  return change([&](Asked& asked) {
    asked.conditions.targets = placed_targets(*inside_->opened, targets, asked.problems);
  });
}

// What a time budget comes to under the conditions of now.
SamplingChoice Session::timed(const TimeBudget& budget) const {
  const core::StopToken stop = core::StopScope::current();
  const Work work(stop, inside_->threads);
  const std::shared_ptr<const scenes::Scene> scene = now()->scene;
  if (scene->frame_count() == 0)
    core::throw_input_error(core::ErrorClass::ref, "time budget", "no trajectory",
                            "a scene with frames to time");
  std::vector<int> frames(static_cast<std::size_t>(scene->frame_count()));
  std::iota(frames.begin(), frames.end(), 0);
  const bool heights = scene->options.heights_shown;
  const SamplingRequest request = with_accuracy_of(
      scene->description,
      {.accuracy_grey = scene->options.accuracy_grey, .time_budget_ms = budget.ms});
  return choose_sampling(request, *scene, inside_->seed, {true, heights},
                         poses_to_time(*scene, frames));
}

core::ProblemList Session::set(const SamplingWish& wish) {
  if (const auto* budget = std::get_if<TimeBudget>(&wish)) {
    core::ProblemList problems;
    check(wish, problems);
    problems.throw_if_errors();
    const SamplingChoice choice = timed(*budget);
    // As samples: what is set later may change the caster.
    problems = set(Samples{choice.samples});
    if (!choice.fits)
      problems.warning("BUDGET", {}, "time budget", core::number_text(budget->ms) + " ms",
                       "the coarsest sampling there is, which takes " +
                           core::number_text(std::round(choice.slowest_ms * 10.0) / 10.0) + " ms");
    return problems;
  }
  const auto* accuracy = std::get_if<Accuracy>(&wish);
  const auto ask = [&](Asked& asked) {
    check(wish, asked.problems);
    asked.sampling = wish;
    if (accuracy != nullptr) asked.conditions.accuracy_grey = accuracy->grey_levels;
  };
  return change(ask, accuracy == nullptr);
}

renderer::Frame Session::render(const core::Pose& pose, std::uint64_t frame_index,
                                const renderer::Products& wanted,
                                const core::StopToken& stop) const {
  return render(now(), pose, frame_index, wanted, stop);
}

renderer::Frame Session::render(const Moment& under, const core::Pose& pose,
                                std::uint64_t frame_index, const renderer::Products& wanted,
                                const core::StopToken& stop) const {
  const Work work(stop, inside_->threads);
  check(wanted, *under->scene);
  renderer::FramePose at = under->scene->pose_at(pose);
  at.frame_index = frame_index;
  renderer::check(at);
  if (scenes::planned_for(*under->scene, at))
    return under->frames.render(under->scene->plan, wanted, at);
  const core::EffectPlan plan = scenes::plan_alone(*under->scene, at);
  const renderer::World world = scenes::world_for(*under->scene, plan);
  renderer::Frame frame = renderer::render_frame(world, under->sampling, wanted,
                                                 renderer::effects_of(plan, inside_->seed), at);
  frame.events.emplace_back("outside_volume");
  return frame;
}

renderer::Frame Session::render_flown(int frame, const core::EffectPlan& plan,
                                      const renderer::Products& wanted,
                                      const core::StopToken& stop) const {
  const Work work(stop, inside_->threads);
  const Moment under = now();
  check(wanted, *under->scene);
  return under->frames.render(plan, wanted, under->scene->frame_pose(frame));
}

}  // namespace fanbeam::session
