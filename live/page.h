// What is sent as it stands, UTF-8.
#pragma once

namespace fanbeam::live {

// The page that a browser shows: pictures, read-out, weather, plan. HTML.
const char* page();
// What can be asked, and how it is answered: OpenAPI 3.1.
const char* openapi();

}  // namespace fanbeam::live
