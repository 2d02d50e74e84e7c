#include "renderer/casting/profile/wedge_strips.h"

#include <algorithm>

namespace fanbeam::renderer {
namespace {

// Takes one of them out; false where there is none.
bool take(std::vector<std::uint32_t>& prisms, std::uint32_t prism) {
  const auto at = std::find(prisms.begin(), prisms.end(), prism);
  if (at == prisms.end()) return false;
  prisms.erase(at);
  return true;
}

}  // namespace

void WedgeStrips::reset(const HeadingRange& wedge, const std::vector<std::uint32_t>& inside) {
  if (prisms_.empty()) prisms_.emplace_back();
  free_.clear();
  for (std::size_t i = 1; i < prisms_.size(); ++i) free_.push_back(static_cast<std::uint32_t>(i));
  strips_.assign(1, WedgeStrip{});
  strips_.front().range = wedge;
  prisms_.front().inside = inside;
  prisms_.front().left_already.clear();
}

// Number of the strip that begins at `heading_rad`; of strips where it is their right end.
std::size_t WedgeStrips::split(double heading_rad) {
  if (heading_rad >= strips_.back().range.right_rad) return strips_.size();
  std::size_t i = 0;
  while (strips_[i].range.right_rad <= heading_rad) ++i;
  if (!(heading_rad > strips_[i].range.left_rad)) return i;
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(prisms_.size()));
    prisms_.emplace_back();
  }
  WedgeStrip right = strips_[i];
  right.prisms = free_.back();
  free_.pop_back();
  prisms_[right.prisms] = prisms_[strips_[i].prisms];
  strips_[i].range.right_rad = right.range.left_rad = heading_rad;
  strips_.insert(strips_.begin() + static_cast<std::ptrdiff_t>(i) + 1, right);
  return i + 1;
}

WedgeStrips::Span WedgeStrips::within(const HeadingRange& part) {
  const std::size_t first = split(part.left_rad), last = split(part.right_rad);
  return {strips_.data() + first, strips_.data() + last};
}

WedgeStrip& WedgeStrips::at(double heading_rad) {
  std::size_t i = 0;
  while (i + 1 < strips_.size() && strips_[i].range.right_rad <= heading_rad) ++i;
  return strips_[i];
}

bool WedgeStrips::alike(const WedgeStrip& a, const WedgeStrip& b) const {
  return a.horizon_tangent == b.horizon_tangent && a.roofed == b.roofed &&
         (!a.roofed || a.roof_from_m == b.roof_from_m) && prisms_[a.prisms] == prisms_[b.prisms];
}

void WedgeStrips::join() {
  std::size_t kept = 0;
  for (std::size_t i = 1; i < strips_.size(); ++i) {
    if (alike(strips_[kept], strips_[i])) {
      strips_[kept].range.right_rad = strips_[i].range.right_rad;
      free_.push_back(strips_[i].prisms);
    } else if (++kept != i) {
      strips_[kept] = strips_[i];
    }
  }
  strips_.resize(kept + 1);
}

bool WedgeStrips::hide(double tangent, const HeadingRange& part) const {
  return std::all_of(strips_.begin(), strips_.end(), [&](const WedgeStrip& strip) {
    const bool beside =
        strip.range.right_rad <= part.left_rad || strip.range.left_rad >= part.right_rad;
    return beside || (!strip.roofed && tangent <= strip.horizon_tangent);
  });
}

bool WedgeStrips::enter(const WedgeStrip& strip, std::uint32_t prism, double highest_tangent) {
  PrismsAround& around = prisms_[strip.prisms];
  if (take(around.left_already, prism) || highest_tangent <= strip.horizon_tangent) return false;
  around.inside.push_back(prism);
  return true;
}

// The horizon only rises: what was hidden where it was entered is so here too.
bool WedgeStrips::leave(const WedgeStrip& strip, std::uint32_t prism, double highest_tangent) {
  PrismsAround& around = prisms_[strip.prisms];
  if (take(around.inside, prism)) return true;
  if (highest_tangent > strip.horizon_tangent) around.left_already.push_back(prism);
  return false;
}

void WedgeStrips::find_roof(WedgeStrip& strip, const std::vector<terrain::Solid>& prisms,
                            double sensor_height_m) const {
  const std::vector<std::uint32_t>& inside = prisms_[strip.prisms].inside;
  strip.roofed = !inside.empty();
  strip.roof_m = WedgeStrip::kBelowEverything;
  for (const std::uint32_t prism : inside) {
    const double top_m = prisms[prism].top_m - sensor_height_m;
    if (top_m <= strip.roof_m) continue;
    strip.roof_m = top_m;
    strip.roof_material = prisms[prism].roof;
    strip.roof_object = prisms[prism].object;
  }
}

}  // namespace fanbeam::renderer
