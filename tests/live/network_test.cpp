// The page's server and the datagrams, seen from outside by Beast's client.
#include "live/network.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
//
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "core/files.h"
#include "core/picture_bytes.h"
#include "feeds/native_fdm.h"
#include "live/channel.h"
#include "tests/feeds/native_fdm_bytes.h"
#include "tests/live/web_station.h"
#include "tests/needed_program.h"
#include "tests/processor_time.h"

using namespace fanbeam;
using nlohmann::json;
using tests::answer_to;
using tests::wait_for;
using tests::WebStation;
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using tcp = asio::ip::tcp;
using udp = asio::ip::udp;

namespace {

std::shared_ptr<const live::LiveFrame> narrow_frame(std::uint64_t number, int rows = 2) {
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = number;
  const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * rows),
                                         static_cast<std::uint8_t>(number));
  frame->bscope = frame->cscope = {3, rows, pixels};
  return frame;
}

using WebSocket = beast::websocket::stream<tcp::socket>;

std::unique_ptr<WebSocket> watching(asio::io_context& context, const WebStation& station,
                                    const std::string& target = "/ws") {
  auto socket = std::make_unique<WebSocket>(context);
  socket->next_layer().connect(station.endpoint());
  socket->handshake(station.host(), target);
  return socket;
}

json next_head(WebSocket& socket, std::string* pixels = nullptr) {
  beast::flat_buffer buffer;
  socket.read(buffer);
  const std::string message = beast::buffers_to_string(buffer.data());
  if (pixels != nullptr) *pixels = message.substr(message.find('\n') + 1);
  return json::parse(message.substr(0, message.find('\n')));
}

// Who points at a cell of a frame of that number, which is flown over the scene of now.
tcp::socket pointing(asio::io_context& context, WebStation& station, std::uint64_t number) {
  auto frame = std::make_shared<live::LiveFrame>(*narrow_frame(number));
  frame->scene = station.session->scene();
  frame->pose = live::circle(*frame->scene)(0.1 * static_cast<double>(number));
  station.hub.publish(frame);
  tcp::socket socket(context);
  socket.connect(station.endpoint());
  asio::write(socket, asio::buffer("GET /api/cell?scope=bscope&column=80&row=300&frame=" +
                                   std::to_string(number) + " HTTP/1.1\r\nHost: " + station.host() +
                                   "\r\n\r\n"));
  return socket;
}

}  // namespace

TEST_CASE("Addresses are this machine's, ports are ports", "[network]") {
  CHECK(live::parse_endpoint("8416", "--http").port == 8416);
  CHECK(live::parse_endpoint("localhost:0", "--http").address == "127.0.0.1");
  CHECK(live::parse_endpoint("[::1]:80", "--http").address == "::1");
  // One of IPv4 written as of IPv6: a peer of that name never matched.
  CHECK(live::Peers{{live::parse_address("::ffff:127.0.0.1", "--from")}}.admits("127.0.0.1"));
  CHECK_FALSE(live::parse_endpoint("[::ffff:127.0.0.1]:80", "--http").beyond_loopback);
  for (const char* text :
       {"", "http", "127.0.0.1:", "1.2.3.4:99999", "65536", "-1", "8416x", "example.org:80"})
    CHECK_THROWS_AS(live::parse_endpoint(text, "--http"), core::InputError);
}

TEST_CASE("A browser gets the page, and an error for what is not there", "[network][threads]") {
  WebStation station;
  station.network.start();
  const std::string ask = " HTTP/1.1\r\nHost: " + station.host() + "\r\nConnection: close\r\n\r\n";
  CHECK(answer_to(station, "GET /" + ask).starts_with("HTTP/1.1 200"));
  CHECK(answer_to(station, "GET /api/status" + ask).find("\"waiting\":true") != std::string::npos);
  CHECK(answer_to(station, "GET /nothing" + ask).starts_with("HTTP/1.1 404"));
  CHECK(answer_to(station, "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n")
            .starts_with("HTTP/1.1 403"));
  CHECK(answer_to(station,
                  "GET /ws HTTP/1.1\r\nHost: evil.example\r\nConnection: Upgrade\r\n"
                  "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                  "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")
            .starts_with("HTTP/1.1 403"));
  // A second server on the port is refused.
  live::Network other(station.desk, station.hub);
  CHECK_THROWS_AS(other.serve({"127.0.0.1", station.port}), core::InputError);
}

TEST_CASE("HEAD is told the length of what GET brings, and another method what is allowed",
          "[network][threads]") {
  WebStation station;
  station.network.start();
  const std::string host = " HTTP/1.1\r\nHost: " + station.host() + "\r\n",
                    close = "Connection: close\r\n\r\n";
  const auto head_of = [](const std::string& answer) {
    return answer.substr(0, answer.find("\r\n\r\n") + 4);
  };
  for (const char* target : {"/api/openapi.json", "/nothing"}) {
    INFO(target);
    const std::string got = answer_to(station, "GET " + std::string(target) + host + close);
    CHECK(got.size() > head_of(got).size());
    CHECK(answer_to(station, "HEAD " + std::string(target) + host + close) == head_of(got));
    // Nor does the next answer on the connection wait for bytes that do not come.
    CHECK(answer_to(station,
                    "HEAD " + std::string(target) + host + "\r\nGET " + target + host + close)
              .ends_with(got));
  }
  const std::string refused = answer_to(station, "PUT /api/weather" + host + close);
  CHECK(refused.starts_with("HTTP/1.1 405"));
  CHECK(refused.find("\r\nAllow: GET, HEAD, POST\r\n") != std::string::npos);
}

TEST_CASE("Nonsense and floods are cut off, and the next visitor is served", "[network][threads]") {
  WebStation station;
  station.network.start();
  CHECK(answer_to(station, std::string(100000, 'x')).find("200 OK") == std::string::npos);
  asio::io_context context;
  std::vector<tcp::socket> idle;
  for (int i = 0; i < 60; ++i) {
    idle.emplace_back(context);
    idle.back().connect(station.endpoint());
  }
  idle.clear();
  wait_for([&] {
    return answer_to(station, "GET /api/status HTTP/1.1\r\nHost: " + station.host() +
                                  "\r\nConnection: close\r\n\r\n")
        .starts_with("HTTP/1.1 200");
  });
}

TEST_CASE("F16 frames arrive whole and in order; who reads late, or never, misses some alone",
          "[network][threads]") {
  WebStation station;
  station.network.start();
  asio::io_context context;
  const auto quick = watching(context, station), slow = watching(context, station);
  const auto silent = watching(context, station);
  wait_for([&] { return station.network.clients() == 3; });
  constexpr int kFrames = 50, kRows = 100'000;  // enough to fill every buffer on the way
  std::uint64_t last = 0;
  for (std::uint64_t number = 1; number <= kFrames; ++number) {
    station.hub.publish(narrow_frame(number, kRows));
    std::string pixels;
    const json head = next_head(*quick, &pixels);
    const auto got = head["number"].get<std::uint64_t>();
    CHECK(got > last);
    last = got;
    CHECK(pixels == std::string(6 * kRows, static_cast<char>(got)));
  }
  CHECK(last == kFrames);
  // The slow one was never waited for; what it gets now is not one frame after the other.
  last = 0;
  int read = 0;
  while (last < kFrames) {
    const auto got = next_head(*slow)["number"].get<std::uint64_t>();
    CHECK(got > last);
    last = got;
    ++read;
  }
  CHECK(read < kFrames);
}

// Whoever also sent something was never left.
TEST_CASE("F16 a socket that takes no frame while patience lasts is left, silent or not",
          "[network][threads]") {
  WebStation station{.patience = std::chrono::seconds(5)};
  station.network.start();
  asio::io_context context;
  const auto quick = watching(context, station), silent = watching(context, station);
  const auto chatty = watching(context, station);
  wait_for([&] { return station.network.clients() == 3; });
  constexpr int kFrames = 50, kRows = 100'000;  // enough to fill every buffer on the way
  for (std::uint64_t number = 1; number <= kFrames; ++number) {
    station.hub.publish(narrow_frame(number, kRows));
    next_head(*quick);
  }
  wait_for([&] {
    boost::system::error_code ignored;
    chatty->write(asio::buffer("x", 1), ignored);
    return station.network.clients() == 1;
  });
  station.hub.publish(narrow_frame(kFrames + 1));
  CHECK(next_head(*quick)["number"] == kFrames + 1);
}

// Each was rendered to its end, one after the other.
TEST_CASE("The end does not wait for answers that nobody will get", "[network][threads]") {
  auto station = std::make_unique<WebStation>();
  station->session->set(session::Samples{200.0});
  const auto scene = station->session->scene();
  const auto before = live::Clock::now();
  const double none_s = tests::processor_time_s();
  station->session->render(station->session->now(), live::circle(*scene)(0.1), 1);
  const double one_s = live::seconds_between(before, live::Clock::now());
  const double asked_s = tests::processor_time_s(), work_s = asked_s - none_s;
  station->network.start();
  asio::io_context context;
  std::vector<tcp::socket> asking;
  for (std::uint64_t number = 1; number <= 16; ++number)
    asking.push_back(pointing(context, *station, number));
  wait_for([&] { return tests::processor_time_s() - asked_s > 0.2 * work_s; });
  const auto begin = live::Clock::now();
  station.reset();
  CHECK(live::seconds_between(begin, live::Clock::now()) < one_s);
}

// Whoever pointed at a cell held up pictures, status and controls of all others.
TEST_CASE("What is at hand is answered while a cell is rendered", "[network][threads]") {
  WebStation station;
  station.session->set(session::Samples{5000.0});  // half a minute of processor time
  station.network.start();
  const double before_s = tests::processor_time_s();
  asio::io_context context;
  std::vector<tcp::socket> asking;
  for (const std::uint64_t number : {1, 2}) asking.push_back(pointing(context, station, number));
  wait_for([&] { return tests::processor_time_s() - before_s > 0.2; });
  const std::string rest = " HTTP/1.1\r\nHost: " + station.host() + "\r\nConnection: close\r\n";
  const std::string body = R"({"rain_rate_mm_per_h": 4})";
  for (const std::string& request :
       {"GET /" + rest, "GET /api/status" + rest, "GET /metrics" + rest, "GET /api/plan" + rest,
        "GET /api/sensor" + rest, "GET /api/weather" + rest, "GET /frame/bscope.png" + rest,
        "POST /api/weather" + rest + "Content-Type: application/json\r\nContent-Length: " +
            std::to_string(body.size()) + "\r\n"}) {
    INFO(request);
    const std::string asked = request + "\r\n" + (request.starts_with("POST") ? body : "");
    CHECK(answer_to(station, asked, std::chrono::seconds(60)).starts_with("HTTP/1.1 200"));
  }
  for (const tcp::socket& socket : asking) CHECK(socket.available() == 0);
}

// What was thrown there went through the network's thread and ended the program.
TEST_CASE("A frame whose picture cannot be made is left out of a stream, and the next one is shown",
          "[network]") {
  WebStation station;
  station.network.start();
  auto broken = std::make_shared<live::LiveFrame>();
  broken->number = 1;
  broken->bscope = {3, 2, {}};  // no pixels of those it claims
  station.hub.publish(broken);
  asio::io_context context;
  tcp::socket camera(context);
  camera.connect(station.endpoint());
  asio::write(camera, asio::buffer("GET /stream HTTP/1.1\r\nHost: " + station.host() + "\r\n\r\n"));
  wait_for([&] { return station.network.clients() == 1; });
  std::string told;
  asio::read_until(camera, asio::dynamic_buffer(told), "\r\n\r\n");
  station.hub.publish(narrow_frame(2));
  asio::read_until(camera, asio::dynamic_buffer(told), "\xff\xd8\xff");
  CHECK(told.find("\xff\xd8\xff") != std::string::npos);
}

TEST_CASE(
    "Cameras' streams are JPEG pictures one after the other; /frames the WebSocket's messages",
    "[network][threads]") {
  WebStation station;
  station.network.start();
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = 1;
  frame->bscope = {64, 32, std::vector<std::uint8_t>(64 * 32)};
  for (std::size_t i = 0; i < frame->bscope.pixels.size(); ++i)
    frame->bscope.pixels[i] = static_cast<std::uint8_t>(64 + 2 * (i % 64));
  frame->cscope = {1, 2, {30, 40}};
  station.hub.publish(frame);
  const std::string ask = " HTTP/1.1\r\nHost: " + station.host() + "\r\n\r\n";
  for (const char* target : {"/stream", "/stream/bscope?n=1"}) {
    const std::string told = answer_to(station, "GET " + std::string(target) + ask);
    CHECK(told.find("multipart/x-mixed-replace; boundary=frame") != std::string::npos);
    CHECK(told.find(core::jpeg_bytes(frame->bscope)) != std::string::npos);
  }
  const std::string told = answer_to(station, "GET /frames" + ask);
  const std::string message = live::message_of(*frame);
  const std::size_t size = message.size();
  CHECK(told.ends_with(
      std::string{static_cast<char>(size & 0xff), static_cast<char>(size >> 8), 0, 0} + message));
  CHECK(answer_to(station, "GET /stream/../etc" + ask).starts_with("HTTP/1.1 404"));
  CHECK(answer_to(station, "POST /stream" + ask).starts_with("HTTP/1.1 415"));
  CHECK(answer_to(station, "GET /stream?gain_dB=6" + ask).starts_with("HTTP/1.1 422"));
  wait_for([&] { return station.network.clients() == 0; });  // each left
}

TEST_CASE("JPEG pictures show what the frame does", "[network]") {
  if (!tests::needed_program("ffmpeg")) return;
  core::Picture8 picture{64, 32, std::vector<std::uint8_t>(64 * 32)};
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = static_cast<std::uint8_t>(64 + 2 * (i % 64));
  const tests::TemporaryFolder folder;
  const std::string file = folder.write("part.jpg", core::jpeg_bytes(picture)).string();
  const std::string decode =
      "ffmpeg -v error -i " + file + " -f rawvideo -pix_fmt gray " + file + ".raw </dev/null";
  REQUIRE(std::system(decode.c_str()) == 0);
  const std::string shown = core::read_file(file + ".raw", 1U << 20U);
  REQUIRE(shown.size() == picture.pixels.size());
  // Within what quality 90 takes away.
  for (std::size_t i = 0; i < shown.size(); ++i)
    CHECK(static_cast<unsigned char>(shown[i]) ==
          Approx(picture.pixels[i]).epsilon(0.0).margin(3.0));
}

TEST_CASE("With a token neither page, picture, stream nor socket opens without it",
          "[network][threads]") {
  WebStation station{.token = "0123456789abcdef"};
  station.network.start();
  const std::string rest = " HTTP/1.1\r\nHost: radar:1\r\nConnection: close\r\n";
  const std::string bearer = "Authorization: Bearer 0123456789abcdef\r\n";
  for (const char* target :
       {"/", "/stream", "/frames", "/api/status", "/frame/bscope.png", "/none"}) {
    const std::string ask = "GET " + std::string(target) + rest;
    CHECK(answer_to(station, ask + "\r\n").starts_with("HTTP/1.1 401"));
    CHECK_FALSE(answer_to(station, ask + bearer + "\r\n").starts_with("HTTP/1.1 401"));
  }
  const std::string socket =
      "GET /ws HTTP/1.1\r\nHost: radar:1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  CHECK(answer_to(station, socket + "\r\n").starts_with("HTTP/1.1 401"));
  CHECK(answer_to(station, socket + bearer + "\r\n").starts_with("HTTP/1.1 101"));
  const std::string welcome = answer_to(station, "GET /?token=0123456789abcdef" + rest + "\r\n");
  CHECK(welcome.starts_with("HTTP/1.1 303"));
  CHECK(welcome.find("Set-Cookie: fanbeam_1=0123456789abcdef;") != std::string::npos);
}

TEST_CASE("Datagrams count from peers alone, where there is a list of them", "[network][threads]") {
  WebStation station;
  std::atomic<int> known{0}, foreign{0};
  const auto count = [&](std::span<const std::uint8_t>, const live::Sender& from) {
    ++(from.is_peer ? known : foreign);
  };
  const std::uint16_t ours = station.network.receive({"127.0.0.1", 0}, count, {{"127.0.0.1"}});
  const std::uint16_t others =
      station.network.receive({"127.0.0.1", 0}, count, {{"127.0.0.2", "::1"}});
  station.network.start();
  asio::io_context context;
  udp::socket socket(context, udp::v4());
  for (int i = 0; i < 3; ++i)
    for (const std::uint16_t port : {ours, others})
      socket.send_to(asio::buffer("x", 1), {asio::ip::address_v4::loopback(), port});
  wait_for([&] { return known == 3 && foreign == 3; });
}

// It ended the program.
TEST_CASE("A datagram that its function throws at is counted, and the next is heard",
          "[network][threads]") {
  WebStation station;
  std::atomic<int> heard{0};
  const std::uint16_t port = station.network.receive(
      {"127.0.0.1", 0}, [&](std::span<const std::uint8_t> bytes, const live::Sender&) {
        if (bytes[0] == 'x') core::throw_input_error(core::ErrorClass::range, "x", "x", "y");
        if (bytes[0] == 'z') throw std::bad_alloc();
        ++heard;
      });
  station.network.start();
  asio::io_context context;
  udp::socket socket(context, udp::v4());
  for (const char* bytes : {"y", "x", "z", "y"})
    socket.send_to(asio::buffer(bytes, 1), {asio::ip::address_v4::loopback(), port});
  wait_for([&] { return heard == 2; });
  CHECK(station.network.faults() == 2);
}

TEST_CASE("What is sent goes out from the port that listens", "[network][threads]") {
  WebStation station;
  std::atomic<int> heard{0};
  const std::uint16_t port = station.network.receive(
      {"127.0.0.1", 0}, [&](std::span<const std::uint8_t> bytes, const live::Sender& from) {
        ++heard;
        station.network.send({from.address, from.port}, {bytes.rbegin(), bytes.rend()});
      });
  station.network.start();
  asio::io_context context;
  udp::socket socket(context, udp::v4());
  socket.send_to(asio::buffer("abc", 3), {asio::ip::address_v4::loopback(), port});
  std::array<char, 8> answer{};
  udp::endpoint from;
  CHECK(socket.receive_from(asio::buffer(answer), from) == 3);
  CHECK(std::string(answer.data(), 3) == "cba");
  CHECK(from.port() == port);
  CHECK(heard == 1);
}

TEST_CASE("Datagrams arrive as they were sent", "[network][threads]") {
  WebStation station;
  std::atomic<int> taken{0}, refused{0};
  const std::uint16_t port =
      station.network.receive({}, [&](std::span<const std::uint8_t> bytes, const live::Sender&) {
        feeds::PacketFault fault{};
        ++(feeds::decode_native_fdm(bytes, fault) ? taken : refused);
      });
  station.network.start();
  asio::io_context context;
  udp::socket socket(context, udp::v4());
  const udp::endpoint to(asio::ip::address_v4::loopback(), port);
  for (int i = 0; i < 20; ++i) socket.send_to(asio::buffer(tests::native_fdm_bytes(0.9, 0.2)), to);
  socket.send_to(asio::buffer("nonsense", 8), to);
  socket.send_to(asio::buffer("", 0), to);
  wait_for([&] { return taken == 20 && refused == 2; });
}

TEST_CASE("A channel renders what a flight sees, sixteen times a second, until it is stopped",
          "[network][threads]") {
  WebStation station;
  station.network.start();
  asio::io_context context;
  const auto socket = watching(context, station);
  core::StopSource stop;
  std::thread pilot([&] {
    const live::PoseSource source = live::source_of(live::circle(*station.session->scene()));
    live::run_channel(
        *station.session, source, {16.0, 1.0}, station.hub, [](live::Status&) {}, stop.token());
  });
  std::string before, now;
  double heading_deg = 0.0;
  for (int i = 1; i <= 5; ++i) {
    const json head = next_head(*socket, &now);
    CHECK(now.size() == 2 * 164 * 524);
    CHECK(now != before);
    CHECK(head["heading_deg"] != heading_deg);
    heading_deg = head["heading_deg"];
    before = now;
  }
  stop.request();
  pilot.join();
  const live::Status status = station.hub.status();
  CHECK(status.frames >= 5);
  CHECK(status.refused == 0);
  CHECK_FALSE(status.waiting);
}

TEST_CASE("A pose that nothing can be rendered at is counted, and the channel goes on",
          "[network][threads]") {
  WebStation station;
  live::Mailbox mailbox;
  const auto scene = station.session->scene();
  const auto begin = live::Clock::now();
  core::StopSource stop;
  std::atomic<std::uint64_t> refused{0}, frames{0};
  std::atomic<bool> waited{false}, stale{false};
  std::thread pilot([&] {
    live::run_channel(
        *station.session, live::source_of(mailbox, scene->frame, begin), {50.0, 1.0, begin},
        station.hub,
        [&](live::Status& status) {
          refused = status.refused;
          frames = status.frames;
          if (status.waiting) waited = true;
          stale = status.stale;
        },
        stop.token());
  });
  wait_for([&] { return waited.load(); });
  core::Pose pose = live::circle(*scene)(1.0);
  core::Pose nowhere = pose;
  nowhere.position.height_m = std::nan("");
  mailbox.put(nowhere);
  wait_for([&] { return refused > 0; });
  mailbox.put(pose);
  mailbox.put(pose);
  wait_for([&] { return frames > 0; });
  wait_for([&] { return stale.load(); });  // nothing new for a second: the picture stands
  const std::uint64_t standing = frames;
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK(frames == standing);
  stop.request();
  pilot.join();
}
