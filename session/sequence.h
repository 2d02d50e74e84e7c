// Frames of a scene's flight on disk: pictures, tables and films while the next frames are rendered,
// and the records of how they came about.
//
// A stop (core/stop.h) leaves whole files alone, and no record; another run with `resume` goes on
// from there.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "session/products/products.h"
#include "session/records/run_record.h"
#include "session/sampling_choice.h"
#include "session/session.h"

namespace fanbeam::session {

struct SequenceSettings {
  std::filesystem::path output{};  // empty: out/<scene name>
  std::string frames{};            // as parse_frames takes it
  ProductSet products{};
  SamplingRequest sampling{};          // as with_accuracy_of gives it
  std::string preview_format = "mp4";  // of kPreviewFormats
  std::string range_unit{};  // of figures: one of kRangeUnits; empty: by how far the sensor sees
  bool plan_per_frame = false;
  bool resume = false;     // keep frames of the same input that are there
  bool overwrite = false;  // where other files are
};

// Hears how many frames are done, of how many: 0 before the first one.
using ProgressListener = std::function<void(int done, int total)>;

struct ProductPlace {
  std::string name;
  std::filesystem::path path;
};

struct Sequence {
  RunRecord record;
  std::vector<ProductPlace> places;  // of the products, and of the record at the end
  int asked = 0;    // frames asked for: the record has those too that were there beside them
  int resumed = 0;  // of these, not rendered again
  int removed = 0;  // frames of another input that were there
};

// Sets the session's sampling; no `set` may come in between. Throws InputError: E-REF for every name
// in `settings` that is not known and for products that the session was not opened for (plan_for), as
// parse_frames, as OutputFolder, E-IO.
Sequence render_sequence(Session& session, const SequenceSettings& settings,
                         const ProgressListener& progress);

}  // namespace fanbeam::session
