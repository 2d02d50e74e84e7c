// fanbeam render: a scene's approach as pictures.
#pragma once

#include <string>

#include "apps/common.h"
#include "apps/scene_choice.h"
#include "session/render_request.h"

namespace fanbeam::apps {

struct RenderOptions : session::RenderRequest {
  std::string output;          // default out/<scene name>
  std::string preview_format;  // of kPreviewFormats; empty: mp4
  std::string range_unit;  // of the figure: one of kRangeUnits; empty: by how far the sensor sees
  int threads = 0;
  bool plan_per_frame = false;
  bool resume = false;
  bool overwrite = false;  // where other files are
};

// Returns an exit code; throws InputError for bad input. SIGINT and SIGTERM while frames are made
// end the process by that signal (a shell sees 130 or 143), within a second, with whole files only
// and without run.json.
int render(const RenderOptions& options, const CommonOptions& common);

}  // namespace fanbeam::apps
