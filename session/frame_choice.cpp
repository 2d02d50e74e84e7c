#include "session/frame_choice.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/errors.h"

namespace fanbeam::session {
namespace {

struct Slice {
  std::vector<std::optional<long>> parts;  // one is a single frame
  long step = 1;
};

Slice slice_of(const std::string& text) {
  const auto refuse = [&] {
    core::throw_input_error(core::ErrorClass::parse, "--frames", "\"" + text + "\"",
                            "A:B or A:B:STEP with whole numbers");
  };
  Slice slice;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t colon = std::min(text.find(':', from), text.size());
    const std::string part = text.substr(from, colon - from);
    from = colon + 1;
    long value = 0;
    const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (!part.empty() && (status != std::errc() || end != part.data() + part.size())) refuse();
    slice.parts.push_back(part.empty() ? std::nullopt : std::optional<long>(value));
  }
  if (slice.parts.size() > 3) refuse();
  if (slice.parts.size() == 3) slice.step = slice.parts[2].value_or(1);
  if (slice.step < 1)
    core::throw_input_error(core::ErrorClass::range, "--frames", text, "a STEP of at least 1");
  return slice;
}

}  // namespace

void check_frames(const std::string& text) { slice_of(text); }

std::vector<int> parse_frames(const std::string& text, int count) {
  if (count == 0)
    core::throw_input_error(core::ErrorClass::ref, "trajectory", "missing",
                            "[trajectory] in the scene: the frames of a flight are what is asked "
                            "for");
  const auto [parts, step] = slice_of(text);
  const long total = count;
  const auto from_end = [total](long index) {
    return std::clamp(index < 0 ? index + total : index, 0L, total);
  };
  if (parts.size() == 1 && parts[0]) {
    const long index = *parts[0] < 0 ? *parts[0] + total : *parts[0];
    if (index < 0 || index >= total)
      core::throw_input_error(core::ErrorClass::range, "--frames", text,
                              fmt::format("a frame from 0 to {}", total - 1));
    return {static_cast<int>(index)};
  }
  const long begin = from_end(parts[0].value_or(0));
  const long end = parts.size() < 2 ? total : from_end(parts[1].value_or(total));
  std::vector<int> frames;
  for (long index = begin; index < end; index += step) {
    frames.push_back(static_cast<int>(index));
    if (step >= end - index) break;  // index + step may not fit
  }
  if (frames.empty())
    core::throw_input_error(core::ErrorClass::range, "--frames", text,
                            fmt::format("at least one of the {} frames", total));
  return frames;
}

std::vector<int> spread_over(const std::vector<int>& frames, std::size_t count) {
  std::vector<int> spread;
  count = std::min(count, frames.size());
  for (std::size_t i = 0; i < count; ++i)
    spread.push_back(frames[(2 * i + 1) * frames.size() / (2 * count)]);
  return spread;
}

}  // namespace fanbeam::session
