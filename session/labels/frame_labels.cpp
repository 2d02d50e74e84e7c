#include "session/labels/frame_labels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "core/parallel.h"
#include "session/labels/masks.h"

namespace fanbeam::session {

// What it is called, and its numbers in layers.
struct LabelledThing {
  std::string name;
  ObjectGroup group{};
  std::vector<std::uint32_t> ids;
};

namespace {

using renderer::ObjectKind;

// The parts of one model are one thing, and so are point targets of one name.
std::vector<LabelledThing> things_of(const scenes::Scene& scene) {
  const renderer::Geometry& geometry = *scene.world.geometry;
  std::vector<LabelledThing> things;
  for (std::uint32_t id = 0; id < geometry.object_names.size(); ++id) {
    const std::string& name = geometry.object_names[id];
    switch (geometry.object_kinds[id]) {
      case ObjectKind::box:
        things.push_back({name, ObjectGroup::box, {id}});
        break;
      case ObjectKind::building:
        things.push_back({name, ObjectGroup::building, {id}});
        break;
      default:  // models below; ground and what is painted on it
        break;
    }
  }
  for (const renderer::ModelObjects& model : geometry.models) {
    if (model.objects == 0) continue;
    things.push_back({model.name, ObjectGroup::model, {}});
    for (std::size_t part = 0; part < model.objects; ++part)
      things.back().ids.push_back(model.first + static_cast<std::uint32_t>(part));
  }
  std::map<std::string, std::size_t> known;
  auto id = static_cast<std::uint32_t>(geometry.object_names.size());
  for (const renderer::PointTarget& target : scene.world.targets) {
    const auto [found, fresh] = known.try_emplace(target.name, things.size());
    if (fresh)
      things.push_back({target.name,
                        target.name.ends_with(" light") ? ObjectGroup::lights : ObjectGroup::target,
                        {}});
    things[found->second].ids.push_back(id++);
  }
  return things;
}

// Pavement and markings of runway `i`, by the order that scenes add them in.
std::vector<std::uint32_t> runway_ids(const renderer::Geometry& geometry, std::size_t i) {
  std::vector<std::uint32_t> ids;
  for (const ObjectKind kind : {ObjectKind::runway, ObjectKind::marking}) {
    std::size_t before = 0;
    for (std::uint32_t id = 0; id < geometry.object_kinds.size(); ++id)
      if (geometry.object_kinds[id] == kind && before++ == i) ids.push_back(id);
  }
  return ids;
}

double ground_m(const scenes::Scene& scene, double x_m, double y_m) {
  const terrain::HeightField* ground = scene.world.surfaces().terrain();
  return ground == nullptr ? 0.0 : ground->nearest_height(x_m, y_m);
}

struct Shares {
  double in_sight = 0.0, in_view = 0.0;
};

class ShareSum {
 public:
  void add(double weight, bool sight, bool view) {
    all_ += weight;
    if (sight) sight_ += weight;
    if (view) view_ += weight;
  }
  Shares shares() const {
    if (!(all_ > 0.0)) return {};
    return {sight_ / all_, view_ / all_};
  }

 private:
  double all_ = 0.0, sight_ = 0.0, view_ = 0.0;
};

bool in_view(const Eye& eye, const glm::dvec3& at_m) {
  const auto spot = eye.in_bscope(at_m);
  return spot && spot->inside;
}

// A runway's rectangle on the ground, from its near end on.
class RunwayGround {
 public:
  RunwayGround(const scenes::Scene& scene, const scenes::RunwayPlace& runway, int near)
      : scene_(scene),
        begin_m_(runway.ends[near].pavement_end_m),
        along_m_(glm::dvec2(runway.ends[1 - near].pavement_end_m) - glm::dvec2(begin_m_)),
        length_m_(glm::length(along_m_)),
        width_m_(runway.width_m) {}

  double length_m() const { return length_m_; }
  glm::dvec2 along() const { return along_m_ / length_m_; }
  // `right_m` from the centre line.
  glm::dvec3 at(double from_end_m, double right_m) const {
    const glm::dvec2 u = along();
    const glm::dvec2 p = glm::dvec2(begin_m_) + from_end_m * u + right_m * glm::dvec2(u.y, -u.x);
    return {p, ground_m(scene_, p.x, p.y)};
  }
  // Near left, near right, far right, far left.
  std::array<glm::dvec3, 4> corners(double from_m, double to_m) const {
    const double half_m = width_m_ / 2;
    return {at(from_m, -half_m), at(from_m, half_m), at(to_m, half_m), at(to_m, -half_m)};
  }
  Placement placement_of(const glm::dvec2& p, double strip_half_width_m) const {
    constexpr double kBeyondEnds_m = 60.0;  // ICAO Annex 14, 3.4.2
    const glm::dvec2 from_end_m = p - glm::dvec2(begin_m_);
    const double along_m = glm::dot(from_end_m, along());
    const double aside_m = std::abs(from_end_m.x * along().y - from_end_m.y * along().x);
    const double beyond_m = std::max(-along_m, along_m - length_m_);
    if (aside_m <= width_m_ / 2 && beyond_m <= 0.0) return Placement::on_runway;
    const bool beside = aside_m <= strip_half_width_m && beyond_m <= kBeyondEnds_m;
    return beside ? Placement::beside_runway : Placement::elsewhere;
  }
  Shares shares(const Eye& eye) const {
    ShareSum sum;
    for (int i = 0; i < kRunwayGrid[0]; ++i)
      for (int j = 0; j < kRunwayGrid[1]; ++j) {
        const glm::dvec3 at_m = at((i + 0.5) / kRunwayGrid[0] * length_m_,
                                   ((j + 0.5) / kRunwayGrid[1] - 0.5) * width_m_);
        sum.add(1.0, eye.sees(at_m + glm::dvec3(0.0, 0.0, kSightHeight_m)), in_view(eye, at_m));
      }
    return sum.shares();
  }

 private:
  const scenes::Scene& scene_;
  glm::dvec3 begin_m_;
  glm::dvec2 along_m_;
  double length_m_, width_m_;
};

std::array<PlaceLabel, 4> look_at_all(const Eye& eye, const std::array<glm::dvec3, 4>& places_m) {
  return {eye.look_at(places_m[0]), eye.look_at(places_m[1]), eye.look_at(places_m[2]),
          eye.look_at(places_m[3])};
}

// Above the ellipsoid, or the scene's plane.
double scene_height_m(const Eye& eye, const glm::dvec3& at_m) {
  return eye.scene().frame.to_geodetic(at_m).height_m;
}

RunwayLabel runway_label(const Eye& eye, const scenes::RunwayPlace& runway) {
  const auto far_off_m = [&](int end) {
    return glm::length(runway.ends[end].threshold_m - eye.at_m());
  };
  const int near = far_off_m(0) <= far_off_m(1) ? 0 : 1;
  const RunwayGround ground(eye.scene(), runway, near);
  RunwayLabel label;
  label.near_end = runway.ends[near].name;
  label.far_end = runway.ends[1 - near].name;
  label.length_m = ground.length_m();
  label.width_m = runway.width_m;
  const glm::dvec3 off_m = eye.at_m() - runway.ends[near].threshold_m;
  const glm::dvec2 along = ground.along();
  label.along_track_m = -glm::dot(glm::dvec2(off_m), along);
  label.cross_track_m = off_m.x * along.y - off_m.y * along.x;
  label.above_m =
      scene_height_m(eye, eye.at_m()) - scene_height_m(eye, runway.ends[near].threshold_m);
  label.corners = look_at_all(eye, ground.corners(0.0, ground.length_m()));
  label.thresholds = {eye.look_at(runway.ends[near].threshold_m),
                      eye.look_at(runway.ends[1 - near].threshold_m)};
  const double displaced_m =
      glm::length(glm::dvec2(runway.ends[near].threshold_m - runway.ends[near].pavement_end_m));
  const double zone_m = std::min(900.0, (ground.length_m() - displaced_m) / 2);
  label.touchdown_zone = look_at_all(eye, ground.corners(displaced_m, displaced_m + zone_m));
  const Shares shares = ground.shares(eye);
  label.in_sight_share = shares.in_sight;
  label.in_view_share = shares.in_view;
  return label;
}

// Of what gets no label, neither in view nor in any cell, nothing else is asked.
Shares shares_of(const Eye& eye, const std::vector<Facet>& facets, bool lit) {
  constexpr double kClearance_m = 0.2;  // the facet itself is no obstacle
  if (!lit && std::none_of(facets.begin(), facets.end(),
                           [&](const Facet& facet) { return in_view(eye, facet.middle_m); }))
    return {};
  ShareSum sum;
  for (const Facet& facet : facets) {
    const glm::dvec3 away_m = facet.middle_m - eye.at_m();
    const double shown_m2 = -glm::dot(facet.outwards_m2, away_m) / glm::length(away_m);
    if (!(shown_m2 > 0.0)) continue;
    sum.add(shown_m2, eye.sees(facet.middle_m, kClearance_m), in_view(eye, facet.middle_m));
  }
  return sum.shares();
}

}  // namespace

struct Labeller::Known {
  std::vector<LabelledThing> things;
  std::vector<ObjectShape> shapes;  // by object
};

Labeller::Labeller(const scenes::Scene& scene)
    : known_(std::make_unique<const Known>(Known{
          things_of(scene),
          object_shapes(scene.world.surfaces(), scene.world.geometry->object_names.size())})) {}

Labeller::~Labeller() = default;

namespace {

// All of it but masks; `lit`: they have cells.
ObjectLabel object_label(const Eye& eye, const LabelledThing& thing,
                         const std::vector<ObjectShape>& shapes, double time_s, bool lit) {
  const scenes::Scene& scene = eye.scene();
  ObjectLabel label;
  label.name = thing.name;
  label.group = thing.group;
  label.placement = Placement::elsewhere;
  label.ids = thing.ids;
  terrain::Box_m box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  std::vector<Facet> facets;
  std::vector<glm::dvec3> places_m;  // of points: a fence around a runway is not in its middle
  ShareSum points;
  double tallest_m = -1e300;  // of points, each over its own ground
  for (const std::uint32_t id : thing.ids) {
    if (id < shapes.size()) {
      box.low = glm::min(box.low, shapes[id].box.low);
      box.high = glm::max(box.high, shapes[id].box.high);
      facets.insert(facets.end(), shapes[id].facets.begin(), shapes[id].facets.end());
      continue;
    }
    const glm::dvec3 at_m = scene.world.targets[id - shapes.size()].position_at(time_s);
    box.low = glm::min(box.low, at_m);
    box.high = glm::max(box.high, at_m);
    places_m.push_back(at_m);
    tallest_m = std::max(tallest_m, at_m.z - ground_m(scene, at_m.x, at_m.y));
    if (thing.group == ObjectGroup::lights) label.points.push_back(eye.look_at(at_m));
    points.add(1.0, eye.sees(at_m), in_view(eye, at_m));
  }
  const glm::dvec3 middle_m = (box.low + box.high) / 2.0;
  label.middle = eye.look_at(middle_m);
  label.height_m =
      places_m.empty() ? box.high.z - ground_m(scene, middle_m.x, middle_m.y) : tallest_m;
  const Shares shares = facets.empty() ? points.shares() : shares_of(eye, facets, lit);
  label.in_sight_share = shares.in_sight;
  label.in_view_share = shares.in_view;
  // A line to the middle of a solid ends behind its own face.
  if (!facets.empty()) label.middle.in_sight = shares.in_sight > 0.0;
  if (places_m.empty()) places_m.push_back(middle_m);
  for (const scenes::RunwayPlace& runway : scene.runways) {
    const RunwayGround ground(scene, runway, 0);
    for (const glm::dvec3& at_m : places_m)
      label.placement = std::min(label.placement,
                                 ground.placement_of(glm::dvec2(at_m), runway.strip_half_width_m));
  }
  return label;
}

// Masks of runways first, then of objects.
struct Masks {
  std::vector<MaskLabel> bscope, cscope;
};

Masks all_masks(const scenes::Scene& scene, const std::vector<LabelledThing>& things,
                const renderer::FrameLayers& layers) {
  const renderer::Geometry& geometry = *scene.world.geometry;
  const std::size_t runways = scene.runways.size();
  std::vector<std::uint32_t> label_of(geometry.object_names.size() + scene.world.targets.size(),
                                      kUnlabelled);
  for (std::size_t i = 0; i < runways; ++i)
    for (const std::uint32_t id : runway_ids(geometry, i))
      label_of[id] = static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i < things.size(); ++i)
    for (const std::uint32_t id : things[i].ids)
      label_of[id] = static_cast<std::uint32_t>(runways + i);
  const int columns = scene.description.sensor.scan.columns;
  const std::size_t labels = runways + things.size();
  Masks masks;
  masks.bscope = masks_of(layers.bscope, columns, label_of, labels, true);
  masks.cscope = layers.cscope.object.empty()
                     ? std::vector<MaskLabel>(labels)
                     : masks_of(layers.cscope, columns, label_of, labels, false);
  return masks;
}

}  // namespace

FrameLabels Labeller::labels(const scenes::Scene& scene, const core::Pose& pose,
                             const renderer::Frame& frame) const {
  const Eye eye(scene, pose);
  const sensors::Sensor& sensor = scene.description.sensor;
  Masks masks = all_masks(scene, known_->things, *frame.layers);
  FrameLabels result;
  for (std::size_t i = 0; i < scene.runways.size(); ++i) {
    result.runways.push_back(runway_label(eye, scene.runways[i]));
    result.runways.back().bscope = std::move(masks.bscope[i]);
    result.runways.back().cscope = std::move(masks.cscope[i]);
  }
  const int reach =
      static_cast<int>(std::ceil(sensor.antenna.azimuth.cut_rad / sensor.scan.column_width_rad()));
  std::vector<ObjectLabel> objects(known_->things.size());
  core::parallel_for(objects.size(), [&](std::size_t i) {
    MaskLabel &bscope = masks.bscope[scene.runways.size() + i],
              &cscope = masks.cscope[scene.runways.size() + i];
    const bool lit = !bscope.cells.empty() || !cscope.cells.empty();
    objects[i] = object_label(eye, known_->things[i], known_->shapes, pose.time_s, lit);
    objects[i].bscope = std::move(bscope);
    objects[i].cscope = std::move(cscope);
    if (!objects[i].bscope.cells.empty())
      objects[i].signal_to_clutter_dB = signal_to_clutter_dB(
          objects[i].bscope, frame.bscope_W, sensor.scan.columns, reach, frame.noise_W);
  });
  for (ObjectLabel& object : objects)
    if (object.in_view_share > 0.0 || !object.bscope.cells.empty() || !object.cscope.cells.empty())
      result.objects.push_back(std::move(object));
  return result;
}

}  // namespace fanbeam::session
