#include "live/wiring/sinks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <utility>

#include "core/errors.h"
#include "live/wiring/words.h"

namespace fanbeam::live {
namespace {

using feeds::cat240::CellBits;

constexpr std::string_view kShared = "shm:", kRawBscope = "raw-bscope:", kRawCscope = "raw-cscope:",
                           kVideo = "cat240:";
constexpr std::string_view kBits = "bits", kAzimuth = "azimuth", kCompress = "compress",
                           kSource = "source", kInterface = "interface", kHops = "hops";
constexpr std::array kSinkKeys{kBits, kAzimuth, kCompress, kSource, kInterface, kHops};
constexpr const char* kSinks =
    "shm:NAME, raw-bscope:FILE, raw-cscope:FILE or cat240:ADDRESS:PORT and behind it ,bits=8 or "
    "16, ,azimuth=nose or true, ,compress=none or zlib, ,source=SAC/SIC, ,interface=ADDRESS, "
    ",hops=N";

[[noreturn]] void refuse_sink(const std::string& value, const char* expected) {
  core::throw_input_error(core::ErrorClass::ref, "--to", "\"" + value + "\"", expected);
}

// Of two words the second.
bool is_second(const std::string& value, const char* first, const char* second,
               const char* expected) {
  if (value != first && value != second) refuse_sink(value, expected);
  return value == second;
}

int whole(std::string_view text, int most, const std::string& value, const char* expected) {
  int number = -1;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size() || number < 0 || number > most)
    refuse_sink(value, expected);
  return number;
}

void take_video_option(std::string_view key, const std::string& value, RadarVideoSettings& video) {
  if (key == kBits) {
    video.bits =
        is_second(value, "8", "16", "bits=8 or bits=16") ? CellBits::sixteen : CellBits::eight;
  } else if (key == kAzimuth) {
    video.true_bearings = is_second(value, "nose", "true", "azimuth=nose or azimuth=true");
  } else if (key == kCompress) {
    video.zlib = is_second(value, "none", "zlib", "compress=none or compress=zlib");
  } else if (key == kInterface) {
    video.interface = parse_address(value, "--to");
  } else if (key == kHops) {
    video.hops = whole(value, 255, value, "hops=N, N from 0 to 255");
  } else {
    constexpr const char* kExpected = "source=SAC/SIC, each from 0 to 255";
    const std::size_t slash = value.find('/');
    if (slash == std::string::npos) refuse_sink(value, kExpected);
    const std::string_view text = value;
    video.source.area =
        static_cast<std::uint8_t>(whole(text.substr(0, slash), 255, value, kExpected));
    video.source.code =
        static_cast<std::uint8_t>(whole(text.substr(slash + 1), 255, value, kExpected));
  }
}

RadarVideoSettings video_to(const std::string& text) {
  RadarVideoSettings video;
  const Worded words = worded(text, kSinkKeys);
  video.to = parse_endpoint(words.head.substr(kVideo.size()), "--to");
  if (video.to.port == 0)
    core::throw_input_error(core::ErrorClass::range, "--to", "\"" + text + "\"", "a port from 1");
  if (words.repeats()) refuse_sink(text, "each key once");
  for (const auto& [key, value] : words.options) take_video_option(key, value, video);
  const bool six = video.to.address.find(':') != std::string::npos ||
                   video.interface.find(':') != std::string::npos;
  if (six && !video.interface.empty())
    core::throw_input_error(core::ErrorClass::unsupported, "--to", "\"" + text + "\"",
                            "interface= of IPv4 alone");
  const bool for_groups = std::any_of(
      words.options.begin(), words.options.end(),
      [](const auto& option) { return option.first == kInterface || option.first == kHops; });
  if (for_groups && !video.to.multicast)
    core::throw_input_error(core::ErrorClass::unsupported, "--to", "\"" + text + "\"",
                            "interface= and hops= with a multicast address alone, such as "
                            "239.255.35.240");
  return video;
}

// Whatever names it goes by, standard output too.
bool is_same_file(const std::string& one, const std::string& other) {
  const auto named = [](const std::string& file) { return file == "-" ? "/dev/stdout" : file; };
  const std::string a = named(one), b = named(other);
  const auto real_path = [](const std::string& file) {
    std::error_code fault;
    const std::filesystem::path path = std::filesystem::absolute(file, fault);
    const std::filesystem::path real = std::filesystem::weakly_canonical(path, fault);
    return fault ? path : real;
  };
  std::error_code missing;
  return std::filesystem::equivalent(a, b, missing) || real_path(a) == real_path(b);
}

// One file of two pictures in turns would be neither's.
void add_raw(const std::string& text, const RawSink& sink, FramesTo& to) {
  if (std::any_of(to.raw.begin(), to.raw.end(),
                  [&](const RawSink& other) { return is_same_file(other.file, sink.file); }))
    refuse_sink(text, "another file or pipe than the sink before it");
  to.raw.push_back(sink);
}

// Columns and rows.
std::pair<int, int> raw_size(RawFrames::Scope scope, const sensors::Sensor& sensor) {
  const bool bscope = scope == RawFrames::Scope::bscope;
  return {sensor.scan.columns, bscope ? sensor.range.cells : sensor.display.cscope_rows};
}

std::string told_size(const std::pair<int, int>& size) {
  return std::to_string(size.first) + "x" + std::to_string(size.second);
}

}  // namespace

bool FramesTo::take_stdout() const {
  return std::any_of(raw.begin(), raw.end(), [](const RawSink& sink) { return sink.file == "-"; });
}

bool FramesTo::write_into(const std::string& file) const {
  return std::any_of(raw.begin(), raw.end(),
                     [&](const RawSink& sink) { return is_same_file(sink.file, file); });
}

bool FramesTo::want_received() const {
  return std::any_of(video.begin(), video.end(),
                     [](const auto& one) { return one.bits == CellBits::sixteen; });
}

void add_sink(const std::string& text, FramesTo& to) {
  if (text.starts_with(kShared)) {
    to.shared.push_back(text.substr(kShared.size()));
    check_shared_name(to.shared.back());
  } else if (text.starts_with(kRawBscope))
    add_raw(text, {RawFrames::Scope::bscope, text.substr(kRawBscope.size())}, to);
  else if (text.starts_with(kRawCscope))
    add_raw(text, {RawFrames::Scope::cscope, text.substr(kRawCscope.size())}, to);
  else if (text.starts_with(kVideo))
    to.video.push_back(video_to(text));
  else
    refuse_sink(text, kSinks);
}

void Sinks::begin(const scenes::SceneDescription& scene, double rate_Hz) {
  shared_.clear();
  video_.clear();
  core::ProblemList problems;
  const auto open = [&](auto& sinks, const auto& made) {
    try {
      sinks.push_back(made());
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  };
  for (const std::string& name : to_.shared)
    open(shared_, [&] { return std::make_unique<SharedFrames>(name, scene.sensor, rate_Hz); });
  for (const RadarVideoSettings& video : to_.video)
    open(video_, [&] {
      return std::make_unique<RadarVideo>(video, scene.sensor, scene.name, rate_Hz, every_frame_);
    });
  const bool raw_begins = raw_.size() < to_.raw.size();
  if (raw_begins)
    for (const RawSink& sink : to_.raw)
      open(raw_, [&] { return std::make_unique<RawFrames>(sink.scope, sink.file, every_frame_); });
  problems.throw_if_errors();
  if (!raw_begins) return;
  // Last, as it empties files that are there, and all of them or none.
  for (const auto& raw : raw_) raw->begin();
  raw_sensor_ = scene.sensor;
}

void Sinks::check_raw_size(const scenes::SceneDescription& next) const {
  core::ProblemList problems;
  for (const RawSink& sink : to_.raw) {
    const auto now = raw_size(sink.scope, raw_sensor_), then = raw_size(sink.scope, next.sensor);
    if (now != then)
      problems.error(core::ErrorClass::unsupported, {}, "--to", "\"" + sink.file + "\"",
                     "pictures of " + told_size(now) + " as before: those of " + next.name +
                         " are of " + told_size(then));
  }
  problems.throw_if_errors();
}

void Sinks::write(const std::shared_ptr<const LiveFrame>& frame) {
  if (!frame) return;
  for (const auto& ring : shared_)
    if (frame->number != ring->newest()) ring->write(*frame);
  for (const auto& raw : raw_) raw->write(frame);
  for (const auto& video : video_) video->write(frame);
}

bool Sinks::any_ended() const {
  return std::any_of(raw_.begin(), raw_.end(), [](const auto& raw) { return raw->ended(); });
}

void Sinks::end() {
  core::ProblemList problems;
  for (const auto& raw : raw_) {
    try {
      raw->close();
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  problems.throw_if_errors();
}

}  // namespace fanbeam::live
