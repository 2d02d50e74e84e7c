// A request over HTTP and what it is answered, without sockets.
#pragma once

#include <string>

namespace fanbeam::live {

struct Request {
  std::string method, target;  // target: with its query
  std::string host, origin, content_type;
  std::string body;
  std::string authorization{}, cookie{};
  std::string fetch_site{}, fetch_mode{};  // Sec-Fetch-Site and -Mode, which browsers send

  std::string path() const { return target.substr(0, target.find('?')); }
};

struct Answer {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::string location{}, set_cookie{}, allow{};  // headers, where they are not empty
};

// {"error": why}
Answer refusal(int status, const std::string& why);

}  // namespace fanbeam::live
