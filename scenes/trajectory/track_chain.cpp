#include "scenes/trajectory/track_chain.h"

#include <algorithm>
#include <limits>

namespace fanbeam::scenes {
namespace {

constexpr std::size_t kNoStretch = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kLookBack = 16;
// A wrong row can make the step behind it look right and the one before its neighbour wrong.
constexpr std::size_t kLooseRows = 2;

// Neighbouring rows, and the best chain that ends with them.
struct Stretch {
  std::size_t begin = 0, end = 0;  // one past the last
  double worth = 0.0;              // rows kept, less the strains between stretches
  std::size_t before = kNoStretch;
};

std::vector<Stretch> stretches_of(std::size_t count, const Strain& strain) {
  std::vector<bool> border(count, false);  // behind the row
  bool whole = true;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (!(strain(i, i + 1) > 1.0)) continue;
    whole = false;
    const std::size_t first = i > kLooseRows ? i - kLooseRows : 0;
    for (std::size_t k = first; k <= std::min(i + kLooseRows, count - 1); ++k) border[k] = true;
  }
  std::vector<Stretch> stretches;
  if (whole) return stretches;
  for (std::size_t begin = 0, i = 0; i < count; ++i) {
    if (!border[i] && i + 1 < count) continue;
    stretches.push_back({begin, i + 1, static_cast<double>(i + 1 - begin), kNoStretch});
    begin = i + 1;
  }
  return stretches;
}

bool better(const Stretch& a, const Stretch& b) { return a.worth > b.worth; }

void link(std::vector<Stretch>& stretches, std::size_t from, Stretch& to, const Strain& strain) {
  const double rows = stretches[from].worth + static_cast<double>(to.end - to.begin);
  if (rows <= to.worth) return;
  const double step = strain(stretches[from].end - 1, to.begin);
  if (step > 1.0) return;
  const Stretch linked{to.begin, to.end, rows - step, from};
  if (better(linked, to)) to = linked;
}

}  // namespace

std::vector<std::size_t> rows_off_the_chain(std::size_t count, const Strain& strain) {
  std::vector<std::size_t> off;
  std::vector<Stretch> stretches = stretches_of(count, strain);
  if (stretches.empty()) return off;
  std::size_t best_far = kNoStretch;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    Stretch to = stretches[k];
    for (std::size_t back = 1; back <= std::min(k, kLookBack); ++back)
      link(stretches, k - back, to, strain);
    if (k > kLookBack) {
      const std::size_t far = k - kLookBack - 1;
      if (best_far == kNoStretch || better(stretches[far], stretches[best_far])) best_far = far;
      link(stretches, best_far, to, strain);
    }
    stretches[k] = to;
  }
  const auto best = std::min_element(stretches.begin(), stretches.end(), better);
  std::size_t on = static_cast<std::size_t>(best - stretches.begin());
  std::vector<bool> kept(count, false);
  for (; on != kNoStretch; on = stretches[on].before)
    for (std::size_t i = stretches[on].begin; i < stretches[on].end; ++i) kept[i] = true;
  for (std::size_t i = 0; i < count; ++i)
    if (!kept[i]) off.push_back(i);
  return off;
}

}  // namespace fanbeam::scenes
