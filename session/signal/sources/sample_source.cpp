#include <algorithm>
#include <system_error>

#include "core/text.h"
#include "session/signal/chain.h"
#include "session/signal/file_order.h"
#include "session/signal/radar_file.h"
#include "session/signal/recorded_moments.h"
#include "session/signal/sample_file.h"
#include "session/signal/sources/measured_source.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

// A later stage of a waveform is no frame of its own: "00000-stage1.npy" belongs to "00000.npy".
bool is_later_stage(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t at = stem.rfind("-stage");
  if (at == std::string::npos) return false;
  const std::string number = stem.substr(at + 6);
  std::error_code status;
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos &&
         fs::is_regular_file(file.parent_path() / (stem.substr(0, at) + ".npy"), status);
}

std::vector<fs::path> numpy_files_in(const fs::path& folder) {
  std::error_code status;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, status))
    if (entry.path().extension() == ".npy" && !is_later_stage(entry.path()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end(), comes_before);
  return files;
}

class SampleSource : public MeasuredSource {
 public:
  SampleSource(const fs::path& path, const std::vector<fs::path>& files, const fs::path& radar_file,
               const SourceSettings& settings)
      : asked_(settings),
        settings_(radar_settings(radar_file)),
        radar_(radar_in_file(radar_file,
                             [this] {
                               check_tells_samples(settings_);
                               FmcwRadar radar = fmcw_radar(settings_);
                               check_detects(radar);
                               return radar;
                             })),
        files_(radar_in_file(radar_file,
                             [&] { return SampleFiles(files, radar_, settings_.layout); })) {
    name = core::safe_word(fs::absolute(path).lexically_normal().stem().string());
    kind = "samples";
    // Several frames in a file have no times there.
    core::ProblemList told;
    const bool asked_all = asked_.frame_period_s && asked_.radar_speed_mps;
    if (!asked_all && files_.frames() == static_cast<int>(files.size()))
      moments_ = recorded_moments(
          files, "--frame-period and --radar-speed count, or what they are without it", told);
    warnings = told.all();
    if (asked_.frame_period_s) {
      frame_s = *asked_.frame_period_s;
    } else if (moments_.size() > 1) {
      std::vector<double> times_s;
      for (const RecordedMoment& one : moments_) times_s.push_back(one.time_s);
      frame_s = median_step_s(times_s).value_or(frame_s);
    }
    radar_velocity_mps = velocity_at(0);
    most_range_m = radar_.axes.range_step_m * radar_.detection.transform.kept_range_cells;
    set_radar(radar_);
  }
  int frames() const override { return files_.frames(); }

  MeasuredFrame frame(int index) override {
    FmcwFrame frame;
    frame.beats.push_back(files_.frame(index));
    process_samples(radar_, settings_, {"detections"}, frame);
    const DetectedFrame found{time_at(index), frame.found->detections, frame.found->clusters};
    return {found.time_s,
            velocity_at(index),
            found.detections.size(),
            measurements_of(found, &radar_, asked_.errors),
            {}};
  }

 private:
  double time_at(int index) const {
    return asked_.frame_period_s || moments_.empty()
               ? index * frame_s
               : moments_[static_cast<std::size_t>(index)].time_s;
  }
  RadarVelocity_mps velocity_at(int index) const {
    if (asked_.radar_speed_mps) return {*asked_.radar_speed_mps, 0.0};
    if (moments_.empty()) return {};
    return moments_[static_cast<std::size_t>(index)].radar_velocity_mps;
  }

  SourceSettings asked_;
  FmcwSettings settings_;
  FmcwRadar radar_;
  SampleFiles files_;
  std::vector<RecordedMoment> moments_;  // of each frame, where they are known
};

}  // namespace

std::vector<fs::path> sample_files_in(const fs::path& folder) {
  std::vector<fs::path> files = numpy_files_in(folder);
  return files.empty() ? numpy_files_in(folder / "beat") : files;
}

std::unique_ptr<MeasuredSource> sample_source(const fs::path& path,
                                              const std::vector<fs::path>& files,
                                              const fs::path& radar_file,
                                              const SourceSettings& settings) {
  return std::make_unique<SampleSource>(path, files, radar_file, settings);
}

}  // namespace fanbeam::session
