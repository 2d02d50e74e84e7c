// The figures of image regression against values worked out by hand.
#include "core/image_compare.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/errors.h"

using namespace fanbeam::core;

namespace {

Image layer(const std::string& name, int columns, int rows, std::vector<double> values) {
  return {columns, rows, {{name, std::move(values)}}};
}

std::string message_of(const Image& a, const Image& b) {
  try {
    compare_images(a, b, "a.png", "b.png");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("Equal images differ by nothing, in any figure", "[image_compare]") {
  const Image image = layer("Y", 3, 2, {0, 1, 2, 3, 4, 255});
  const LayerDifference same = compare_images(image, image, "a", "b").at(0);
  CHECK(same.layer == "Y");
  CHECK(same.cells == 6);
  CHECK(same.different == 0);
  for (const double figure :
       {same.mean, same.rms, same.largest, same.mean_dB, same.rms_dB, same.largest_dB})
    CHECK(figure == 0.0);
  CHECK(same.only_one_positive == 0);
}

TEST_CASE("Mean, RMS, largest difference and its cell", "[image_compare]") {
  // B - A = 0, 3, -1, 0, 0, -4: sum -2, squares 26.
  const LayerDifference d = compare_images(layer("Y", 3, 2, {10, 10, 10, 10, 10, 10}),
                                           layer("Y", 3, 2, {10, 13, 9, 10, 10, 6}), "a", "b")
                                .at(0);
  CHECK(d.different == 3);
  CHECK(d.mean == Approx(-2.0 / 6.0));
  CHECK(d.rms == Approx(std::sqrt(26.0 / 6.0)));
  CHECK(d.largest == 4.0);
  CHECK(d.largest_column == 2);
  CHECK(d.largest_row == 1);
}

// It was never the largest.
TEST_CASE("A cell that is no number is the largest difference", "[image_compare]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::pair<double, double> odd[] = {
      {1.0, nan}, {nan, 1.0}, {nan, nan}, {1.0, infinite}, {infinite, nan}};
  for (const auto& [value_a, value_b] : odd) {
    INFO(value_a << " against " << value_b);
    std::vector<double> a(1000, 1.0), b(1000);
    for (std::size_t i = 0; i < 1000; ++i) b[i] = 1.0 + static_cast<double>(i % 500);
    a[207] = value_a;
    b[207] = value_b;
    const LayerDifference d =
        compare_images(layer("range_m", 100, 10, a), layer("range_m", 100, 10, b), "a", "b").at(0);
    CHECK(d.not_finite == 1);
    CHECK(std::isinf(d.largest));
    CHECK(d.largest_column == 7);
    CHECK(d.largest_row == 2);
    CHECK(d.different == 998);  // all but the two of 1
  }
  const Image none = layer("range_m", 2, 1, {nan, nan});
  const LayerDifference d = compare_images(none, none, "a", "b").at(0);
  CHECK(d.not_finite == 2);
  const Image most = layer("power_W", 2, 1, {infinite, 1.0});
  const LayerDifference equal = compare_images(most, most, "a", "b").at(0);
  CHECK(equal.different + equal.not_finite == 0);
  CHECK(equal.rms_dB == 0.0);
}

TEST_CASE("Power is compared in dB where both are lit, and counted where only one is",
          "[image_compare]") {
  // +10 dB, -10 dB, +20 dB; one lit in A only, one in B only; both dark.
  const LayerDifference d =
      compare_images(layer("power_W", 6, 1, {1e-12, 1e-12, 1e-14, 1e-12, 0, 0}),
                     layer("power_W", 6, 1, {1e-11, 1e-13, 1e-12, 0, 1e-12, 0}), "a", "b")
          .at(0);
  CHECK(d.both_positive == 3);
  CHECK(d.only_one_positive == 2);
  CHECK(d.mean_dB == Approx(20.0 / 3.0));
  CHECK(d.rms_dB == Approx(std::sqrt(600.0 / 3.0)));
  CHECK(d.largest_dB == Approx(20.0));
  CHECK(d.largest_dB_column == 2);  // the largest in watts is in column 0
  CHECK(d.largest_column == 0);
  CHECK(d.different == 5);
}

TEST_CASE("Layers pair by name, not by order", "[image_compare]") {
  const Image a{2, 1, {{"range_m", {1, 2}}, {"power_W", {5, 6}}}};
  const Image b{2, 1, {{"power_W", {5, 6}}, {"range_m", {1, 3}}}};
  const std::vector<LayerDifference> differences = compare_images(a, b, "a", "b");
  REQUIRE(differences.size() == 2);
  CHECK(differences[0].layer == "range_m");
  CHECK(differences[0].largest == 1.0);
  CHECK(differences[1].different == 0);
}

TEST_CASE("Sizes or layers that do not match are E-REF and name both files", "[image_compare]") {
  const Image a = layer("Y", 2, 2, {1, 2, 3, 4});
  CHECK(message_of(a, layer("Y", 4, 1, {1, 2, 3, 4})) ==
        "b.png: E-REF size = 4 x 1, 1 layers: expected 2 x 2, 1 layers as in a.png");
  CHECK(message_of(a, layer("R", 2, 2, {1, 2, 3, 4})) ==
        "b.png: E-REF layer = missing: expected \"Y\" as in a.png; there are R");
  CHECK(message_of(a, Image{2, 2, {}}) ==
        "b.png: E-REF size = 2 x 2, 0 layers: expected 2 x 2, 1 layers as in a.png");
}
