#include <string>

#include "bindings/c/fanbeam.h"
#include "session/version.h"

extern "C" {

const char* fanbeam_version_text() noexcept {
  static const std::string text = fanbeam::session::version_text();
  return text.c_str();
}

uint32_t fanbeam_version_number() noexcept { return FANBEAM_VERSION_NUMBER; }

}  // extern "C"
