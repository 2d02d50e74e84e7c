// How much additional power can change what a picture shows.
//
// A pixel of power P with a floor f, the largest power shown as black (GreyScale), shows
// max(P, f). Power p on top changes it by at most
//     10 log10(max(P + p, f) / max(P, f)) <= 10 log10(1 + p / max(f, N))
// whatever P >= N is, with N the mean noise where the plan shows it for certain, else 0. Pixels by
// picture:
//   B-scope  p is what is added to a range cell, f that row's floor, N the receiver's noise
//   C-scope of true elevation  p is what is added to a row's sum of P R^3, N that row's noise
//   C-scope of flat earth  a row adds up shares of at most 1 of the P R^3 of range cells. Near the
//            ground one row holds them all: p is the sum over every cell. Its noise has the same
//            shares, so that p / N of the row is at most the largest p / N of any cell: the
//            smaller of the two counts
//   C-scope of mode shadow  an obstacle is raised or not: the whole window, plan.cpp
// In one realisation of speckle (fluctuation.h) one draw s <= 22.88 multiplies all of a cell: the
// change is 10 log10(1 + p / max(f / s, N)).
// The bound is that of the worse of the pictures that are shown, the B-scope and, where heights are
// (SceneFacts), the C-scope of the sensor's mode; at most the window. Where watts are read (the
// products power and labels) they end at no black: f is 0.
// docs/effects.md has the derivation.
#pragma once

#include <vector>

#include "renderer/plan/scene_facts.h"

namespace fanbeam::renderer {

// Upper bounds of a power that an effect adds.
struct AddedPower {
  std::vector<double> cell_W;  // in any column of each range cell
  double row_W_m3 = 0.0;       // in any pixel of a C-scope of true elevation
};

double largest_change_dB(const AddedPower& added, const SceneFacts& facts);

// Of the display, as it is shown: grey 0 to 255.
double window_dB(const sensors::Sensor& sensor);

}  // namespace fanbeam::renderer
