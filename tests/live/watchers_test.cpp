// Clients that come and go while no frame does.
#include <sys/socket.h>

#include <catch2/catch.hpp>

#include "live/watchers_private.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;

// Each kept the memory of its connection until the next frame, which may never come.
TEST_CASE("Streams that leave before any frame are forgotten when the next one comes",
          "[watchers]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const live::Hub hub;
  const live::Desk desk(*session, hub);
  live::Room room{desk, hub, std::chrono::seconds(5)};
  live::asio::io_context context;
  live::tcp::acceptor door(context, {live::asio::ip::address_v4::loopback(), 0});
  for (int client = 0; client < 100; ++client) {
    live::asio::io_context outside;
    live::tcp::socket visitor(outside);
    visitor.connect(door.local_endpoint());
    live::tcp::socket socket = door.accept();
    const int descriptor = socket.native_handle();
    live::watch_by_stream(std::move(socket), "/stream", room);
    // Who loses power says no more.
    int watched = 0;
    socklen_t size = sizeof watched;
    REQUIRE(::getsockopt(descriptor, SOL_SOCKET, SO_KEEPALIVE, &watched, &size) == 0);
    CHECK(watched == 1);
    CHECK(room.viewers == 1);
    CHECK(room.watching.size() <= 2);  // with the one before
    visitor.close();
    context.restart();
    context.run();  // until it has seen that
    CHECK(room.viewers == 0);
  }
}
