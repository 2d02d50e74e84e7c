// How the loops over columns of pieces are written: raw pointers to columns that do not overlap, and
// loops marked so. The compiler makes vector code of nothing else here.
#pragma once

namespace fanbeam::renderer {

using Out = double*;
using In = const double*;
#if defined(__clang__)
#define FANBEAM_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define FANBEAM_INDEPENDENT _Pragma("GCC ivdep")
#endif

}  // namespace fanbeam::renderer
