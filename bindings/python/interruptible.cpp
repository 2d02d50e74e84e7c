#include "bindings/python/interruptible.h"

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>
#include <optional>

namespace fanbeam::bindings {
namespace {

namespace py = pybind11;

bool on_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

void without_lock(const std::function<void(const core::StopToken&)>& work) {
  core::StopSource stop;
  const core::StopToken token = stop.token();
  if (!on_main_thread()) {
    const py::gil_scoped_release released;
    work(token);
    return;
  }
  std::optional<py::error_already_set> raised;
  std::future<void> done = std::async(std::launch::async, [&] { work(token); });
  for (;;) {
    {
      const py::gil_scoped_release released;
      if (raised) done.wait();
      if (done.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready) break;
    }
    if (PyErr_CheckSignals() == 0) continue;
    raised.emplace();
    stop.request();
  }
  if (!raised) return done.get();
  try {
    done.get();
  } catch (const core::Stopped&) {
  }
  throw py::error_already_set(*raised);
}

}  // namespace fanbeam::bindings
