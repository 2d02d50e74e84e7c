// How far a set of tracks is from the set of targets, in one number.
//
// With d the distance cut off at c, the least sum over assignments, n targets and m tracks:
//   OSPA  = ((min sum d^p + c^p |n - m|) / max(n, m))^(1/p)
//   GOSPA = (min sum d^p + c^p / alpha |n - m|)^(1/p)
// For alpha = 2, and only then, GOSPA is the root of a sum of three parts: location errors of
// assigned pairs, c^p / 2 for each missed target, c^p / 2 for each false track. A pair at c or
// beyond is one of each.
// Source: D. Schuhmacher, B.-T. Vo, B.-N. Vo, IEEE Trans. SP-56, 2008; A. S. Rahmathullah, A. F.
// Garcia-Fernandez, L. Svensson, "Generalized optimal sub-pattern assignment metric", FUSION 2017.
// Inputs: finite places; p 1 or more, c above 0, alpha in (0, 2]. E-NONFINITE, E-RANGE otherwise.
// Two empty sets are 0 apart.
#pragma once

#include <vector>

namespace fanbeam::tracking {

struct Place {
  double x_m = 0.0, y_m = 0.0;
};
double distance_m(const Place& a, const Place& b);

struct SetDistance {
  double order = 2.0;      // p
  double cut_off_m = 5.0;  // c
  double alpha = 2.0;      // of GOSPA
};

double ospa_m(const std::vector<Place>& targets, const std::vector<Place>& tracks,
              const SetDistance& settings);

struct Gospa {
  double total_m = 0.0;
  // Parts before the root, in m^p; of alpha = 2, otherwise 0.
  double location = 0.0, missed = 0.0, unwanted = 0.0;
};
Gospa gospa(const std::vector<Place>& targets, const std::vector<Place>& tracks,
            const SetDistance& settings);

}  // namespace fanbeam::tracking
