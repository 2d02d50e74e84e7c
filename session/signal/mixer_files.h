// A mixer's trace for people: tables and a picture.
#pragma once

#include <filesystem>
#include <string>

#include "signal/receiver/mixer.h"

namespace fanbeam::session {

// DIR/mixer.csv: the first 20 000 samples of what goes in and what comes out;
// DIR/beat.csv: all samples of the beat; DIR/mixer.png: both. Throws InputError E-RANGE of --mixer where files of these
// names are somebody's: tables with other columns, a picture without its table.
void write_mixer(const std::filesystem::path& folder, const signal::MixerTrace& trace,
                 const std::string& title);

}  // namespace fanbeam::session
