#include "renderer/frame_renderer.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/parallel.h"
#include "core/random.h"
#include "renderer/accuracy/refinement.h"
#include "renderer/casting/profile/profile_caster.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/stages/antenna_image.h"
#include "renderer/stages/bounce_fan.h"
#include "renderer/stages/double_bounce.h"
#include "renderer/stages/fluctuation.h"
#include "renderer/stages/point_targets.h"
#include "renderer/stages/rain_echo.h"
#include "renderer/stages/range_response.h"
#include "sensors/display/display.h"
#include "sensors/receiver/point_response.h"
#include "sensors/receiver/receiver_figures.h"
#include "sensors/shadow/shadow_cscope.h"

namespace fanbeam::renderer {
namespace {

std::unique_ptr<Caster> make_caster(const World& world, const Sampling& sampling) {
  if (sampling.caster == CasterKind::profile)
    return std::make_unique<ProfileCaster>(world, sampling);
  return std::make_unique<RayCaster>(world, sampling);
}

std::vector<double> plus(const std::vector<double>& values, double constant) {
  std::vector<double> result(values);
  for (double& value : result) value += constant;
  return result;
}

}  // namespace

// From a pose to pictures; const, so that any number of threads may use it.
class FrameRenderer::Stages {
 public:
  Stages(const World& world, const Sampling& sampling, const Products& products,
         const Effects& effects, std::unique_ptr<Caster> caster)
      : world_(world),
        sampling_(sampling),
        products_(products),
        effects_(effects),
        caster_(std::move(caster)),
        double_bounce_(effects.runs(core::EffectId::double_bounce)
                           ? std::make_unique<DoubleBounce>(
                                 world, sampling, effects.runs(core::EffectId::thermal_noise))
                           : nullptr),
        range_response_(effects.runs(core::EffectId::range_response) &&
                                sensors::has_point_response(world.sensor)
                            ? std::make_unique<RangeResponse>(world.sensor)
                            : nullptr),
        ground_truth_(products.layers || products.cscope_layers
                          ? std::make_unique<GroundTruth>(world)
                          : nullptr),
        threshold_W_(products.detections ? sensors::detection_threshold_W(world.sensor) : 0.0) {
    if (products.cscope_layers && !shows_elevation())
      core::throw_input_error(
          core::ErrorClass::unsupported, "C-scope layers, which labels and cscope_masks need too",
          "of a C-scope that draws no elevations", "cscope_mode = \"true_elevation\"");
  }

  Frame render(const FramePose& pose) const;

 private:
  bool wants_layers() const { return ground_truth_ != nullptr; }
  bool shows_elevation() const {
    return world_.sensor.display.cscope_mode == sensors::Display::CScopeMode::true_elevation;
  }
  struct Images {
    std::vector<double> bscope_W, cscope_W_m3;
  };
  Images images_of(const FanSums& sums, bool with_cscope) const;
  Images images_of(const BounceFan& bounces, bool with_cscope) const;
  bool rains() const { return effects_.runs(core::EffectId::rain_echo) && world_.volume_echo; }
  // Last: sums are added in one order, with an estimate and without.
  void add_rain(const sensors::AntennaFrame& antenna, FanSums& sums) const;
  // `bounced`, unless null, receives what double bounces add.
  std::optional<ErrorEstimate> cast(const sensors::AntennaFrame& antenna, bool with_cscope,
                                    FanSums& sums, SightLines& sight, BounceFan* bounced) const;
  void add_layers(const sensors::AntennaFrame& antenna, const std::vector<core::Echo>& echoes,
                  const BounceFan* bounced, Frame& frame) const;
  void receive(const std::vector<core::Echo>& echoes, std::uint64_t frame_index,
               Frame& frame) const;
  void display(double height_above_ground_m, Frame& frame) const;

  const World& world_;
  Sampling sampling_;
  Products products_;
  Effects effects_;
  std::unique_ptr<Caster> caster_;
  std::unique_ptr<DoubleBounce> double_bounce_;  // when that effect is on
  std::unique_ptr<RangeResponse> range_response_;
  std::unique_ptr<GroundTruth> ground_truth_;  // when its layers are wanted
  double threshold_W_ = 0.0;                   // of detections
};

FrameRenderer::FrameRenderer(const World& world, const Sampling& sampling, const Products& products,
                             const Effects& effects)
    : FrameRenderer(world, sampling, products, effects, make_caster(world, sampling)) {}

FrameRenderer::FrameRenderer(const World& world, const Sampling& sampling, const Products& products,
                             const Effects& effects, std::unique_ptr<Caster> caster)
    : stages_(std::make_unique<Stages>(world, sampling, products, effects, std::move(caster))) {}

FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;
FrameRenderer::~FrameRenderer() = default;

Frame FrameRenderer::render(const FramePose& pose) const { return stages_->render(pose); }

Frame render_frame(const World& world, const Sampling& sampling, const Products& products,
                   const Effects& effects, const FramePose& pose) {
  return FrameRenderer(world, sampling, products, effects).render(pose);
}

std::vector<double> Frame::received_W() const { return plus(bscope_W, noise_W); }

Frame FrameRenderer::Stages::render(const FramePose& pose) const {
  check(pose);
  const sensors::Sensor& sensor = world_.sensor;
  const sensors::AntennaFrame antenna = antenna_of(sensor, pose);
  const bool elevation_resolved =
      (products_.cscope || products_.cscope_layers) && shows_elevation();
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  Frame frame;
  frame.bscope_W.assign(columns * static_cast<std::size_t>(sensor.range.cells), 0.0);
  if (elevation_resolved)
    frame.cscope_W_m3.assign(columns * static_cast<std::size_t>(sensor.display.cscope_rows), 0.0);

  const double height_above_ground_m = world_.surfaces().height_above_ground_m(antenna.position_m);
  if (world_.surfaces().in_ground(antenna.position_m)) {
    frame.events.emplace_back("below_terrain");
    if (wants_layers()) frame.layers = empty_layers(sensor, products_.cscope_layers);
    receive({}, pose.frame_index, frame);
    display(height_above_ground_m, frame);
    return frame;
  }
  if (products_.cscope && !shows_elevation() && height_above_ground_m <= 0.0)
    frame.events.emplace_back("below_terrain");
  // Kept by the calling thread: fresh pages for megabytes of sums would cost a tenth of a frame.
  thread_local FanSums sums;
  const TargetEchoes targets = unobstructed_echoes(world_, antenna, pose.time_s);
  SightLines sight = sight_lines(world_, targets.echoes, pose.time_s);
  thread_local BounceFan bounces;
  BounceFan* const bounced = wants_layers() && double_bounce_ ? &bounces : nullptr;
  frame.error = cast(antenna, elevation_resolved, sums, sight, bounced);
  frame.rays = sums.rays;
  frame.slices = sums.slices;
  frame.blanked = sums.blanked;
  frame.unprojected = targets.unprojected;
  Images images = images_of(sums, elevation_resolved);
  frame.bscope_W = std::move(images.bscope_W);
  frame.cscope_W_m3 = std::move(images.cscope_W_m3);
  // Phases mean something in a realisation only: ground_multipath.h.
  const Multipath multipath = !effects_.runs(core::EffectId::multipath) ? Multipath::none
                              : effects_.runs(core::EffectId::speckle)  ? Multipath::coherent
                                                                        : Multipath::mean;
  const std::vector<core::Echo> echoes =
      seen_echoes(world_, antenna, targets.echoes, sight, multipath);
  if (wants_layers()) add_layers(antenna, echoes, bounced, frame);
  receive(echoes, pose.frame_index, frame);
  if (sums.hits == 0 && echoes.empty()) frame.events.emplace_back("empty_view");
  display(height_above_ground_m, frame);
  return frame;
}

FrameRenderer::Stages::Images FrameRenderer::Stages::images_of(const FanSums& sums,
                                                               bool with_cscope) const {
  const auto image = [&](const std::vector<double>& bins, int count) {
    return through_antenna(bins, count, sums, world_.sensor, sampling_.sub_columns);
  };
  Images images;
  images.bscope_W = image(sums.range_W_per_rad, sums.cells);
  if (with_cscope) images.cscope_W_m3 = image(sums.elevation_W_m3_per_rad, sums.rows);
  return images;
}

FrameRenderer::Stages::Images FrameRenderer::Stages::images_of(const BounceFan& bounces,
                                                               bool with_cscope) const {
  const FanSums& sums = bounces.sums();
  const auto image = [&](const std::vector<double>& bins, int count, const FilledBlocks& filled) {
    return through_antenna(bins, count, sums, world_.sensor, sampling_.sub_columns, &filled);
  };
  Images images;
  images.bscope_W = image(sums.range_W_per_rad, sums.cells, bounces.ranges());
  if (with_cscope)
    images.cscope_W_m3 = image(sums.elevation_W_m3_per_rad, sums.rows, bounces.rows());
  return images;
}

void FrameRenderer::Stages::add_rain(const sensors::AntennaFrame& antenna, FanSums& sums) const {
  if (rains()) add_rain_echo(world_, antenna, sampling_.sub_columns, sums);
}

std::optional<ErrorEstimate> FrameRenderer::Stages::cast(const sensors::AntennaFrame& antenna,
                                                         bool with_cscope, FanSums& sums,
                                                         SightLines& sight,
                                                         BounceFan* bounced) const {
  if (!(sampling_.target_grey > 0.0) && !sampling_.estimate_error) {
    caster_->cast(antenna, with_cscope, CastPass{}, sums, sight);
    if (double_bounce_) double_bounce_->add(antenna, 0, sums, bounced);
    add_rain(antenna, sums);
    return std::nullopt;
  }
  const ErrorEstimate error = Refinement(world_, sampling_, *caster_, double_bounce_.get(),
                                         effects_, products_.cscope && !shows_elevation())
                                  .cast(antenna, with_cscope, sums, sight, bounced);
  add_rain(antenna, sums);
  return error;
}

// Before targets and the receiver join the powers of `frame`.
void FrameRenderer::Stages::add_layers(const sensors::AntennaFrame& antenna,
                                       const std::vector<core::Echo>& echoes,
                                       const BounceFan* bounced, Frame& frame) const {
  frame.layers = ground_truth_->of(antenna, echoes, products_.cscope_layers);
  const Images bounces =
      bounced != nullptr ? images_of(*bounced, products_.cscope_layers) : Images{};
  const auto share = [](const std::vector<double>& part, const std::vector<double>& total) {
    return part.empty() ? std::vector<float>(total.size()) : share_of(part, total);
  };
  core::parallel_for(products_.cscope_layers ? 2 : 1, [&](std::size_t scope) {
    if (scope == 0)
      frame.layers->bscope.double_bounce = share(bounces.bscope_W, frame.bscope_W);
    else
      frame.layers->cscope.double_bounce = share(bounces.cscope_W_m3, frame.cscope_W_m3);
  });
}

// The last stage before display: targets join the diffuse power, expected or as one realisation.
void FrameRenderer::Stages::receive(const std::vector<core::Echo>& echoes,
                                    std::uint64_t frame_index, Frame& frame) const {
  const sensors::Sensor& sensor = world_.sensor;
  if (!effects_.runs(core::EffectId::speckle) && !effects_.runs(core::EffectId::swerling)) {
    add_echoes(echoes, sensor, frame.bscope_W, frame.cscope_W_m3);
    if (range_response_) range_response_->apply(frame.bscope_W);
    return;
  }
  const Fluctuation fluctuation{effects_.runs(core::EffectId::speckle),
                                effects_.runs(core::EffectId::swerling), sensor.receiver.looks,
                                effects_.seed, frame_index};
  std::vector<core::Swerling> cases;
  for (const PointTarget& target : world_.targets) cases.push_back(target.swerling);
  const bool noisy = effects_.runs(core::EffectId::thermal_noise);
  std::vector<TargetShare> targets = bscope_shares(echoes, sensor);
  if (range_response_) {
    range_response_->apply(frame.bscope_W);
    targets = range_response_->spread(targets, frame.bscope_W);
  }
  realise(std::move(targets), cases, fluctuation, core::kStreamSpeckle,
          noisy ? sensor.noise_power_W() : 0.0, sensor.scan.columns, frame.bscope_W);
  if (!frame.cscope_W_m3.empty())
    realise(cscope_shares(echoes, sensor), cases, fluctuation, core::kStreamCscopeSpeckle,
            noisy ? sensors::cscope_noise_W_m3(sensor) : 0.0, sensor.scan.columns,
            frame.cscope_W_m3);
}

void FrameRenderer::Stages::display(double height_above_ground_m, Frame& frame) const {
  const sensors::Sensor& sensor = world_.sensor;
  const bool mean_noise =
      effects_.runs(core::EffectId::thermal_noise) && !effects_.runs(core::EffectId::speckle);
  frame.noise_W = mean_noise ? sensor.noise_power_W() : 0.0;
  const std::vector<double> received_W = frame.received_W();
  if (products_.bscope) frame.bscope_grey = sensors::bscope_grey(sensor, received_W);
  if (products_.detections) frame.detections = above_threshold(sensor, threshold_W_, received_W);
  const bool above = height_above_ground_m > 0.0;
  using Mode = sensors::Display::CScopeMode;
  const Mode mode = sensor.display.cscope_mode;
  if (above && (products_.obstacles || (products_.cscope && mode == Mode::shadow)))
    frame.obstacles = sensors::shadow_obstacles(sensor, received_W, height_above_ground_m);
  if (!products_.cscope) return;
  if (mode != Mode::true_elevation) {
    // In mode flat_earth nothing is raised.
    const auto raised =
        mode == Mode::shadow ? frame.obstacles : std::vector<sensors::ShadowObstacle>{};
    frame.cscope_W_m3 =
        above ? sensors::shadow_cscope_W_m3(sensor, received_W, height_above_ground_m, raised)
              : std::vector<double>(static_cast<std::size_t>(sensor.display.cscope_rows) *
                                        static_cast<std::size_t>(sensor.scan.columns),
                                    0.0);
    frame.cscope_grey = sensors::cscope_grey(sensor, frame.cscope_W_m3);
    return;
  }
  const double noise_W_m3 = mean_noise ? sensors::cscope_noise_W_m3(sensor) : 0.0;
  frame.cscope_grey = sensors::cscope_grey(sensor, plus(frame.cscope_W_m3, noise_W_m3));
}

}  // namespace fanbeam::renderer
