// What was found or guessed while a scene was made, and why.
#pragma once

#include <string>
#include <vector>

namespace fanbeam::scenes {

struct Note {
  std::string label;  // "vertical datum"
  std::string text;
  bool guess = false;  // not in the data: worth a look
};
using Notes = std::vector<Note>;

}  // namespace fanbeam::scenes
