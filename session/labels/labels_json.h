// Labels as JSON, a frame at a time and all frames of a run together; docs/labels.schema.json is their
// schema. Degrees and metres; pixels as in place.h; masks as runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"
#include "session/labels/frame_labels.h"

namespace fanbeam::session {

// Lengths of runs of cells outside and inside a mask, in turn, beginning outside: column after column,
// each from the top, as COCO counts them. All rows x columns cells.
std::vector<std::uint32_t> runs_of(const MaskLabel& mask, std::uint32_t cells);

// `metadata` is the frame's (frame_metadata.h).
std::string labels_json(const FrameLabels& labels, const scenes::Scene& scene, std::uint64_t frame,
                        const core::Pose& pose, const core::Metadata& metadata);

// What labels_json said of metadata. Throws InputError E-PARSE for text that is no such file.
core::Metadata labels_metadata(const std::string& text, const std::string& name);

}  // namespace fanbeam::session
