// Who may look and steer, with and without a token.
#include "live/access.h"

#include <catch2/catch.hpp>

#include "live/request.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using live::Access;
using live::Request;

namespace {

const std::string kToken = "aB3-._~7aB3-._~7";

Request asking(const std::string& target, const std::string& host = "radar.example:8416") {
  Request request;
  request.method = "GET";
  request.target = target;
  request.host = host;
  return request;
}

int status_of(const Access& access, const Request& request) {
  const auto refused = access.refuse(request);
  return refused ? refused->status : 200;
}

}  // namespace

TEST_CASE("Without a token this machine's own names alone may ask", "[access]") {
  const Access access;
  for (const char* host : {"localhost", "localhost:8416", "127.0.0.1:1", "127.0.0.2:8416",
                           "127.9.8.7", "[::1]:8416", "[::1]"})
    CHECK(status_of(access, asking("/", host)) == 200);
  for (const char* host : {"", "radar.example", "127.0.0.1.radar.example", "localhost.evil:8416",
                           "[::2]:8416", "10.0.0.1", ":8416", "]", "[::1",
                           "127.0.0.2.radar.example", "127.1", "127.0.0.2.3", "128.0.0.1:8416"})
    CHECK(status_of(access, asking("/", host)) == 403);
}

// Pictures of a page come without Origin, links lead here from anywhere.
TEST_CASE("A page of another site may link here, and show nothing of it", "[access]") {
  const Access access;
  Request request = asking("/api/cell", "127.0.0.1:8416");
  for (const char* site : {"cross-site", "same-site"}) {
    request.fetch_site = site;
    request.fetch_mode = "no-cors";
    CHECK(status_of(access, request) == 403);
    request.fetch_mode = "navigate";
    CHECK(status_of(access, request) == 200);
  }
  request.fetch_mode = "no-cors";
  for (const char* site : {"same-origin", "none", ""}) {
    request.fetch_site = site;
    CHECK(status_of(access, request) == 200);
  }
}

TEST_CASE("A page of another origin may not ask, token or not", "[access]") {
  for (const Access& access : {Access(), Access(kToken, {})}) {
    Request request = asking("/", "localhost:8416");
    request.authorization = "Bearer " + kToken;
    request.origin = "http://localhost:8416";
    CHECK(status_of(access, request) == 200);
    for (const char* origin :
         {"http://localhost:8417", "https://localhost:8416", "null", "http://evil.example"}) {
      request.origin = origin;
      CHECK(status_of(access, request) == 403);
    }
  }
}

TEST_CASE("With a token each request needs it, from whatever host", "[access]") {
  const Access access(kToken, {});
  Request request = asking("/api/status", "localhost:8416");
  CHECK(status_of(access, request) == 401);
  for (const std::string& wrong :
       {std::string(), kToken.substr(1), kToken + "x", std::string(16, '\0'), "x" + kToken,
        kToken.substr(0, 15) + "8"}) {
    request.authorization = "Bearer " + wrong;
    CHECK(status_of(access, request) == 401);
    request.cookie = "fanbeam_8416=" + wrong;
    CHECK(status_of(access, request) == 401);
    CHECK(status_of(access, asking("/?token=" + wrong)) == 401);
  }
  request.cookie.clear();
  request.authorization = "Basic " + kToken;
  CHECK(status_of(access, request) == 401);
  request.authorization = "Bearer " + kToken;
  CHECK(status_of(access, request) == 200);
}

TEST_CASE("The page is opened with the token once; the browser's cookie carries it on",
          "[access]") {
  const Access access(kToken, {});
  const auto welcome = access.refuse(asking("/?token=" + kToken));
  REQUIRE(welcome);
  CHECK(welcome->status == 303);
  CHECK(welcome->location == "/");
  CHECK(welcome->set_cookie == "fanbeam_8416=" + kToken + "; Path=/; HttpOnly; SameSite=Strict");
  Request next = asking("/ws");
  next.cookie = "a=b; fanbeam_8416=" + kToken + "; c=d";
  CHECK(status_of(access, next) == 200);
  next.cookie = "fanbeam_8417=" + kToken;  // of another server on the same machine
  CHECK(status_of(access, next) == 401);
  next.cookie = "xfanbeam_8416=" + kToken + ";;; =;";
  CHECK(status_of(access, next) == 401);
  // A bookmark of the link, opened again: its token would stay in address bar and history.
  Request again = asking("/?token=" + kToken);
  again.cookie = "fanbeam_8416=" + kToken;
  CHECK(status_of(access, again) == 303);
  again.target = "/?token=" + kToken.substr(1);
  CHECK(status_of(access, again) == 200);
  // The sign-in is for the page alone.
  CHECK(status_of(access, asking("/api/status?token=" + kToken)) == 401);
  Request post = asking("/?token=" + kToken);
  post.method = "POST";
  CHECK(status_of(access, post) == 401);
}

TEST_CASE("A token is long enough to be none that is guessed, and comes from a file", "[access]") {
  tests::TemporaryFolder folder;
  folder.write("good", kToken + "\r\n");
  CHECK(live::access_from(folder.path() / "good").has_token());
  for (const std::string& bad :
       {std::string(), std::string(15, 'a'), std::string(257, 'a'),
        std::string("two words of a text"), std::string("aB3-._~7aB3-._~\n7")}) {
    folder.write("bad", bad);
    CHECK_THROWS_AS(live::access_from(folder.path() / "bad"), core::InputError);
  }
  CHECK_THROWS_AS(live::access_from(folder.path() / "none"), core::InputError);
}
