// Footprint files that would have the program ask a server.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>

#include "core/errors.h"
#include "terrain/buildings/footprints.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::terrain {
namespace {

// A port of this machine on which somebody listens and never answers.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* plain = reinterpret_cast<sockaddr*>(&address);
    socklen_t length = sizeof(address);
    REQUIRE(bind(socket_, plain, length) == 0);
    REQUIRE(listen(socket_, 8) == 0);
    REQUIRE(getsockname(socket_, plain, &length) == 0);
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/crs"; }
  bool was_called() const {
    pollfd waiting{socket_, POLLIN, 0};
    return poll(&waiting, 1, 0) > 0;
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

}  // namespace

// Old GeoJSON names its reference system, and GDAL would fetch it from wherever the file says.
TEST_CASE("F05 a reference system behind a URL is refused without asking the network",
          "[footprints][F05]") {
  const Listener listener;
  const std::string link = R"({"type":"link","properties":{"href":")" + listener.url() + R"("}})";
  const std::string url = R"({"type":"url","properties":{"url":")" + listener.url() + R"("}})";
  const std::string name = R"({"type":"name","properties":{"name":")" + listener.url() + R"("}})";
  for (const std::string& crs : {link, url, name}) {
    const tests::TemporaryFolder folder;
    const auto file = folder.write(
        "houses.geojson",
        R"({"type":"FeatureCollection","crs":)" + crs +
            R"(,"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon",)" +
            R"("coordinates":[[[11,47],[11.002,47],[11.002,47.002],[11,47]]]}}]})");
    INFO(crs);
    core::ProblemList problems;
    CHECK_THROWS_WITH(read_footprints(file, {}, problems),
                      Catch::Matchers::Contains("E-PARSE GeoJSON"));
    CHECK_FALSE(listener.was_called());
  }
}

}  // namespace fanbeam::terrain
