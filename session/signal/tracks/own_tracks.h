// Tracks of measurements that are at hand (session/signal/sources), and their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "session/signal/sources/measured_source.h"
#include "session/signal/tracks/own_history.h"
#include "session/signal/tracks/track_settings.h"

namespace fanbeam::session {

struct OwnTracks {
  // A track that was confirmed: moving in most of its frames, or not.
  struct Seen {
    int frames = 0, moving = 0;
  };
  // A target of a scene, all scatterers of a name: seen, and with a confirmed track within 4 m and
  // 2 m/s of it.
  struct Followed {
    int seen = 0, followed = 0;
  };
  std::string tracks, measurements;  // CSV
  std::map<std::string, Followed> targets;
  std::map<int, Seen> confirmed;  // by the track's number
  std::size_t detections = 0, measured = 0;
  int frames = 0;
  std::int64_t left_out = 0;  // by joint association
  double measuring_s = 0.0, tracking_s = 0.0;
  OwnHistory history;

  int moving() const;
};

// `progress` is told after each frame how many are done. Turns of targets are foreseen with the radar's velocity
// at the first frame; what moves is told by that at each.
OwnTracks track_source(MeasuredSource& source, const TrackSettings& settings,
                       const std::function<void(int done)>& progress);

// tracks.csv, measurements.csv, run.json, timing.json and, to `draw`, ranges and, where the radar tells azimuths, plan as SVG and PNG. Those that an
// earlier run.json there lists go.
void write_own_tracks(const OwnTracks& tracks, const MeasuredSource& source,
                      const TrackSettings& settings, const BodyErrors& errors, bool draw,
                      const std::filesystem::path& folder);

}  // namespace fanbeam::session
