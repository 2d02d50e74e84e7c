#include "session/products/mask_product.h"

namespace fanbeam::session {
namespace {

core::Picture8 drawn(const FrameLabels& labels, MaskLabel RunwayLabel::*of_runway,
                     MaskLabel ObjectLabel::*of_object, int columns, int rows) {
  core::Picture8 picture;
  picture.columns = columns;
  picture.rows = rows;
  picture.pixels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  const auto draw = [&](const MaskLabel& mask, int level) {
    for (const std::uint32_t cell : mask.cells) {
      const int column = static_cast<int>(cell) / rows, row = static_cast<int>(cell) % rows;
      picture.pixels[static_cast<std::size_t>(row * columns + column)] =
          static_cast<std::uint8_t>(level);
    }
  };
  for (const RunwayLabel& runway : labels.runways) draw(runway.*of_runway, 1);
  for (const ObjectLabel& object : labels.objects)
    draw(object.*of_object, 2 + static_cast<int>(object.group));
  return picture;
}

}  // namespace

core::Picture8 bscope_mask(const FrameLabels& labels, const sensors::Sensor& sensor) {
  return drawn(labels, &RunwayLabel::bscope, &ObjectLabel::bscope, sensor.scan.columns,
               sensor.range.cells);
}

core::Picture8 cscope_mask(const FrameLabels& labels, const sensors::Sensor& sensor) {
  return drawn(labels, &RunwayLabel::cscope, &ObjectLabel::cscope, sensor.scan.columns,
               sensor.display.cscope_rows);
}

}  // namespace fanbeam::session
