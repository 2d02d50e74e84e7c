// The page's server over a small scene, and who asks it by bare bytes.
#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
//
#include <boost/asio.hpp>

#include "live/network.h"
#include "tests/live/live_scene.h"

namespace fanbeam::tests {

struct WebStation {
  TemporaryFolder folder{};
  std::unique_ptr<session::Session> session = live_session(folder);
  std::string token{};
  std::chrono::milliseconds patience = live::Network::kPatience;
  live::Hub hub{};
  live::Desk desk{*session, hub, nullptr, token.empty() ? live::Access() : live::Access(token, {})};
  live::Network network{desk, hub, patience};
  std::uint16_t port = network.serve({});

  std::string host() const { return "127.0.0.1:" + std::to_string(port); }
  boost::asio::ip::tcp::endpoint endpoint() const {
    return {boost::asio::ip::address_v4::loopback(), port};
  }
};

// What the server says to these bytes before it closes or that time is over.
inline std::string answer_to(const WebStation& station, const std::string& bytes,
                             std::chrono::seconds most = std::chrono::seconds(1)) {
  namespace asio = boost::asio;
  asio::io_context context;
  asio::ip::tcp::socket socket(context);
  socket.connect(station.endpoint());
  boost::system::error_code ignored;
  asio::write(socket, asio::buffer(bytes), ignored);
  std::string answer;
  std::array<char, 4096> part{};
  std::function<void()> read = [&] {
    socket.async_read_some(asio::buffer(part),
                           [&](boost::system::error_code error, std::size_t size) {
                             answer.append(part.data(), size);
                             if (!error) read();
                           });
  };
  read();
  context.run_for(most);
  return answer;
}

inline void wait_for(const std::function<bool()>& done) {
  for (int i = 0; i < 2000 && !done(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(done());
}

}  // namespace fanbeam::tests
