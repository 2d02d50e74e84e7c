// Runs a test program so that a floating-point operation of ours that has no answer ends it there
// and then: invalid (0/0, inf - inf, the root or logarithm of a negative number, a number that does
// not fit its integer), division by zero, overflow. A check behind would only see the NaN, or a
// clamp that happens to hide it.
//
// Asked for by FANBEAM_FP_TRAPS=1 in the environment; without it nothing changes. x86-64 Linux and
// SSE arithmetic, which is all but long double.
//
// Ours is what stands in the program itself, headers of libraries included, and what it calls in
// libm. An operation in any other shared library (Embree, GDAL, PROJ, OpenImageIO) is stepped over:
// those use infinities and NaN on purpose. So are comparisons, minima and maxima with a NaN, since
// that is how a check finds one; what makes a NaN is caught where it is made. So are operations on
// all lanes of a register: of `x > 0 ? sqrt(x) : 0` the compiler makes roots of which it throws some
// away, and nobody can tell these from the others. What vectorised loops answer is left to the tests
// against closed forms. Embree is entered with traps held off, or stepping would take most of the
// time.
#pragma once

namespace fanbeam::tests {

// For main: from here on in this thread, in all that it starts, and in oneTBB's workers.
void set_fp_traps_as_asked();

bool fp_traps_are_set();

}  // namespace fanbeam::tests
