// Campaign files, and what their runs draw.
#include "datasets/campaign.h"

#include <cmath>

#include "datasets/draw.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("campaign.toml", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const datasets::Campaign campaign = datasets::read_campaign(file, problems);
    if (problems.has_errors()) return;
    fuzz::must(campaign.runs >= 1 && campaign.runs <= datasets::kMostRuns, "a bounded campaign");
    fuzz::must(!campaign.scenes.empty() && !campaign.products.empty(), "something to render");
    datasets::Drawer drawer(campaign);
    for (const int run : {0, campaign.runs / 2, campaign.runs - 1})
      for (const auto& [name, value] : drawer.draw(run).values)
        if (const auto* number = std::get_if<double>(&value))
          fuzz::must(std::isfinite(*number), "finite values");
  });
  return 0;
}
