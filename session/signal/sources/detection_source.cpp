#include <utility>

#include "core/median.h"
#include "core/text.h"
#include "session/signal/detection_file.h"
#include "session/signal/radar_file.h"
#include "session/signal/sources/measured_source.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

class DetectionSource : public MeasuredSource {
 public:
  DetectionSource(const fs::path& path, const std::optional<fs::path>& radar_file,
                  const SourceSettings& settings)
      : asked_(settings) {
    core::ProblemList problems;
    if (radar_file) read_radar(*radar_file, problems);
    core::ProblemList found;
    frames_ = read_detections(path, found);
    if (frames_.empty() && !found.has_errors())
      found.error(core::ErrorClass::range, core::Place{path.string()}, "detections", "none",
                  "at least one frame");
    problems.append(found.all());
    problems.throw_if_errors();
    warnings = problems.all();
    if (radar_) set_radar(*radar_);
    name = core::safe_word(fs::absolute(path).lexically_normal().stem().string());
    kind = "detections";
    std::vector<double> times_s;
    for (const DetectedFrame& one : frames_) times_s.push_back(one.time_s);
    frame_s = median_step_s(times_s).value_or(frame_s);
    radar_velocity_mps = velocity_of(frames_.front());
  }
  int frames() const override { return static_cast<int>(frames_.size()); }

  MeasuredFrame frame(int index) override {
    const DetectedFrame& found = frames_[static_cast<std::size_t>(index)];
    return {found.time_s,
            velocity_of(found),
            found.detections.size(),
            measurements_of(found, radar_ ? &*radar_ : nullptr, asked_.errors),
            {}};
  }

 private:
  void read_radar(const fs::path& file, core::ProblemList& problems) {
    try {
      const FmcwSettings known = radar_settings(file);
      radar_ = radar_in_file(file, [&] {
        FmcwRadar radar = fmcw_radar(known);
        check_has_maps(radar);
        return radar;
      });
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  RadarVelocity_mps velocity_of(const DetectedFrame& frame) const {
    if (asked_.radar_speed_mps) return {*asked_.radar_speed_mps, 0.0};
    return frame.radar_velocity_mps.value_or(RadarVelocity_mps{});
  }

  SourceSettings asked_;
  std::optional<FmcwRadar> radar_;
  std::vector<DetectedFrame> frames_;
};

}  // namespace

std::optional<double> median_step_s(const std::vector<double>& times_s) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < times_s.size(); ++i)
    if (times_s[i] > times_s[i - 1]) steps_s.push_back(times_s[i] - times_s[i - 1]);
  if (steps_s.empty()) return std::nullopt;
  return core::median(std::move(steps_s));
}

std::unique_ptr<MeasuredSource> detection_source(const fs::path& path,
                                                 const std::optional<fs::path>& radar_file,
                                                 const SourceSettings& settings) {
  return std::make_unique<DetectionSource>(path, radar_file, settings);
}

}  // namespace fanbeam::session
