// Where the aircraft is, for whoever asks once a frame.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "live/flights.h"
#include "live/journal.h"
#include "live/mailbox.h"
#include "terrain/local_frame.h"

namespace fanbeam::live {

// A pose and how old the news is that it was made of.
struct Sighting {
  core::Pose pose;
  double age_s = 0.0;
  std::uint64_t strays = 0;  // so far, of the poses told: predictor.h
};
// Where the aircraft is at `at_s`, as far as it is known at `now_s`, both seconds since the channel
// began; nothing before anything is known.
using PoseSource = std::function<std::optional<Sighting>(double now_s, double at_s)>;

PoseSource source_of(Flight flight);
// What live/predictor.h makes of the letters, which go into `journal` unless it is null. Both must
// outlive it.
PoseSource source_of(const Mailbox& mailbox, const terrain::LocalFrame& frame,
                     Clock::time_point begin, Journal* journal = nullptr);

}  // namespace fanbeam::live
