// Which fanbeam this is, as records and pictures say it.
#pragma once

#include <string>

namespace fanbeam::session {

std::string version_text();
std::string commit_text();
std::string date_text();  // of the commit, "2026-11-22"; empty where git is missing

}  // namespace fanbeam::session
