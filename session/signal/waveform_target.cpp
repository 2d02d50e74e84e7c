#include "session/signal/waveform_target.h"

#include <nlohmann/json.hpp>

#include "signal/waveform/doppler.h"
#include "signal/waveform/figures.h"

namespace fanbeam::session {

WaveformTarget target_seen_by(const signal::Waveform& waveform, const signal::ScatterPath& path,
                              signal::FoldingPolicy policy) {
  WaveformTarget target;
  target.path = path;
  target.warnings = signal::folding_warnings(signal::count_folding(waveform, {path}, policy));
  target.doppler_shift_Hz =
      signal::doppler_shift_Hz(path.radial_speed_mps, waveform.centre_frequency_Hz);
  for (const signal::Segment& segment : waveform.segments) {
    const bool up = segment.slope_Hz_per_s > 0.0;
    const bool known = !target.beats.empty() && target.beats.back().stage == segment.stage &&
                       target.beats.back().up == up;
    if (segment.slope_Hz_per_s == 0.0 || known) continue;
    const double range_m = path.range_m + path.radial_speed_mps * segment.middle_s();
    target.beats.push_back(
        {segment.stage, up, signal::beat_Hz(segment, range_m, path.radial_speed_mps)});
  }
  return target;
}

std::string waveform_target_json(const WaveformTarget& target) {
  using Json = nlohmann::ordered_json;
  Json beats = Json::array();
  for (const SlopeBeat& beat : target.beats)
    beats.push_back(
        {{"stage", beat.stage}, {"ramp", beat.up ? "up" : "down"}, {"beat_Hz", beat.beat_Hz}});
  Json warnings = Json::array();
  for (const core::Problem& warning : target.warnings) warnings.push_back(to_string(warning));
  const Json json = {{"range_m", target.path.range_m},
                     {"radial_speed_mps", target.path.radial_speed_mps},
                     {"doppler_shift_Hz", target.doppler_shift_Hz},
                     {"beats", beats},
                     {"warnings", warnings}};
  return json.dump();
}

}  // namespace fanbeam::session
