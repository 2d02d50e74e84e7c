// What the report says of the errors that frames state.
#include "benchmarks/estimate_check.h"

#include <catch2/catch.hpp>

using namespace fanbeam::benchmarks;

TEST_CASE("Errors that nobody sees are told apart and count for nothing", "[bench]") {
  const auto of = [](double estimate_grey, double true_grey) {
    return EstimateCase{"flat-grass", 0, "rays, default", "B-scope", estimate_grey, true_grey};
  };
  // Two right, one that is told too small, and three below 0.05 grey.
  const std::vector<EstimateCase> cases = {of(1.0, 1.2),    of(0.06, 0.045), of(0.04, 0.08),
                                           of(0.001, 0.04), of(0.04, 0.001), of(0.0, 0.0)};
  const EstimateTally tally = tally_of(cases);
  CHECK(tally.within == 2);
  CHECK(tally.seen == 3);
  CHECK(tally.unseen == 3);
  CHECK(tally.share() == Approx(2.0 / 3.0));
  CHECK(estimates_markdown(cases).find("\n2 of 3 within a factor of 1.5; 3 more are below 0.05 "
                                       "grey in both, where nobody sees an error.\n") !=
        std::string::npos);
  CHECK(tally_of({}).share() == 1.0);
}
