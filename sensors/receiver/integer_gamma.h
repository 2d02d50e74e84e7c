// The regularised incomplete gamma function of whole order, the law of a sum of looks.
//
//     Q(n, x) = sum over k < n of e^-x x^k / k!
// The sum of n independent exponentials of mean 1 exceeds x with probability Q(n, x).
// Source: NIST Digital Library of Mathematical Functions, 8.4.10.
//
// n is 1 to 4096, x is 0 or more (infinity allowed). A sum of positive terms: relative accuracy
// 1e-11, also far in the tail, until the result underflows. Cost: n exponentials.
#pragma once

namespace fanbeam::sensors {

double upper_gamma(int n, double x);  // Q

// e^-x x^k / k!; 1 for k = 0 at x = 0.
double poisson_probability(int k, double x);

// The x with Q(n, x) = q, for q in (0, 1). Bisection to the last bits of x; relative accuracy 1e-12
// for q from 1e-300 to 0.9.
double upper_gamma_inverse(int n, double q);

}  // namespace fanbeam::sensors
