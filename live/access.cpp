#include "live/access.h"

#include <arpa/inet.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::live {
namespace {

constexpr std::size_t kShortest = 16, kLongest = 256;

// "localhost:8416" to "localhost", "[::1]:8416" to "[::1]".
std::size_t end_of_name(const std::string& host) {
  const std::size_t bracket = host.find(']');
  return host.find(':', bracket == std::string::npos ? 0 : bracket);
}

// Of four numbers: no name that somebody could resolve to here.
bool is_loopback(const std::string& name) {
  in_addr address{};
  return ::inet_pton(AF_INET, name.c_str(), &address) == 1 && ntohl(address.s_addr) >> 24U == 127U;
}

bool is_here(const std::string& host) {
  const std::string name = host.substr(0, end_of_name(host));
  return name == "localhost" || name == "[::1]" || is_loopback(name);
}

// In a time that tells nothing of how much of it is right.
bool is_same(std::string_view given, std::string_view token) {
  unsigned difference = given.size() == token.size() ? 0U : 1U;
  for (std::size_t i = 0; i < given.size(); ++i)
    difference |=
        static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i % token.size()]);
  return difference == 0U;
}

// Browsers do not tell a machine's ports apart.
std::string cookie_name(const std::string& host) {
  const std::size_t colon = end_of_name(host);
  return "fanbeam_" + (colon == std::string::npos ? "80" : host.substr(colon + 1));
}

// "x" of "a=b; name=x; c=d".
std::string_view cookie_in(std::string_view cookies, const std::string& name) {
  for (std::size_t at = 0; at < cookies.size();) {
    const std::size_t end = std::min(cookies.find(';', at), cookies.size());
    const std::string_view one = cookies.substr(at, end - at);
    if (one.starts_with(name + "=")) return one.substr(name.size() + 1);
    at = std::min(cookies.find_first_not_of("; ", end), cookies.size());
  }
  return {};
}

}  // namespace

Access::Access(std::string token, const core::Place& from) : token_(std::move(token)) {
  const bool plain = std::all_of(token_.begin(), token_.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') ||
           std::string_view("-._~").find(letter) != std::string_view::npos;
  });
  if (!plain || token_.size() < kShortest || token_.size() > kLongest)
    core::throw_input_error(core::ErrorClass::range, from, "token",
                            std::to_string(token_.size()) + " characters",
                            "16 to 256 letters, digits, - . _ or ~");
}

std::optional<Answer> Access::refuse(const Request& request) const {
  if (!request.origin.empty() && request.origin != "http://" + request.host)
    return refusal(403, "a page of another origin may not ask");
  // Pictures and scripts of a page come without Origin; links lead here from anywhere.
  const std::string& site = request.fetch_site;
  if ((site == "cross-site" || site == "same-site") && request.fetch_mode != "navigate")
    return refusal(403, "a page of another origin may not ask");
  if (!has_token()) {
    if (is_here(request.host)) return std::nullopt;
    return refusal(403, "this machine answers to its own name alone");
  }
  constexpr std::string_view kBearer = "Bearer ", kSignIn = "/?token=";
  const std::string name = cookie_name(request.host);
  const std::string_view told = request.authorization;
  if (told.starts_with(kBearer) && is_same(told.substr(kBearer.size()), token_))
    return std::nullopt;
  // Before the cookie: a link that is opened once more signs in again, so that the address keeps no token.
  const std::string_view target = request.target;
  if (request.method == "GET" && target.starts_with(kSignIn) &&
      is_same(target.substr(kSignIn.size()), token_)) {
    Answer answer{303, "text/plain", {}};
    answer.location = "/";
    answer.set_cookie = name + "=" + token_ + "; Path=/; HttpOnly; SameSite=Strict";
    return answer;
  }
  if (is_same(cookie_in(request.cookie, name), token_)) return std::nullopt;
  return refusal(401, "a token is needed: open /?token=TOKEN, or send Authorization: Bearer TOKEN");
}

Access access_from(const std::filesystem::path& file) {
  std::string text = core::read_file(file, 4096);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return Access(std::move(text), core::Place{file.string()});
}

}  // namespace fanbeam::live
