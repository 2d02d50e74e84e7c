#include "scenes/trajectory/trajectory_builder.h"

#include "scenes/trajectory/track_check.h"
#include "scenes/trajectory/trajectory_transplant.h"

namespace fanbeam::scenes {
namespace {

std::optional<Trajectory> from_file(const SceneDescription& scene, const Ground& ground,
                                    core::ProblemList& problems) {
  const TrajectoryDescription& description = scene.trajectory;
  core::ProblemList found;  // told whatever else is wrong in the scene
  RawTrack track =
      description.packets.protocol != nullptr
          ? read_track_packets(description.file, description.packets, description.columns, found)
          : read_track_csv(description.file, description.columns, found);
  if (!found.has_errors())
    check_track(track, description.columns, description.assumptions.smoothing, found);
  problems.append(found.all());
  if (problems.has_errors()) return std::nullopt;
  for (TrackRow& row : track.rows)
    row.position.height_m = ground.ellipsoidal_m(row.position.height_m, row.position.latitude_rad,
                                                 row.position.longitude_rad, description.datum);
  Trajectory flight = trajectory_from(track, description.assumptions, problems);
  if (!description.transplanted) return flight;
  const auto onto = ground.landing_end(description.onto_end);
  if (!onto) return std::nullopt;
  core::Geodetic source = description.source_threshold;
  source.height_m = ground.ellipsoidal_m(source.height_m, source.latitude_rad, source.longitude_rad,
                                         description.datum);
  return transplant(flight, {source, description.source_bearing_rad},
                    {ground.threshold(*onto), ground.bearing_rad(*onto)});
}

std::optional<Trajectory> from_ils(const SceneDescription& scene, const Ground& ground,
                                   const terrain::LocalFrame& frame) {
  const TrajectoryDescription& description = scene.trajectory;
  const auto end = ground.landing_end(description.ils_end);
  if (!end) return std::nullopt;
  IlsApproach approach = description.ils;
  approach.threshold = ground.threshold(*end);
  approach.runway_bearing_rad = ground.bearing_rad(*end);
  const terrain::RunwayEnd* ends = end->runway->ends;
  approach.runway_slope =
      (ends[1 - end->end].elevation_m - ends[end->end].elevation_m) / end->runway->length_m();
  return fly_ils_approach(approach, frame);
}

std::optional<Trajectory> fixed(const SceneDescription& scene, const Ground& ground,
                                const terrain::LocalFrame& frame) {
  const TrajectoryDescription& description = scene.trajectory;
  const std::optional<glm::dvec2> at_m = ground.local_m(description.at);
  if (!at_m) return std::nullopt;
  core::Pose pose;
  pose.position = frame.to_geodetic(ground.on_ground_m(*at_m, description.above_ground_m));
  if (!description.at.on_runway) {  // at a pole the way back would lose the longitude, and north
    pose.position.latitude_rad = description.at.latitude_rad;
    pose.position.longitude_rad = description.at.longitude_rad;
  }
  pose.q_NB =
      core::quaternion_from({description.roll_rad, description.pitch_rad, description.heading_rad});
  return Trajectory({pose});
}

}  // namespace

std::optional<Trajectory> build_trajectory(const SceneDescription& scene, const Ground& ground,
                                           const terrain::LocalFrame& frame,
                                           core::ProblemList& problems) {
  try {
    switch (scene.trajectory.kind) {
      case TrajectoryDescription::Kind::none:
        break;
      case TrajectoryDescription::Kind::file:
        return from_file(scene, ground, problems);
      case TrajectoryDescription::Kind::ils:
        return from_ils(scene, ground, frame);
      case TrajectoryDescription::Kind::fixed:
        return fixed(scene, ground, frame);
    }
  } catch (const core::InputError& error) {
    for (core::Problem problem : error.problems()) {
      if (problem.place.file.empty()) problem.place = scene.trajectory.place;
      problems.append({problem});
    }
  }
  return std::nullopt;
}

}  // namespace fanbeam::scenes
