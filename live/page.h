// The page that a browser shows: pictures, read-out, weather, plan. HTML, UTF-8.
#pragma once

namespace fanbeam::live {

const char* page();

}  // namespace fanbeam::live
