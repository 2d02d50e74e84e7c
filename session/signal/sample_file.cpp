#include "session/signal/sample_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/text.h"
#include "session/signal/channel_factors.h"

namespace fanbeam::session {
namespace {

constexpr std::array<const char*, 6> kAxes = {"frame",    "chirp",   "transmitter",
                                              "receiver", "channel", "sample"};
constexpr std::size_t kMostRecordedFrames = 1'000'000;
constexpr std::size_t kMostFrameValues = std::size_t{1} << 28U;
// (1e10 * 2^28)^2 is 7e36.
constexpr double kMostSample_sqrtW = 1e10;
// Noise 150 dB below is 3e-38, hardly less than the smallest float with all its digits.
constexpr double kLeastSample_sqrtW = 1e-30;
constexpr std::size_t kValuesAtOnce = std::size_t{1} << 20U;

bool has(const std::vector<std::string>& axes, const char* name) {
  return std::find(axes.begin(), axes.end(), name) != axes.end();
}

// Of an axis; 1 and 0 where it is missing.
struct Axis {
  std::size_t length = 1, stride = 0;
};

Axis axis_of(const std::vector<std::string>& axes, const std::vector<std::size_t>& shape,
             const char* name) {
  std::size_t stride = 1;
  for (std::size_t i = axes.size(); i-- > 0;) {
    if (axes[i] == name) return {shape[i], stride};
    stride *= shape[i];
  }
  return {};
}

// Every transmitter's chirps one after the other, as recorders keep them.
bool in_turn(const std::vector<std::string>& axes, int slots) {
  return slots > 1 && !has(axes, "channel") && !has(axes, "transmitter");
}

}  // namespace

std::optional<std::vector<std::string>> sample_axes(const std::string& text) {
  std::vector<std::string> axes;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string name(core::trimmed(std::string_view(text).substr(from, comma - from)));
    from = comma + 1;
    if (std::find(kAxes.begin(), kAxes.end(), name) == kAxes.end() || has(axes, name.c_str()))
      return std::nullopt;
    axes.push_back(name);
  }
  if (!has(axes, "sample")) return std::nullopt;
  if (has(axes, "channel") && (has(axes, "transmitter") || has(axes, "receiver")))
    return std::nullopt;
  return axes;
}

SampleFiles::SampleFiles(std::vector<std::filesystem::path> files, const FmcwRadar& radar,
                         SampleLayout layout)
    : layout_(std::move(layout)) {
  check_has_maps(radar);
  const auto chirps = signal::stage_segments(radar.waveform, 0).size() /
                      static_cast<std::size_t>(radar.array.slots());
  shape_ = {signal::samples_per_segment(radar.waveform, 0), static_cast<int>(chirps),
            radar.array.channels()};
  real_ = !radar.waveform.complex_baseband;
  transmitters_ = static_cast<int>(radar.array.transmitters_m.size());
  receivers_ = static_cast<int>(radar.array.receivers_m.size());
  slots_ = radar.array.slots();
  core::ProblemList problems;
  correct(problems);
  for (std::filesystem::path& path : files)
    if (!problems.is_full()) add(std::move(path), problems);
  std::size_t frames = 0;
  for (const File& file : files_) frames += file.frames;
  if (frames > kMostRecordedFrames)
    problems.error(core::ErrorClass::limit, core::Place{files_.back().path.string()}, "shape",
                   std::to_string(frames) + " frames in all", "a million at most");
  for (const File& file : files_)
    if (!problems.is_full()) check_values(file, problems);
  problems.throw_if_errors();
  frames_ = static_cast<int>(frames);
}

void SampleFiles::add(std::filesystem::path path, core::ProblemList& problems) {
  File file{std::move(path), {}, 1};
  try {
    file.header = core::read_npy_header(file.path);
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return;
  }
  if (layout_.axes.empty())
    layout_.axes = file.header.shape.size() == 4
                       ? std::vector<std::string>{"frame", "channel", "chirp", "sample"}
                       : std::vector<std::string>{"channel", "chirp", "sample"};
  if (!fits(file, problems)) return;
  file.frames = axis_of(layout_.axes, file.header.shape, "frame").length;
  if (const std::size_t values = file.header.count() / file.frames; values > kMostFrameValues)
    problems.error(core::ErrorClass::limit, core::Place{file.path.string()}, "shape",
                   std::to_string(values) + " values in a frame", "2^28 at most");
  files_.push_back(std::move(file));
}

// By the scale, and by what calibration tells of each channel.
void SampleFiles::correct(core::ProblemList& problems) {
  const auto channels = static_cast<std::size_t>(shape_.channels);
  const auto check = [&](const char* key, const std::vector<double>& values) {
    if (!values.empty() && values.size() != channels)
      problems.error(core::ErrorClass::range, {}, key, std::to_string(values.size()) + " numbers",
                     fmt::format("one for each of {} channels", channels));
  };
  check("samples.channel_gain_dB", layout_.channel_gains_dB);
  check("samples.channel_phase_deg", layout_.channel_phases_rad);
  if (problems.has_errors()) return;
  double largest = 0.0;
  for (const std::complex<double>& known :
       channel_factors(layout_.channel_gains_dB, layout_.channel_phases_rad, shape_.channels)) {
    const std::complex<double> factor = layout_.scale_sqrtW / known;
    corrections_.push_back(static_cast<std::complex<float>>(factor));
    largest = std::max(largest, std::abs(factor));
  }
  most_value_ = std::min(kMostSample_sqrtW / largest, core::kMostFloat);
  least_value_ = kLeastSample_sqrtW / std::min(largest, 1.0);
}

// Found when its turn comes, a value in the last of many files would cost the tracks of all before it.
void SampleFiles::check_values(const File& file, core::ProblemList& problems) const {
  if (file.header.type == "<i2" && most_value_ >= 32768.0 && least_value_ <= 1.0) return;
  const std::size_t count = file.header.count();
  double largest = 0.0;
  try {
    for (std::size_t from = 0; from < count; from += kValuesAtOnce)
      largest =
          std::max(largest, core::largest_npy(file.path, file.header, from,
                                              std::min(kValuesAtOnce, count - from), most_value_));
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return;
  }
  if (largest > 0.0 && largest < least_value_)
    problems.error(core::ErrorClass::range, core::Place{file.path.string()}, "largest value",
                   core::number_text(largest),
                   "at least " + core::number_text(least_value_) + ", or zeros alone");
}

bool SampleFiles::fits(const File& file, core::ProblemList& problems) const {
  const std::vector<std::size_t>& shape = file.header.shape;
  bool good = true;
  const auto refuse = [&](const std::string& value, const std::string& expected) {
    problems.error(core::ErrorClass::range, core::Place{file.path.string()}, "shape", value,
                   expected);
    good = false;
  };
  if (shape.size() != layout_.axes.size()) {
    refuse(std::to_string(shape.size()) + " axes",
           fmt::format("{}: {}", layout_.axes.size(), fmt::join(layout_.axes, ", ")));
    return false;
  }
  const auto length = [&](const char* name) { return axis_of(layout_.axes, shape, name).length; };
  const auto at_least = [&](const char* name, std::size_t least) {
    if (length(name) < least)
      refuse(fmt::format("{} along {}", length(name), name),
             fmt::format("{} or more, as the waveform has", least));
  };
  const auto exactly = [&](const char* name, int count, const char* hint = "") {
    if (length(name) != static_cast<std::size_t>(count))
      refuse(fmt::format("{} along {}", length(name), name),
             fmt::format("{}, as the array has{}", count, hint));
  };
  const bool is_complex = file.header.type.find('c') != std::string::npos;
  good = is_complex != real_;
  if (!good)
    problems.error(core::ErrorClass::unsupported, core::Place{file.path.string()}, "type",
                   file.header.type,
                   real_ ? "real samples, as the radar file says (real = true)"
                         : "complex samples, or real = true in the radar file's [waveform]");
  at_least("sample", static_cast<std::size_t>(shape_.samples));
  const bool turns = in_turn(layout_.axes, slots_);
  at_least("chirp", static_cast<std::size_t>(shape_.chirps) *
                        static_cast<std::size_t>(turns ? transmitters_ : 1));
  if (has(layout_.axes, "channel")) {
    exactly("channel", shape_.channels);
  } else {
    if (!turns) {
      exactly("transmitter", transmitters_,
              has(layout_.axes, "transmitter") ? "" : " (waveform.slots where they take turns)");
    }
    exactly("receiver", receivers_);
  }
  return good;
}

signal::FloatCube SampleFiles::frame(int index) const {
  auto left = static_cast<std::size_t>(index);
  auto file = files_.begin();
  while (left >= file->frames) left -= (file++)->frames;
  const auto at = [&](const char* name) { return axis_of(layout_.axes, file->header.shape, name); };
  const Axis frames = at("frame"), chirp = at("chirp"), channel = at("channel"),
             transmitter = at("transmitter"), receiver = at("receiver"), sample = at("sample");
  // Where frames are the outermost axis one alone is read.
  const bool outermost = layout_.axes.front() == "frame";
  const std::size_t count = file->header.count() / (outermost ? frames.length : 1);
  const auto values =
      core::read_npy(file->path, file->header, outermost ? left * count : 0, count, most_value_);
  const std::size_t first = outermost ? 0 : left * frames.stride;
  const bool turns = in_turn(layout_.axes, slots_);
  signal::FloatCube cube(shape_);
  for (int c = 0; c < shape_.channels; ++c) {
    const auto t = static_cast<std::size_t>(c / receivers_),
               r = static_cast<std::size_t>(c % receivers_);
    for (int m = 0; m < shape_.chirps; ++m) {
      const std::size_t place =
          turns ? static_cast<std::size_t>(m * transmitters_) + t : static_cast<std::size_t>(m);
      const std::size_t row = first + place * chirp.stride +
                              static_cast<std::size_t>(c) * channel.stride +
                              t * transmitter.stride + r * receiver.stride;
      for (int n = 0; n < shape_.samples; ++n) {
        const std::complex<float> value = corrections_[static_cast<std::size_t>(c)] *
                                          values[row + static_cast<std::size_t>(n) * sample.stride];
        cube.at(c, m, n) = layout_.conjugate ? std::conj(value) : value;
      }
    }
  }
  return cube;
}

}  // namespace fanbeam::session
