// How tangled a polygon is: what its repair costs. Private: carries OGR's type.
#pragma once

#include <ogr_geometry.h>

#include <cstddef>

namespace fanbeam::terrain {

// Pairs of edges, of all rings together and not neighbours in one, that meet. Counts no further
// than `most`, and answers `most` as well when looking for them would take too long (some 1e8
// comparisons). Cost: n log n, and the pairs that overlap from west to east.
std::size_t crossings(const OGRPolygon& polygon, std::size_t most);

}  // namespace fanbeam::terrain
