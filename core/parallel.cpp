#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace fanbeam::core {

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, [&](std::size_t i) { body(i); },
                    tbb::simple_partitioner());
}

ThreadLimit::ThreadLimit(int threads)
    : control_(nullptr), threads_(threads > 0 ? threads : std::max(1, tbb::info::default_concurrency())) {
  control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace fanbeam::core
