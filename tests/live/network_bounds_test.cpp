// Who asks for too much, or for nothing, seen from outside.
#include <catch2/catch.hpp>
#include <vector>

#include "tests/live/web_station.h"

using namespace fanbeam;

namespace {

using LoopbackSocket = boost::asio::ip::tcp::socket;

constexpr const char* kBoundsToken = "0123456789abcdef";

std::string status_request(const tests::WebStation& station, const std::string& more = {}) {
  return "GET /api/status HTTP/1.1\r\nHost: " + station.host() + "\r\n" + more + "\r\n";
}

LoopbackSocket saying(boost::asio::io_context& context, const tests::WebStation& station,
                      const std::string& bytes) {
  LoopbackSocket socket(context);
  socket.connect(station.endpoint());
  boost::asio::write(socket, boost::asio::buffer(bytes));
  return socket;
}

// Whether the server closes it while that lasts.
bool is_left(LoopbackSocket& socket, std::chrono::milliseconds most) {
  std::array<char, 4096> part{};
  boost::system::error_code error;
  socket.non_blocking(true);
  const auto until = std::chrono::steady_clock::now() + most;
  while (std::chrono::steady_clock::now() < until) {
    socket.read_some(boost::asio::buffer(part), error);
    if (error && error != boost::asio::error::would_block) return true;
    if (error) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

// For half a minute they shut everybody out.
TEST_CASE("Who connects and asks for nothing makes room for the next, the oldest first",
          "[network][threads]") {
  for (const char* token : {"", kBoundsToken}) {
    INFO(token);
    tests::WebStation station{.token = token};
    station.network.start();
    const std::string bearer =
        *token == 0 ? "" : "Authorization: Bearer " + std::string(token) + "\r\n";
    boost::asio::io_context context;
    std::vector<LoopbackSocket> places;
    // One that was answered stays, and so do those behind the oldest.
    places.push_back(saying(context, station, status_request(station, bearer)));
    std::string answer;
    boost::asio::read_until(places[0], boost::asio::dynamic_buffer(answer), "\r\n\r\n");
    CHECK(answer.starts_with("HTTP/1.1 200"));
    // Neither half a header is a request nor one without the token.
    const std::string nothing =
        *token == 0 ? "GET / HTTP/1.1\r\nHost: radar" : status_request(station);
    for (int i = 1; i < 32; ++i) places.push_back(saying(context, station, nothing));
    for (int i = 1; i <= 2; ++i)
      CHECK(tests::answer_to(station, status_request(station, bearer + "Connection: close\r\n"))
                .starts_with("HTTP/1.1 200"));
    CHECK(is_left(places[1], std::chrono::seconds(2)));
    CHECK_FALSE(is_left(places[31], std::chrono::milliseconds(100)));
    boost::asio::write(places[0], boost::asio::buffer(status_request(station, bearer)));
    CHECK_FALSE(is_left(places[0], std::chrono::milliseconds(100)));
  }
}

TEST_CASE(
    "The first header of a connection has five seconds, who was answered may be silent longer",
    "[network][threads]") {
  tests::WebStation station;
  station.network.start();
  boost::asio::io_context context;
  LoopbackSocket silent = saying(context, station, "GET /");
  LoopbackSocket heard = saying(context, station, status_request(station));
  CHECK_FALSE(is_left(silent, std::chrono::seconds(3)));
  CHECK(is_left(silent, std::chrono::seconds(10)));
  CHECK_FALSE(is_left(heard, std::chrono::seconds(2)));
}

// The connection was closed without a word, and often before all had been sent: the client saw it reset.
TEST_CASE("A header or a body that is too large is told as that, all of it sent or not",
          "[network][threads]") {
  tests::WebStation station;
  station.network.start();
  const std::string post = "POST /api/weather HTTP/1.1\r\nHost: " + station.host() +
                           "\r\nContent-Type: application/json\r\n";
  const auto told = [&](const std::string& bytes) { return tests::answer_to(station, bytes); };
  const std::string header =
      told("GET / HTTP/1.1\r\nHost: " + std::string(20'000, 'h') + "\r\n\r\n");
  CHECK(header.starts_with("HTTP/1.1 431"));
  CHECK(header.find(R"({"error":"a header of at most 8 KiB"})") != std::string::npos);
  for (const std::string& body : {std::string("{"), std::string(2'000'000, ' ')}) {
    const std::string answer = told(post + "Content-Length: 2000000\r\n\r\n" + body);
    CHECK(answer.starts_with("HTTP/1.1 413"));
    CHECK(answer.find("Connection: close") != std::string::npos);
    CHECK(answer.find(R"({"error":"a body of at most 64 KiB"})") != std::string::npos);
  }
  // In pieces, whose sum nobody says before.
  std::string chunks = post + "Transfer-Encoding: chunked\r\n\r\n";
  for (int i = 0; i < 20; ++i) chunks += "1000\r\n" + std::string(0x1000, ' ') + "\r\n";
  CHECK(told(chunks + "0\r\n\r\n").starts_with("HTTP/1.1 413"));
}
