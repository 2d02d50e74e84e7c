// The products "masks" and "cscope_masks": what each cell shows, as grey levels of a picture.
#pragma once

#include "core/image.h"
#include "session/labels/frame_labels.h"

namespace fanbeam::session {

// 0 nothing that has a label, 1 runway, 2 building, 3 box, 4 model, 5 lights, 6 target.
core::Picture8 bscope_mask(const FrameLabels& labels, const sensors::Sensor& sensor);
core::Picture8 cscope_mask(const FrameLabels& labels, const sensors::Sensor& sensor);

}  // namespace fanbeam::session
