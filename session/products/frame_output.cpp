#include "session/products/frame_output.h"

#include <cmath>
#include <glm/mat3x3.hpp>

#include "session/labels/labels_json.h"
#include "session/products/detection_product.h"
#include "session/products/obstacle_product.h"
#include "session/records/frame_metadata.h"

namespace fanbeam::session {
namespace {

double antenna_heading_rad(const scenes::Scene& scene, const core::Pose& pose) {
  const renderer::FramePose at = scene.pose_at(pose);
  const glm::dvec3 forward =
      renderer::antenna_of(scene.description.sensor, at).forward * at.north_east_down;
  return std::atan2(forward.y, forward.x);
}

}  // namespace

bool want_labels(const ProductSet& products) {
  return products.contains("labels") || products.contains("masks") ||
         products.contains("cscope_masks");
}

FrameOutput frame_output(const scenes::Scene& scene, const OutputSettings& settings,
                         renderer::Frame frame, FrameRecord& record) {
  record.rays = frame.rays;
  record.slices = frame.slices;
  record.blanked = frame.blanked;
  record.unprojected = frame.unprojected;
  record.events = frame.events;
  record.error = frame.error;
  FrameOutput output{record.index, antenna_heading_rad(scene, record.pose), std::move(frame), {}};
  output.metadata = frame_metadata(scene, settings.sampling, record, settings.fingerprint);
  if (settings.products.contains("figure") || settings.products.contains("ppi_figure"))
    output.figure = figure_facts(scene, record.pose, record.index, settings.range_unit);
  if (settings.labeller != nullptr)
    output.labels = settings.labeller->labels(scene, record.pose, output.frame);
  if (settings.products.contains("labels"))
    output.labels_text = labels_json(output.labels, scene, static_cast<std::uint64_t>(record.index),
                                     record.pose, output.metadata);
  if (settings.products.contains("obstacles"))
    output.obstacle_table = obstacle_table(output.frame.obstacles, output.metadata);
  if (settings.products.contains("detections"))
    output.detection_table = detection_table(scene.description.sensor, record.index, record.time_s,
                                             output.metadata, output.frame.detections);
  return output;
}

}  // namespace fanbeam::session
