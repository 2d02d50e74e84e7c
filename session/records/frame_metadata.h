// What a picture says of itself, and reading it back to go on with an interrupted run.
#pragma once

#include <filesystem>
#include <string>

#include "core/image.h"
#include "scenes/scene.h"
#include "session/products/frame_writer.h"
#include "session/records/run_record.h"

namespace fanbeam::session {

// `fingerprint` tells the run's input from every other.
core::Metadata frame_metadata(const scenes::Scene& scene, const renderer::Sampling& sampling,
                              const FrameRecord& record, const std::string& fingerprint);

// What frame_metadata said to a picture, a table or labels that were written with it; nothing where they
// have none. Throws InputError for a damaged file.
core::Metadata metadata_of(const std::filesystem::path& file);

// Fills `record` with what an earlier run with the same input left of this frame; false when any
// product is missing, damaged (a table as far as is_whole_table tells) or of another input.
bool take_over(const std::filesystem::path& folder, const ProductSet& products,
               const std::string& fingerprint, FrameRecord& record);

}  // namespace fanbeam::session
