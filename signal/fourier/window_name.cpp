#include <array>

#include "core/errors.h"
#include "core/text.h"
#include "signal/fourier/window.h"

namespace fanbeam::signal {
namespace {

struct Named {
  std::string_view name;
  WindowKind kind;
};
constexpr std::array<Named, 8> kNames = {{{"rectangular", WindowKind::rectangular},
                                          {"hann", WindowKind::hann},
                                          {"hamming", WindowKind::hamming},
                                          {"blackman", WindowKind::blackman},
                                          {"blackman-harris", WindowKind::blackman_harris},
                                          {"taylor", WindowKind::taylor},
                                          {"chebyshev", WindowKind::chebyshev},
                                          {"kaiser", WindowKind::kaiser}}};

// What comes before the next colon; the rest stays.
std::string_view next_part(std::string_view& text) {
  const std::size_t colon = text.find(':');
  const std::string_view part = text.substr(0, colon);
  text = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  return part;
}

// The parameter where one is given; false for one that is no number between the limits.
bool take(std::string_view& rest, double least, double most, double& value) {
  if (rest.empty()) return true;
  const core::ParsedNumber number = core::parse_number(next_part(rest));
  if (number.error != core::NumberError::none) return false;
  if (!(number.value >= least && number.value <= most)) return false;
  value = number.value;
  return true;
}

}  // namespace

std::optional<Window> window_of(std::string_view text) {
  if (!text.empty() && text.back() == ':') return std::nullopt;
  const std::string_view kind = next_part(text);
  Window window;
  window.symmetric = true;
  for (const Named& one : kNames) {
    if (one.name != kind) continue;
    window.kind = one.kind;
    double nbar = window.taylor_nbar;
    bool good = true;
    if (one.kind == WindowKind::taylor)
      good = take(text, 10.0, 120.0, window.level_dB) && take(text, 1.0, 50.0, nbar);
    if (one.kind == WindowKind::chebyshev) {
      window.level_dB = 60.0;
      good = take(text, 20.0, 200.0, window.level_dB);
    }
    if (one.kind == WindowKind::kaiser) good = take(text, 0.0, 100.0, window.kaiser_beta);
    window.taylor_nbar = static_cast<int>(nbar);
    if (good && text.empty() && nbar == window.taylor_nbar) return window;
    return std::nullopt;
  }
  return std::nullopt;
}

std::string name(const Window& window) {
  std::string text;
  for (const Named& one : kNames)
    if (one.kind == window.kind) text = one.name;
  if (window.kind == WindowKind::taylor)
    return text + ":" + core::number_text(window.level_dB) + ":" +
           std::to_string(window.taylor_nbar);
  if (window.kind == WindowKind::chebyshev) return text + ":" + core::number_text(window.level_dB);
  if (window.kind == WindowKind::kaiser) return text + ":" + core::number_text(window.kaiser_beta);
  return text;
}

}  // namespace fanbeam::signal
