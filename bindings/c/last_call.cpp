#include "bindings/c/last_call.h"

#include <new>
#include <system_error>

#include "core/stop.h"

namespace fanbeam::bindings {
namespace {

fanbeam_status told(std::string& why) {
  try {
    throw;
  } catch (const RefusedCall& refused) {
    why = refused.what();
    return refused.status();
  } catch (const core::InputError& error) {
    why = error.what();
    return FANBEAM_BAD_INPUT;
  } catch (const core::Stopped& stopped) {
    why = stopped.what();
    return FANBEAM_STOPPED;
  } catch (const std::bad_alloc&) {
    why = "no memory";
    return FANBEAM_NO_RESOURCES;
  } catch (const std::system_error& error) {
    why = error.what();
    return error.code() == std::errc::resource_unavailable_try_again ? FANBEAM_NO_RESOURCES
                                                                     : FANBEAM_FAULT;
  } catch (const std::exception& bug) {
    why = std::string("a fault of fanbeam's: ") + bug.what();
    return FANBEAM_FAULT;
  } catch (...) {
    why = "a fault of fanbeam's";
    return FANBEAM_FAULT;
  }
}

}  // namespace

LastCall& last_call() noexcept {
  thread_local LastCall call;
  return call;
}

void tell_warnings(const core::ProblemList& problems) {
  std::string& text = last_call().warnings;
  for (const core::Problem& problem : problems.all()) {
    if (problem.is_error()) continue;
    if (!text.empty()) text += '\n';
    text += core::to_string(problem);
  }
}

fanbeam_status status_of_exception(std::string& why) noexcept {
  try {
    return told(why);
  } catch (...) {
    // Not even the words found room; these fit into any string.
    why = "no memory";
    return FANBEAM_NO_RESOURCES;
  }
}

}  // namespace fanbeam::bindings

extern "C" {

const char* fanbeam_last_error() noexcept { return fanbeam::bindings::last_call().error.c_str(); }

const char* fanbeam_last_warnings() noexcept {
  return fanbeam::bindings::last_call().warnings.c_str();
}

}  // extern "C"
