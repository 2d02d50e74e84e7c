// Marks beside a picture that say where in it something lies, so that its pixels stay untouched.
#pragma once

#include <string>
#include <vector>

#include "session/figure/canvas.h"

namespace fanbeam::session {

struct Mark {
  int tip = 0;           // pixel along the side of the picture that the wedge points at
  int from = 0, to = 0;  // what a bar spans; none where both are the tip
  std::string text;
  core::Colour ink{};
};

inline constexpr int kMarkRows = 24;  // above a picture, text included

// Texts that would overlap are moved apart, those beside the picture at the end of a leader.
void draw_marks_above(Canvas& canvas, const Box& picture, std::vector<Mark> marks);
void draw_marks_right(Canvas& canvas, const Box& picture, std::vector<Mark> marks);

// Wedges that point at a picture's left side, without text.
void draw_wedge_left(Canvas& canvas, const Box& picture, int tip, core::Colour ink);

}  // namespace fanbeam::session
