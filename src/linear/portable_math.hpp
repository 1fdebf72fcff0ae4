// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ardrone_vslam::portable {

// Elementary functions with the same bits on every processor and with every C library, whose own
// differ in the last bit: one such bit makes a comparison fall otherwise, and poses differ by
// millimetres after minutes (docs/reliability.md, determinism). Made of sums, products, divisions
// and square roots, which IEEE 754 rounds in one way (with -ffp-contract=off).
//
// Errors: at most 3 units in the last place of the result, log1p 6, sine and cosine 2^-52 beside 0;
// of angles beyond 1e5 rad those of the remainder by 2 pi besides. What is not a number stays so.

double sin(double angle_rad);
double cos(double angle_rad);
double tan(double angle_rad);
/// From -pi to pi. 0 where both are 0.
double atan2(double y, double x);
double exp(double x);
/// -infinity of 0, not a number of what is below.
double log(double x);
/// log(1 + x), also of small x.
double log1p(double x);
/// Of squares that neither overflow nor vanish.
double hypot(double x, double y);

}  // namespace ardrone_vslam::portable
