// Why single cells of converged slices and converged rays are clearly apart: every such cell gets
// the first cause that a further picture shows, and is listed where none does.
//
//   reference     a second reference with another seed is more than half as far from the first, or
//                 the cell is not clearly apart from that one
//   slices        the cell comes back with four times the slices
//   left to rays  it comes back when, beside that, the azimuths that slices leave to rays, which
//                 cast few azimuths there, are cast like the reference
//   border        both pictures hold a sliver of something bright in the next cell: they differ by
//                 less than kSliver of the brightest neighbour's power, which a border between the
//                 two cells that is known to that share of a cell explains
//
// "Comes back" means at most kClearlyOff_grey from one of the two references. Noise-free grey is
// judged: with noise in both pictures cells are closer together, never farther apart.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "benchmarks/bench_scene.h"
#include "benchmarks/report_effort.h"
#include "benchmarks/view_clock.h"

namespace fanbeam::benchmarks {

inline constexpr double kClearlyOff_grey = 4.0;
inline constexpr double kSliver = 0.01;

enum class OffCause { reference, slices, left_to_rays, border, unexplained, count };
inline constexpr auto kOffCauses = static_cast<std::size_t>(OffCause::count);
inline constexpr std::array<const char*, kOffCauses> kOffCauseNames{
    "reference", "slices", "left to rays", "border", "unexplained"};

struct OffCell {
  std::size_t row = 0, column = 0;  // row 0: nearest range, highest elevation
  OffCause cause = OffCause::unexplained;
  double grey = 0.0, reference_grey = 0.0, second_reference_grey = 0.0;
};

struct OffCells {
  std::vector<OffCell> bscope, cscope;
};

std::size_t count_of(const std::vector<OffCell>& cells, OffCause cause);

// `slices` and `reference` as casters made them, `slices` at effort.converged_slices. Renders what
// else it needs, and nothing where no cell is off.
OffCells explain_off_cells(const View& view, const Effort& effort, const FramePower& slices,
                           const FramePower& reference);

}  // namespace fanbeam::benchmarks
