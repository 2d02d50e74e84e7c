#include "bindings/python/interruptible.h"

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <chrono>
#include <exception>
#include <future>
#include <optional>

namespace fanbeam::bindings {
namespace {

namespace py = pybind11;

bool on_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

// A thread that asks for the lock while Python ends is ended there by pthread_exit, which unwinds like an
// exception, but through nothing that may not throw: it would end the program. Python waits for no such thread.
void take_lock(PyThreadState* state) {
  try {
    PyEval_RestoreThread(state);
  } catch (...) {
    for (;;) ::pause();
  }
}

// py::gil_scoped_release asks for the lock in its destructor.
void run_unlocked(const std::function<void()>& work) {
  PyThreadState* const state = PyEval_SaveThread();
  std::exception_ptr thrown;
  try {
    work();
  } catch (...) {
    thrown = std::current_exception();
  }
  take_lock(state);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace

void without_lock(const std::function<void(const core::StopToken&)>& work) {
  core::StopSource stop;
  const core::StopToken token = stop.token();
  if (!on_main_thread()) return run_unlocked([&] { work(token); });
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
  } catch (...) {  // stopped, or it failed at that moment: the handler's goes up whatever it was
  }
  throw py::error_already_set(*raised);
}

}  // namespace fanbeam::bindings
