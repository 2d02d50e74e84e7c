#include "signal/waveform/waveform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/constants.h"
#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

struct KindName {
  WaveformKind kind;
  std::string_view name;
};
constexpr std::array kNames = {
    KindName{WaveformKind::continuous, "continuous"},
    KindName{WaveformKind::pulsed, "pulsed"},
    KindName{WaveformKind::chirp_sequence, "chirp-sequence"},
    KindName{WaveformKind::triangle, "triangle"},
    KindName{WaveformKind::sinusoidal, "sinusoidal"},
    KindName{WaveformKind::two_slopes, "two-slopes"},
    KindName{WaveformKind::two_stage, "two-stage"},
    KindName{WaveformKind::coded_triangle, "coded-triangle"},
    KindName{WaveformKind::stepped, "stepped"},
};

constexpr std::size_t kMostSegments = 1000000;

void check_segment(const Segment& segment) {
  check_positive("segment.duration_s", segment.duration_s);
  check_positive("segment.start_frequency_Hz", segment.start_frequency_Hz);
  check_positive("segment end frequency in Hz",
                 segment.start_frequency_Hz + segment.slope_Hz_per_s * segment.duration_s);
  if (!std::isfinite(segment.start_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "segment.start_s", segment.start_s,
                            "finite");
  check_not_negative("segment.slot", segment.slot);
}

void check_order(const std::vector<Segment>& segments) {
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const Segment& before = segments[i - 1];
    const Segment& segment = segments[i];
    const double overlap_s = before.start_s + before.duration_s - segment.start_s;
    if (overlap_s > 1e-9 * before.duration_s)
      core::throw_input_error(core::ErrorClass::time, "segment.start_s", segment.start_s,
                              "not before the end of the segment before");
    if (segment.stage < before.stage || segment.stage > before.stage + 1)
      refuse("segment.stage", segment.stage, "stages in order, counted from 0");
  }
}

// A product that is whole but for rounding counts as whole.
double whole_samples(double duration_s, double rate_Hz) {
  return std::floor(duration_s * rate_Hz * (1.0 + 1e-12));
}

// Returns the stage's number of samples.
double check_stage(const Waveform& waveform, int stage) {
  const std::vector<Segment> segments = stage_segments(waveform, stage);
  const int in_turn = slots(segments);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (std::abs(segments[i].duration_s - segments[0].duration_s) > 1e-12 * segments[0].duration_s)
      refuse("segment.duration_s", segments[i].duration_s, "equal to the others of its stage");
    if (segments[i].slot != static_cast<int>(i) % in_turn || segments.size() % in_turn != 0)
      refuse("segment.slot", segments[i].slot, "slots 0, 1, ... in turn, every round complete");
  }
  const double rate_Hz = waveform.sample_rate_Hz[static_cast<std::size_t>(stage)];
  check_positive("sample_rate_Hz", rate_Hz);
  const double samples = whole_samples(segments[0].duration_s, rate_Hz);
  if (samples < 1.0) refuse("sample_rate_Hz", rate_Hz, "at least one sample in a segment");
  return samples * static_cast<double>(segments.size());
}

}  // namespace

std::string_view name(WaveformKind kind) {
  for (const KindName& entry : kNames)
    if (entry.kind == kind) return entry.name;
  throw core::InternalError("waveform kind without a name");
}

std::optional<WaveformKind> waveform_kind(std::string_view name) {
  for (const KindName& entry : kNames)
    if (entry.name == name) return entry.kind;
  return std::nullopt;
}

const std::vector<WaveformKind>& all_waveform_kinds() {
  static const std::vector<WaveformKind> kKinds = [] {
    std::vector<WaveformKind> kinds;
    for (const KindName& entry : kNames) kinds.push_back(entry.kind);
    return kinds;
  }();
  return kKinds;
}

double Waveform::wavelength_m() const { return core::kSpeedOfLight_mps / centre_frequency_Hz; }

int Waveform::stages() const { return segments.empty() ? 0 : segments.back().stage + 1; }

double Waveform::duration_s() const {
  if (segments.empty()) return 0.0;
  return segments.back().start_s + segments.back().duration_s - segments.front().start_s;
}

std::vector<Segment> stage_segments(const Waveform& waveform, int stage) {
  std::vector<Segment> found;
  for (const Segment& segment : waveform.segments)
    if (segment.stage == stage) found.push_back(segment);
  return found;
}

int slots(const std::vector<Segment>& stage) {
  int most = 0;
  for (const Segment& segment : stage) most = std::max(most, segment.slot);
  return most + 1;
}

double middle_s(const std::vector<Segment>& stage) {
  return 0.5 * (stage.front().middle_s() + stage.back().middle_s());
}

int samples_per_segment(const Waveform& waveform, int stage) {
  for (const Segment& segment : waveform.segments)
    if (segment.stage == stage)
      return static_cast<int>(whole_samples(
          segment.duration_s, waveform.sample_rate_Hz[static_cast<std::size_t>(stage)]));
  refuse("stage", stage, "0 to " + std::to_string(waveform.stages() - 1));
}

void check(const Waveform& waveform) {
  if (waveform.segments.empty() || waveform.segments.size() > kMostSegments)
    core::throw_input_error(core::ErrorClass::limit, "segments",
                            static_cast<double>(waveform.segments.size()), "1 to 1000000");
  check_positive("centre_frequency_Hz", waveform.centre_frequency_Hz);
  check_not_negative("bandwidth_Hz", waveform.bandwidth_Hz);
  if (waveform.kind == WaveformKind::pulsed)
    check_positive("pulse_width_s", waveform.pulse_width_s);
  if (waveform.kind == WaveformKind::sinusoidal) {
    check_positive("sinusoidal.frequency_Hz", waveform.sinusoidal.frequency_Hz);
    check_not_negative("sinusoidal.deviation_Hz", waveform.sinusoidal.deviation_Hz);
  }
  for (const Segment& segment : waveform.segments) check_segment(segment);
  if (waveform.segments.front().stage != 0)
    refuse("segment.stage", waveform.segments.front().stage, "stages counted from 0");
  check_order(waveform.segments);
  if (static_cast<int>(waveform.sample_rate_Hz.size()) != waveform.stages())
    refuse("sample_rate_Hz", static_cast<double>(waveform.sample_rate_Hz.size()),
           "one rate for every stage");
  double samples = 0.0;
  for (int stage = 0; stage < waveform.stages(); ++stage) samples += check_stage(waveform, stage);
  if (samples > kMostFrameSamples)
    core::throw_input_error(core::ErrorClass::limit, "samples", samples, "at most 1e8 in a frame");
}

}  // namespace fanbeam::signal
