#include "terrain/runway.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fanbeam::terrain {
namespace {

glm::dvec2 across(glm::dvec2 along) { return {-along.y, along.x}; }

// Paints rectangles in runway coordinates: s metres behind the threshold, t metres left of the
// centre line. What would reach beyond the pavement's edges is left out.
class MarkingPainter {
 public:
  MarkingPainter(const Runway& runway, int end, std::vector<SurfacePatch>& patches)
      : origin_(runway.threshold_m(end)),
        along_(end == 0 ? runway.along() : -runway.along()),
        half_width_m_(runway.width_m / 2),
        material_(runway.materials.marking),
        patches_(patches) {}

  void rectangle(double s_m, double t_m, double length_m, double width_m) {
    patches_.push_back(
        rectangle_patch(origin_ + along_ * (s_m + length_m / 2) + across(along_) * t_m, along_,
                        length_m, width_m, material_));
  }
  void pair(double s_m, double t_m, double length_m, double width_m) {
    constexpr double kRounding_m = 1e-6;  // side stripes end on the edge
    if (t_m + width_m / 2 > half_width_m_ + kRounding_m) return;
    rectangle(s_m, t_m, length_m, width_m);
    rectangle(s_m, -t_m, length_m, width_m);
  }

 private:
  glm::dvec2 origin_, along_;
  double half_width_m_;
  MaterialId material_;
  std::vector<SurfacePatch>& patches_;
};

// Number of threshold stripes on each side of the centre line, Annex 14, 5.2.4.5.
int stripes_per_side(double width_m) {
  if (width_m < 23.0) return 2;
  if (width_m < 30.0) return 3;
  if (width_m < 45.0) return 4;
  return width_m < 60.0 ? 6 : 8;
}

// Of the touchdown zone, Annex 14, 5.2.6.3.
int touchdown_pairs(double landing_length_m) {
  if (landing_length_m < 900.0) return 1;
  if (landing_length_m < 1200.0) return 2;
  if (landing_length_m < 1500.0) return 3;
  return landing_length_m < 2400.0 ? 4 : 6;
}

void paint_end(const Runway& runway, int end, double landing_length_m,
               std::vector<SurfacePatch>& patches) {
  MarkingPainter paint(runway, end, patches);
  const double reach_m = landing_length_m / 2 - 30.0;
  for (int i = 0; i < stripes_per_side(runway.width_m); ++i)
    paint.pair(6.0, 1.8 + 3.6 * i, 30.0, 1.8);
  const double aiming_m = landing_length_m < 2400.0 ? 300.0 : 400.0;
  if (aiming_m + 45.0 < reach_m) paint.pair(aiming_m, 11.5, 45.0, 6.0);
  for (int i = 1; i <= touchdown_pairs(landing_length_m); ++i) {
    const double s_m = 150.0 * i;
    const bool at_aiming_point = std::abs(s_m - aiming_m) <= 50.0;  // 5.2.6.5
    if (!at_aiming_point && s_m + 22.5 < reach_m) paint.pair(s_m, 10.5, 22.5, 3.0);
  }
}

std::vector<SurfacePatch> pavement_patches(const Runway& runway) {
  std::vector<SurfacePatch> patches;
  const glm::dvec2 centre = (runway.ends[0].pavement_end_m + runway.ends[1].pavement_end_m) / 2.0;
  const glm::dvec2 along = runway.along();
  const double length_m = runway.length_m();
  if (runway.shoulder_m > 0.0)
    patches.push_back(rectangle_patch(centre, along, length_m,
                                      runway.width_m + 2.0 * runway.shoulder_m,
                                      runway.materials.shoulder));
  patches.push_back(
      rectangle_patch(centre, along, length_m, runway.width_m, runway.materials.surface));
  return patches;
}

void paint_markings(const Runway& runway, std::vector<SurfacePatch>& patches) {
  const double landing_m =
      runway.length_m() - runway.ends[0].displaced_m - runway.ends[1].displaced_m;
  paint_end(runway, 0, landing_m, patches);
  paint_end(runway, 1, landing_m, patches);
  MarkingPainter paint(runway, 0, patches);
  for (double s_m = 60.0; s_m + 30.0 < landing_m - 50.0; s_m += 50.0)
    paint.rectangle(s_m, 0.0, 30.0, 0.9);
  paint.pair(0.0, runway.width_m / 2 - 0.45, landing_m, 0.9);
}

double paved_half_width_m(const Runway& runway) {
  return std::min(runway.width_m / 2 + runway.shoulder_m, runway.strip_half_width_m);
}

// From pavement and shoulders; 0 on them.
double off_pavement_m(const Runway& runway, glm::dvec2 position_m) {
  const glm::dvec2 relative = position_m - runway.ends[0].pavement_end_m;
  const double s_m = glm::dot(relative, runway.along());
  const double t_m = std::abs(glm::dot(relative, across(runway.along())));
  return std::hypot(std::max({-s_m, s_m - runway.length_m(), 0.0}),
                    std::max(t_m - paved_half_width_m(runway), 0.0));
}

// Of one value exactly that.
class WeightedMean {
 public:
  void add(double value, double weight) {
    // Each has a say where all have come down to none.
    const double counted = std::max(weight, 1e-9);
    ++count_;
    weights_ += counted;
    sum_ += counted * value;
    last_ = value;
  }
  bool empty() const { return count_ == 0; }
  int count() const { return count_; }
  double value() const { return count_ == 1 ? last_ : sum_ / weights_; }

 private:
  int count_ = 0;
  double weights_ = 0.0, sum_ = 0.0, last_ = 0.0;
};

// Whether pavements with their shoulders have a place in common: no axis of either tells them apart.
bool pavements_meet(const Runway& one, const Runway& other) {
  const auto centre_m = [](const Runway& runway) {
    return (runway.ends[0].pavement_end_m + runway.ends[1].pavement_end_m) / 2.0;
  };
  const auto reach_m = [](const Runway& runway, const glm::dvec2& axis) {
    return runway.length_m() / 2 * std::abs(glm::dot(axis, runway.along())) +
           paved_half_width_m(runway) * std::abs(glm::dot(axis, across(runway.along())));
  };
  const glm::dvec2 apart_m = centre_m(other) - centre_m(one);
  for (const glm::dvec2& along : {one.along(), other.along()})
    for (const glm::dvec2& axis : {along, across(along)})
      if (std::abs(glm::dot(apart_m, axis)) > reach_m(one, axis) + reach_m(other, axis))
        return false;
  return true;
}

// Of a place in several strips: the mean by the distances to their borders, and to pavements that do not
// cross.
double height_in_strips_m(const std::vector<Runway>& runways, glm::dvec2 position_m) {
  constexpr double kSmall_m = 1e-9;  // two pavements that touch share the line between them
  WeightedMean mean;
  for (const Runway& runway : runways) {
    const std::optional<StripHeight> strip = strip_height(runway, position_m);
    if (!strip || strip->natural_share > 0.0) continue;
    double weight = strip->inside_m;
    for (const Runway& other : runways) {
      if (&other == &runway || pavements_meet(runway, other)) continue;
      const double to_other_m = off_pavement_m(other, position_m) + kSmall_m;
      weight *= to_other_m / (off_pavement_m(runway, position_m) + kSmall_m + to_other_m);
    }
    mean.add(strip->height_m, weight);
  }
  return mean.value();
}

// The largest difference of two lines at samples of the first one's strip that lie in the other's.
double step_on_strip_m(const Runway& runway, const Runway& other) {
  constexpr int kAlong = 300, kAcross = 8;
  const double strip_length_m = runway.length_m() + 120.0;
  const glm::dvec2 along = runway.along();
  double largest_m = 0.0;
  for (int i = 0; i <= kAlong; ++i)
    for (int k = 0; k <= kAcross; ++k) {
      const double s_m = strip_length_m * i / kAlong - 60.0;
      const double t_m = runway.strip_half_width_m * (2.0 * k / kAcross - 1.0);
      const glm::dvec2 at_m = runway.ends[0].pavement_end_m + along * s_m + across(along) * t_m;
      const std::optional<StripHeight> there = strip_height(other, at_m);
      if (!there || there->natural_share > 0.0) continue;
      if (const auto here = strip_height(runway, at_m))
        largest_m = std::max(largest_m, std::abs(here->height_m - there->height_m));
    }
  return largest_m;
}

}  // namespace

double Runway::length_m() const {
  return glm::length(ends[1].pavement_end_m - ends[0].pavement_end_m);
}

glm::dvec2 Runway::along() const {
  return (ends[1].pavement_end_m - ends[0].pavement_end_m) / length_m();
}

glm::dvec2 Runway::threshold_m(int end) const {
  const glm::dvec2 inwards = end == 0 ? along() : -along();
  return ends[end].pavement_end_m + inwards * ends[end].displaced_m;
}

std::vector<SurfacePatch> runway_patches(const Runway& runway, ObjectId pavement,
                                         ObjectId markings) {
  std::vector<SurfacePatch> patches = pavement_patches(runway);
  for (SurfacePatch& patch : patches) patch.object = pavement;
  const std::size_t paved = patches.size();
  if (runway.markings) paint_markings(runway, patches);
  for (std::size_t i = paved; i < patches.size(); ++i) patches[i].object = markings;
  return patches;
}

std::optional<StripHeight> strip_height(const Runway& runway, glm::dvec2 position_m) {
  const glm::dvec2 relative = position_m - runway.ends[0].pavement_end_m;
  const double length_m = runway.length_m();
  const double s_m = glm::dot(relative, runway.along());
  const double t_m = std::abs(glm::dot(relative, across(runway.along())));
  // The strip reaches 60 m beyond the pavement (Annex 14, 3.4.2).
  const double beyond_m = std::max({-60.0 - s_m, s_m - length_m - 60.0, 0.0});
  const double beside_m = std::max(t_m - runway.strip_half_width_m, 0.0);
  const double outside_m = std::hypot(beyond_m, beside_m);
  if (outside_m >= runway.blend_m) return std::nullopt;
  const double share = std::clamp(s_m / length_m, 0.0, 1.0);
  const double u = outside_m / runway.blend_m;
  return StripHeight{
      runway.ends[0].elevation_m * (1.0 - share) + runway.ends[1].elevation_m * share,
      u * u * (3.0 - 2.0 * u),
      std::min({runway.strip_half_width_m - t_m, s_m + 60.0, length_m + 60.0 - s_m})};
}

double flattened_height_m(const std::vector<Runway>& runways, glm::dvec2 position_m,
                          double natural_height_m) {
  WeightedMean inside, beside;
  double natural_share = 1.0;
  for (const Runway& runway : runways) {
    const std::optional<StripHeight> strip = strip_height(runway, position_m);
    if (!strip) continue;
    natural_share *= strip->natural_share;
    if (strip->natural_share == 0.0)
      inside.add(strip->height_m, strip->inside_m);
    else
      beside.add(strip->height_m, (1.0 - strip->natural_share) / strip->natural_share);
  }
  if (inside.empty() && beside.empty()) return natural_height_m;
  const double strip_m = inside.empty()        ? beside.value()
                         : inside.count() == 1 ? inside.value()
                                               : height_in_strips_m(runways, position_m);
  return strip_m * (1.0 - natural_share) + natural_height_m * natural_share;
}

double largest_step_m(const Runway& runway, const Runway& other) {
  return std::max(step_on_strip_m(runway, other), step_on_strip_m(other, runway));
}

std::vector<ReflectorSite> edge_light_sites(const Runway& runway) {
  std::vector<ReflectorSite> sites;
  const glm::dvec2 along = runway.along();
  const glm::dvec2 side = across(along);
  const double length_m = runway.length_m();
  const int intervals = std::max(1, static_cast<int>(std::lround(length_m / 60.0)));
  for (int i = 0; i <= intervals; ++i) {
    const glm::dvec2 at = runway.ends[0].pavement_end_m + along * (length_m * i / intervals);
    for (const double sign : {-1.0, 1.0})
      sites.push_back({at + side * (sign * (runway.width_m / 2 + 2.0)), 0.35});
  }
  for (const int end : {0, 1}) {
    const int lights = static_cast<int>(runway.width_m / 3.0);
    for (int i = 0; i <= lights; ++i)
      sites.push_back({runway.threshold_m(end) +
                           side * (runway.width_m * (static_cast<double>(i) / lights - 0.5)),
                       0.35});
  }
  return sites;
}

std::vector<ReflectorSite> approach_light_sites(const Runway& runway, int end, double slope) {
  std::vector<ReflectorSite> sites;
  const glm::dvec2 outwards = end == 0 ? -runway.along() : runway.along();
  const glm::dvec2 side = across(outwards);
  for (int bar = 1; bar <= 30; ++bar) {
    const double distance_m = 30.0 * bar;
    const glm::dvec2 centre = runway.threshold_m(end) + outwards * distance_m;
    const double above_m = 0.5 + slope * distance_m;
    for (int light = -2; light <= 2; ++light)
      sites.push_back({centre + side * static_cast<double>(light), above_m});
    if (bar != 10) continue;
    for (int light = 0; light < 8; ++light)
      for (const double sign : {-1.0, 1.0})
        sites.push_back({centre + side * (sign * (4.5 + 1.5 * light)), above_m});
  }
  return sites;
}

std::vector<ReflectorSite> post_sites(const std::vector<glm::dvec2>& line_m, bool closed,
                                      double spacing_m, double height_m) {
  std::vector<ReflectorSite> sites;
  const std::size_t legs = line_m.size() < 2 ? 0 : line_m.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < legs; ++i) {
    const glm::dvec2 from = line_m[i];
    const glm::dvec2 to = line_m[(i + 1) % line_m.size()];
    const int posts =
        std::max(1, static_cast<int>(std::lround(glm::length(to - from) / spacing_m)));
    for (int post = 0; post < posts; ++post)
      sites.push_back({from + (to - from) * (static_cast<double>(post) / posts), height_m / 2});
  }
  if (legs > 0 && !closed) sites.push_back({line_m.back(), height_m / 2});
  return sites;
}

std::vector<glm::dvec2> perimeter(const Runway& runway, double beyond_m) {
  const glm::dvec2 along = runway.along();
  const glm::dvec2 side = across(along) * (runway.strip_half_width_m + beyond_m);
  const glm::dvec2 from = runway.ends[0].pavement_end_m - along * (60.0 + beyond_m);
  const glm::dvec2 to = runway.ends[1].pavement_end_m + along * (60.0 + beyond_m);
  return {from - side, to - side, to + side, from + side};
}

}  // namespace fanbeam::terrain
