#include <algorithm>
#include <map>
#include <system_error>

#include "core/json_node.h"
#include "core/text.h"
#include "session/signal/chain.h"
#include "session/signal/radar_file.h"
#include "session/signal/sample_file.h"
#include "session/signal/sources/measured_source.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

struct Recorded {
  double time_s = 0.0, radar_speed_mps = 0.0;
};

// What the run.json of a folder that `fanbeam fmcw` wrote says of its files, by name relative to it.
std::map<std::string, Recorded> moments_in(const core::JsonNode& record) {
  constexpr core::NumberRange kTimes_s{-1e12, 1e12}, kSpeeds_mps{-1000.0, 1000.0};
  std::map<std::string, Recorded> known;
  const core::JsonNode frames = record.member("frames");
  for (std::size_t i = 0; i < frames.elements(); ++i) {
    const core::JsonNode frame = frames.element(i);
    const auto time_s = frame.member("time_s").number(kTimes_s);
    if (!time_s) continue;
    const double speed_mps = frame.member("radar_speed_mps").number(kSpeeds_mps).value_or(0.0);
    for (const std::string& name : frame.member("files").texts(1000))
      known[name] = {*time_s, speed_mps};
  }
  return known;
}

// When each file was made, by the record one folder above them; none, and why in `warnings`, where that is a
// record of samples which does not say it of all in the order of time.
std::vector<Recorded> recorded_moments(const std::vector<fs::path>& files,
                                       core::ProblemList& warnings) {
  const fs::path own = fs::absolute(files.front()).lexically_normal().parent_path();
  const fs::path record = own.parent_path() / "run.json";
  std::error_code status;
  if (!fs::is_regular_file(record, status)) return {};
  const auto refused = [&](const std::string& why) {
    warnings.warning("TIMES", {record.string()}, "frames", why,
                     "--frame-period and --radar-speed count, or what they are without it");
    return std::vector<Recorded>();
  };
  constexpr core::JsonLimits kLimits{64, 20'000'000};
  core::ProblemList problems;
  const auto file = core::read_json_file(record, 256ULL << 20U, kLimits, problems);
  if (!file) return refused("cannot be read: " + problems.all().front().value);
  const auto known = moments_in(core::JsonNode(*file, problems));
  std::vector<Recorded> moments;
  if (known.empty()) return moments;  // another program's
  for (const fs::path& one : files) {
    const auto found = known.find((own.filename() / one.filename()).generic_string());
    if (found == known.end() || !(moments.empty() || found->second.time_s > moments.back().time_s))
      return refused("no later time of " + one.filename().string());
    moments.push_back(found->second);
  }
  return moments;
}

std::vector<fs::path> numpy_files_in(const fs::path& folder) {
  std::error_code status;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, status)) {
    // A second stage of a waveform is no frame of its own.
    const bool stage = entry.path().stem().string().find("-stage") != std::string::npos;
    if (entry.path().extension() == ".npy" && !stage) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class SampleSource : public MeasuredSource {
 public:
  SampleSource(const fs::path& path, const std::vector<fs::path>& files, const fs::path& radar_file,
               const SourceSettings& settings)
      : asked_(settings),
        settings_(radar_settings(radar_file)),
        radar_(radar_in_file(radar_file, [this] { return fmcw_radar(settings_); })),
        files_(files, radar_, settings_.layout) {
    name = core::safe_word(fs::absolute(path).lexically_normal().stem().string());
    kind = "samples";
    // Several frames in a file have no times there.
    core::ProblemList told;
    const bool asked_all = asked_.frame_period_s && asked_.radar_speed_mps;
    if (!asked_all && files_.frames() == static_cast<int>(files.size()))
      moments_ = recorded_moments(files, told);
    warnings = told.all();
    if (asked_.frame_period_s) {
      frame_s = *asked_.frame_period_s;
    } else if (moments_.size() > 1) {
      std::vector<double> times_s;
      for (const Recorded& one : moments_) times_s.push_back(one.time_s);
      frame_s = median_step_s(times_s).value_or(frame_s);
    }
    radar_speed_mps = speed_at(0);
    most_range_m = radar_.axes.range_step_m * radar_.detection.transform.kept_range_cells;
    resolution = resolution_of(radar_);
  }
  int frames() const override { return files_.frames(); }

  MeasuredFrame frame(int index) override {
    FmcwFrame frame;
    frame.beats.push_back(files_.frame(index));
    process_samples(radar_, settings_, {"detections"}, frame);
    const DetectedFrame found{time_at(index), frame.found->detections, frame.found->clusters};
    return {found.time_s,
            speed_at(index),
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
  double speed_at(int index) const {
    if (asked_.radar_speed_mps) return *asked_.radar_speed_mps;
    return moments_.empty() ? 0.0 : moments_[static_cast<std::size_t>(index)].radar_speed_mps;
  }

  SourceSettings asked_;
  FmcwSettings settings_;
  FmcwRadar radar_;
  SampleFiles files_;
  std::vector<Recorded> moments_;  // of each frame, where they are known
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
