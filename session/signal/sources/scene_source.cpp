#include <set>

#include "scenes/scene.h"
#include "session/frame_choice.h"
#include "session/signal/chain.h"
#include "session/signal/paths.h"
#include "session/signal/radar_file.h"
#include "session/signal/signal_session.h"
#include "session/signal/sources/measured_source.h"

namespace fanbeam::session {
namespace {

class SceneSource : public MeasuredSource {
 public:
  SceneSource(const scenes::SceneDescription& description, const std::filesystem::path& asked,
              const SourceSettings& asked_of, core::ProblemList& problems)
      : asked_(asked_of) {
    const std::filesystem::path file = asked.empty() ? description.signal_file : asked;
    settings_.seed = asked_.seed;
    if (!file.empty()) read_radar_file(file, settings_, problems);
    problems.throw_if_errors();
    scene_ = Session(description, signal_setup(), problems).scene();
    warnings = problems.all();
    const sensors::Sensor& sensor = scene_->description.sensor;
    const auto radar = [&] {
      FmcwRadar made = fmcw_radar(settings_, sensor);
      check_detects(made);
      return made;
    };
    radar_ = file.empty() ? radar() : radar_in_file(file, radar);
    indices_ = parse_frames(asked_.frames.empty() ? "0:" : asked_.frames, scene_->frame_count());
    name = scene_->description.name;
    kind = "scene";
    const int step = indices_.size() > 1 ? indices_[1] - indices_[0] : 1;
    frame_s = step / sensor.scan.frame_rate_Hz;
    most_range_m = sensor.range.maximum_m();
    set_radar(radar_);
    radar_velocity_mps = velocity_at(indices_.front());
  }
  int frames() const override { return static_cast<int>(indices_.size()); }

  MeasuredFrame frame(int number) override {
    const int index = indices_[static_cast<std::size_t>(number)];
    const FmcwPaths paths = fmcw_paths(*scene_, index, settings_);
    const FmcwFrame found = fmcw_frame(radar_, *scene_, paths, index, settings_, {"detections"});
    if (!folding_told_ && !found.warnings.empty()) {
      warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
      folding_told_ = true;
    }
    const DetectedFrame made{time_of(index), found.found->detections, found.found->clusters};
    MeasuredFrame frame{made.time_s,
                        velocity_at(index),
                        made.detections.size(),
                        measurements_of(made, &radar_, asked_.errors),
                        {}};
    std::set<std::uint32_t> seen;
    for (const core::Echo& echo : paths.targets) {
      if (!seen.insert(echo.object_id).second) continue;  // the direct way is before the mirrored
      const double elevation_rad = tells_elevation(radar_) ? echo.elevation_rad : 0.0;
      frame.targets.push_back(
          {scene_->world.targets[echo.object_id].name, on_plane_m(echo.range_m, elevation_rad),
           on_plane_mps(echo.radial_speed_mps, elevation_rad), echo.azimuth_rad});
    }
    return frame;
  }

 private:
  double time_of(int index) const {
    return scene_->trajectory->frame_time_s(index, scene_->description.sensor.scan.frame_rate_Hz);
  }
  RadarVelocity_mps velocity_at(int index) const {
    if (asked_.radar_speed_mps) return {*asked_.radar_speed_mps, 0.0};
    return own_velocity_mps(*scene_, index);
  }

  SourceSettings asked_;
  FmcwSettings settings_;
  std::shared_ptr<const scenes::Scene> scene_;
  FmcwRadar radar_;
  std::vector<int> indices_;
  bool folding_told_ = false;
};

}  // namespace

std::unique_ptr<MeasuredSource> scene_source(const scenes::SceneDescription& description,
                                             const std::filesystem::path& radar_file,
                                             const SourceSettings& settings,
                                             core::ProblemList& problems) {
  return std::make_unique<SceneSource>(description, radar_file, settings, problems);
}

}  // namespace fanbeam::session
