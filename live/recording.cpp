#include "live/recording.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "core/errors.h"
#include "core/files.h"
#include "core/json_node.h"

namespace fanbeam::live {
namespace {

constexpr std::uint64_t kMost_bytes = 2ULL << 30U;
constexpr std::size_t kMostProblems = 20, kMostPacket_bytes = 2000;
constexpr core::JsonLimits kLineLimits{4, 32};
constexpr core::NumberRange kSeconds{0.0, 1e9};

std::optional<std::vector<std::uint8_t>> bytes_of(const std::string& hex) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  if (hex.size() % 2 != 0 || hex.size() > 2 * kMostPacket_bytes) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    const int high = digit(hex[i]), low = digit(hex[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes.push_back(static_cast<std::uint8_t>(16 * high + low));
  }
  return bytes;
}

// Lines of a recording, one after the other, into `recording`.
class Lines {
 public:
  Lines(Recording& recording, core::ProblemList& problems)
      : recording_(recording), problems_(problems) {}

  // Whether it is of a recording, as far as one can tell.
  bool take_head(const std::string& text, const std::string& name) {
    core::ProblemList why_not;
    const auto file = core::parse_json(text, name, kLineLimits, why_not);
    const bool known = file && core::JsonNode(*file, why_not).member("fanbeam_live").present();
    if (known)
      head({*file, problems_});
    else
      problems_.error(core::ErrorClass::ref, {name}, "", "no recording",
                      "what fanbeam live --record writes");
    return known;
  }

  void take(const std::string& text, const std::string& name, int number) {
    const auto file = core::parse_json(text, name, kLineLimits, problems_);
    if (!file) return;
    const core::JsonNode line(*file, problems_);
    if (line.member("packet").present())
      packet(line);
    else if (line.member("frame").present())
      frame(line);
    else
      control(line, number);
  }

 private:
  void head(const core::JsonNode& line) {
    line.member("fanbeam_live").whole(1, 1);
    FlownBy& flown_by = recording_.flown_by;
    flown_by.scene = line.required("scene").text().value_or("");
    const core::JsonNode from = line.required("from");
    flown_by.from = from.is_array() ? from.texts(FlownBy::kMostSources)
                                    : std::vector<std::string>{from.text().value_or("")};
    // As a sensor file's frame_rate_Hz, which may be slower than --rate can be.
    flown_by.rate_Hz = line.required("rate_Hz").number({1e-3, 1000.0}).value_or(16.0);
    flown_by.lockstep = line.required("lockstep").flag().value_or(false);
    if (const auto sensor = line.member("sensor"); sensor.present())
      flown_by.sensor = sensor.text();
    if (const auto effects = line.member("effects"); effects.present())
      flown_by.effects = effects.text();
  }

  void packet(const core::JsonNode& line) {
    const core::JsonNode text = line.member("packet");
    const auto bytes = bytes_of(text.text().value_or("?"));
    if (!bytes) text.error(core::ErrorClass::parse, "bytes in hexadecimal, at most 2000");
    const double arrived_s = line.required("s").number({-1e9, 1e9}).value_or(0.0);
    const int last = static_cast<int>(recording_.flown_by.from.size()) - 1;
    const int source = line.member("from").whole(0, std::max(last, 0)).value_or(0);
    recording_.events.emplace_back(RecordedPacket{
        arrived_s, bytes.value_or(std::vector<std::uint8_t>{}), static_cast<std::size_t>(source)});
  }

  void frame(const core::JsonNode& line) {
    RecordedFrame frame;
    frame.tick.number =
        static_cast<std::uint64_t>(line.member("frame").whole(1, 2'000'000'000).value_or(1));
    frame.tick.now_s = line.required("now_s").number(kSeconds).value_or(0.0);
    frame.tick.at_s = line.required("at_s").number(kSeconds).value_or(0.0);
    frame.samples = line.required("samples").number({0.0, 100000.0}).value_or(0.0);
    recording_.events.emplace_back(frame);
  }

  // The body is JSON of anybody's, on as many lines as it came.
  void control(const core::JsonNode& line, int number) {
    recording_.events.emplace_back(RecordedControl{line.required("control").text().value_or(""),
                                                   line.required("body").any_text().value_or(""),
                                                   number});
  }

  Recording& recording_;
  core::ProblemList& problems_;
};

}  // namespace

Recording read_recording(const std::filesystem::path& file) {
  core::ProblemList problems;
  std::ifstream stream = core::open_file(file, problems);
  problems.throw_if_errors();
  std::error_code fault;
  const std::uint64_t size = std::filesystem::file_size(file, fault);
  if (fault)
    core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "", fault.message(),
                            "a readable file");
  if (size > kMost_bytes)
    core::throw_input_error(core::ErrorClass::limit, core::Place{file.string()}, "file size",
                            fmt::format("{} bytes", size), "at most 2 GiB");
  Recording recording;
  recording.file = file.string();
  Lines lines(recording, problems);
  std::string text;
  // The first line tells what the file is, whether it is whole or not.
  for (int number = 1; std::getline(stream, text) && (number == 1 || !stream.eof()); ++number) {
    const std::string name = fmt::format("{}:{}", file.string(), number);
    if (number == 1 && !lines.take_head(text, name)) break;
    if (number > 1) lines.take(text, name, number);
    if (problems.all().size() >= kMostProblems) break;
  }
  if (stream.bad())
    problems.error(core::ErrorClass::io, {file.string()}, "", "read failed", "a readable file");
  if (recording.flown_by.from.empty() && problems.all().empty())
    problems.error(core::ErrorClass::parse, {file.string()}, "", "empty",
                   "what fanbeam live --record writes");
  problems.throw_if_errors();
  return recording;
}

}  // namespace fanbeam::live
