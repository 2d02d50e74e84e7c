#include "session/version.h"

#include "session/version_private.h"

namespace fanbeam::session {

std::string version_text() { return kVersion; }
std::string commit_text() { return kCommit; }
std::string date_text() { return kDate; }

}  // namespace fanbeam::session
