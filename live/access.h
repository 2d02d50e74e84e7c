// Who may look and steer.
//
// On loopback, with no token: requests for this machine by name (`Host` localhost, [::1] or an address of
// 127.0.0.0/8 in numbers: no name that somebody else's server resolves) and from fanbeam's own page
// (`Origin`, where there is one).
//
// With a token, which whoever listens beyond loopback must have: every request carries it, as
// "Authorization: Bearer TOKEN" or as the cookie that GET /?token=TOKEN hands out, which a browser
// sends to no page of another site (SameSite=Strict) and shows to no script (HttpOnly). Nothing is
// encrypted: over a network that others can read, use ssh -L.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/errors.h"
#include "live/request.h"

namespace fanbeam::live {

class Access {
 public:
  Access() = default;
  // Throws InputError E-RANGE unless it is 16 to 256 letters, digits, - . _ or ~.
  Access(std::string token, const core::Place& from);

  bool has_token() const { return !token_.empty(); }

  // Nothing for a request that may come in.
  std::optional<Answer> refuse(const Request& request) const;

 private:
  std::string token_;
};

// Of a file with the token on its only line. Throws InputError: E-IO, and as Access().
Access access_from(const std::filesystem::path& file);

}  // namespace fanbeam::live
