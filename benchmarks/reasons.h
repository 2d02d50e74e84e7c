// Why targets are missed, as docs/performance-notes.md has found out.
#pragma once

#include "benchmarks/verdict.h"

namespace fanbeam::benchmarks {

// Of targets that are met where the others were found out.
inline constexpr Reason kNotKnown{
    "not known: it was met when the reasons of others were looked for"};

inline constexpr Reason kCityNoise{
    "what bounces add over a city is noise that falls as one over the root of their time: halving "
    "it takes some 3.4 times as many of their rays"};
inline constexpr Reason kCityCoarsest{
    "the coarsest sampling takes some 20 ms over a city, nearly half of it for so few rays of "
    "bounces that their noise leads"};
inline constexpr Reason kCityRays{
    "slices, which need half to all of the time of rays at equal error, miss it too: for the noise "
    "of bounces"};
inline constexpr Reason kCityCut{
    "the fewest slices, one per column, take 10 to 12 ms over a city, nearly half of it for "
    "the walk, strips and crossings"};
inline constexpr Reason kFewRays{
    "11 ms hold a tenth of a million rays, half a ray per range cell, and bounces have their share "
    "of them: slices, which the default takes over buildings, meet it"};
inline constexpr Reason kNaiveBounces{
    "at this error bounces take most of the time of slices over a city, and they are rays for any "
    "caster: slices save time on surfaces alone"};
inline constexpr Reason kOurLoops{
    "our loops beside the library's are vector code already, and no part of them stands out; an "
    "earlier Xeon took 31 ns"};
inline constexpr Reason kAllNeeded{
    "the default scene needs every effect of an expected picture: all that the plan leaves out is "
    "speckle, some 2 ms"};
inline constexpr Reason kCityFrame{
    "bounces take most of a frame over a city, and with fewer of their rays its error, which is "
    "missed as well, would be larger"};
inline constexpr Reason kCityFrameV3{
    "as with v4, bounces take most of a frame over a city; packets of 8 rays instead of 16 come on "
    "top"};
inline constexpr Reason kLayerPass{
    "ground truth is a pass of its own, which weighs most where the picture is cheap: 5 ms beside "
    "the 14 of flat-grass"};

}  // namespace fanbeam::benchmarks
