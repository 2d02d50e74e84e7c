// The plots beside tracks, which the run.json of their folder lists: those that an earlier run of `fanbeam track` drew
// are of other tracks and go; a file of such a name that no record lists is somebody's own.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "session/plots/gnuplot.h"

namespace fanbeam::session {

class TrackPlots {
 public:
  // Reads what the record there lists: nothing where it is missing or cannot be read.
  explicit TrackPlots(std::filesystem::path folder);

  // As SVG and PNG; `name` is relative to the folder, "X1/ranges".
  void remove_earlier(const std::string& name);
  void draw(const Plot& plot, const std::string& name);

  // All that are there, relative to the folder, for its record.
  const std::set<std::string>& files() const { return files_; }

 private:
  std::filesystem::path folder_;
  std::set<std::string> files_;
};

}  // namespace fanbeam::session
