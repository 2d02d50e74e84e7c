// What fanbeam doctor has to say of a scene.
#pragma once

#include <string>
#include <vector>

namespace fanbeam::scenes {

// note      true of the scene and worth knowing; nothing has to be done
// delicate  the picture is right as far as the scene is meant so, and small changes move it
// wrong     the picture does not show what the scene describes
enum class Severity { note, delicate, wrong };

struct Finding {
  Severity severity = Severity::note;
  std::string check;  // "runway-off-terrain"; docs/doctor.md lists all
  std::string what;   // what was found
  std::string where;  // file and line, object, coordinates
  double figure = 0.0;
  std::string unit;    // of the figure; empty for a ratio or count
  std::string why;     // why it matters
  std::string remedy;  // what to do
};

using Findings = std::vector<Finding>;

}  // namespace fanbeam::scenes
