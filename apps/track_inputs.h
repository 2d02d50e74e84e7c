// Which options go with an input of fanbeam track, and that input as a source.
#pragma once

#include <filesystem>
#include <memory>

#include "apps/track_command.h"
#include "session/signal/sources/track_input.h"

namespace fanbeam::apps {

// E-UNSUPPORTED for each option given that says nothing of this kind of input: exit code 2.
void refuse_other_options(const TrackOptions& options, session::TrackInput input);

// E-RANGE of --output for a folder with a record that `fanbeam track` has not written: exit code 2. E-IO
// where a file has the folder's place.
void check_output(const std::filesystem::path& folder);

session::BodyErrors body_errors(const TrackOptions& options);

// Of any input but road scenarios. Throws InputError for whatever is wrong with it.
std::unique_ptr<session::MeasuredSource> own_source(const TrackOptions& options,
                                                    session::TrackInput input);

}  // namespace fanbeam::apps
