// What the border to C does with exceptions: none crosses it, and the thread that called is told.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "bindings/c/fanbeam.h"
#include "core/errors.h"

namespace fanbeam::bindings {

// Of this thread's last call.
struct LastCall {
  std::string error, warnings;
};
LastCall& last_call() noexcept;

void tell_warnings(const core::ProblemList& problems);

// Arguments that are refused for another reason than their value.
class RefusedCall : public core::InputError {
 public:
  RefusedCall(fanbeam_status status, const std::vector<core::Problem>& problems)
      : core::InputError(problems), status_(status) {}
  fanbeam_status status() const { return status_; }

 private:
  fanbeam_status status_;
};

// In a handler: what the exception comes to, and its words in `why`.
fanbeam_status status_of_exception(std::string& why) noexcept;

// Calls `act`, which says how it ended.
template <class Act>
fanbeam_status guarded(const Act& act) noexcept {
  LastCall& told = last_call();
  told.error.clear();
  told.warnings.clear();
  try {
    return act();
  } catch (...) {
    told.warnings.clear();
    return status_of_exception(told.error);
  }
}

}  // namespace fanbeam::bindings
