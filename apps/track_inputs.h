// Which options go with an input of fanbeam track, and that input as a source.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/track_command.h"
#include "session/signal/sources/track_input.h"

namespace fanbeam::apps {

// E-UNSUPPORTED for each option given that says nothing of this kind of input: exit code 2.
void refuse_other_options(const TrackOptions& options, session::TrackInput input);

// Of --output, exit code 2: E-RANGE for a folder with a record that `fanbeam track` has not written, or without one
// and with a timing.json, or tables that are not its own in one of `parts`, where a run writes tables ("" for the
// folder itself); E-PATH for one where INPUT would be written over, or get tables among its files. E-IO where a file
// has the folder's place.
void check_output(const std::string& input, const std::filesystem::path& folder,
                  const std::vector<std::string>& parts);

session::BodyErrors body_errors(const TrackOptions& options);

// Of any input but road scenarios. Throws InputError for whatever is wrong with it.
std::unique_ptr<session::MeasuredSource> own_source(const TrackOptions& options,
                                                    session::TrackInput input);

}  // namespace fanbeam::apps
