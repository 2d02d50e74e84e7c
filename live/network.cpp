#include "live/network.h"

#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "core/errors.h"
#include "live/asio_private.h"

namespace fanbeam::live {
namespace {

constexpr int kMostConnections = 32;
constexpr std::uint32_t kMostHeader_bytes = 8u << 10;
constexpr std::uint64_t kMostBody_bytes = 64u << 10;
constexpr std::chrono::seconds kPatience(30);

using HttpRequest = http::request<http::string_body>;

std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

Request request_of(const HttpRequest& request) {
  return {text_of(request.method_string()),
          text_of(request.target()),
          text_of(request[http::field::host]),
          text_of(request[http::field::origin]),
          text_of(request[http::field::content_type]),
          request.body()};
}

// How many there are, counted by those who live.
class Counted {
 public:
  explicit Counted(std::atomic<int>& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::atomic<int>& count_;
};

// A browser that watches.
class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  Viewer(tcp::socket socket, const Hub& hub, std::atomic<int>& connections,
         std::atomic<int>& viewers)
      : stream_(std::move(socket)), hub_(hub), connection_(connections), viewer_(viewers) {
    stream_.read_message_max(kMostBody_bytes);
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.binary(true);
  }

  void accept(const HttpRequest& request) {
    stream_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return;
      self->open_ = true;
      self->read();
      self->offer();
    });
  }

  // The newest frame, unless it was sent or another is under way.
  void offer() {
    if (!open_ || sending_) return;
    const std::shared_ptr<const LiveFrame> frame = hub_.newest();
    if (!frame || frame->number == sent_) return;
    sent_ = frame->number;
    sending_ = true;
    message_ = message_of(*frame);
    stream_.async_write(asio::buffer(message_),
                        [self = shared_from_this()](error_code error, std::size_t) {
                          self->sending_ = false;
                          if (error)
                            self->open_ = false;
                          else
                            self->offer();
                        });
  }

 private:
  // What a browser says means nothing; reading answers pings and sees it leave.
  void read() {
    stream_.async_read(heard_, [self = shared_from_this()](error_code error, std::size_t) {
      self->heard_.clear();
      if (error)
        self->open_ = false;
      else
        self->read();
    });
  }

  websocket::stream<beast::tcp_stream> stream_;
  const Hub& hub_;
  Counted connection_, viewer_;
  beast::flat_buffer heard_;
  std::string message_;
  std::uint64_t sent_ = 0;
  bool open_ = false, sending_ = false;
};

using Viewers = std::set<std::weak_ptr<Viewer>, std::owner_less<std::weak_ptr<Viewer>>>;

struct Room {
  const Desk& desk;
  const Hub& hub;
  std::atomic<int> connections{0}, viewers{0};
  Viewers watching{};  // of the thread alone
};

// A connection until it ends or becomes a viewer.
class Visitor : public std::enable_shared_from_this<Visitor> {
 public:
  Visitor(tcp::socket socket, Room& room)
      : stream_(std::move(socket)), room_(room), connection_(room.connections) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader_bytes);
    parser_->body_limit(kMostBody_bytes);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (!error) self->take(self->parser_->release());
                     });
  }

 private:
  void take(const HttpRequest& request) {
    const Request asked = request_of(request);
    if (websocket::is_upgrade(request) && asked.target == "/ws" && is_admitted(asked)) {
      stream_.expires_never();
      const auto viewer = std::make_shared<Viewer>(stream_.release_socket(), room_.hub,
                                                   room_.connections, room_.viewers);
      room_.watching.insert(viewer);
      viewer->accept(request);
      return;
    }
    const Answer answer = room_.desk.answer(asked);
    response_.emplace(static_cast<http::status>(answer.status), request.version());
    response_->set(http::field::content_type, answer.type);
    response_->set(http::field::cache_control, "no-store");
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Content-Security-Policy",
                   "default-src 'self'; style-src 'self' 'unsafe-inline'; script-src 'self' "
                   "'unsafe-inline'; connect-src 'self' ws:; img-src 'self' data:; "
                   "frame-ancestors 'none'");
    response_->keep_alive(request.keep_alive());
    if (request.method() != http::verb::head) response_->body() = answer.body;
    response_->prepare_payload();
    stream_.expires_after(kPatience);
    http::async_write(stream_, *response_,
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (error) return;
                        if (self->response_->keep_alive()) return self->read();
                        error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  beast::tcp_stream stream_;
  Room& room_;
  Counted connection_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::string_body>> response_;
};

[[noreturn]] void refuse_port(const Endpoint& endpoint, const error_code& error) {
  core::throw_input_error(core::ErrorClass::io,
                          core::Place{endpoint.address + ":" + std::to_string(endpoint.port)}, "",
                          error.message(), "a port that is free");
}

}  // namespace

Endpoint parse_endpoint(const std::string& text, const std::string& field) {
  Endpoint endpoint;
  const std::size_t colon = text.rfind(':');
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  if (colon != std::string::npos) endpoint.address = text.substr(0, colon);
  if (endpoint.address == "localhost") endpoint.address = "127.0.0.1";
  if (endpoint.address.starts_with('[') && endpoint.address.ends_with(']'))
    endpoint.address = endpoint.address.substr(1, endpoint.address.size() - 2);
  const auto [end, fault] = std::from_chars(port.data(), port.data() + port.size(), endpoint.port);
  if (port.empty() || end != port.data() + port.size() || fault == std::errc::invalid_argument)
    core::throw_input_error(core::ErrorClass::parse, field, "\"" + text + "\"",
                            "PORT or ADDRESS:PORT");
  if (fault == std::errc::result_out_of_range)
    core::throw_input_error(core::ErrorClass::range, field, "\"" + text + "\"",
                            "a port from 0 (any that is free) to 65535");
  error_code error;
  const asio::ip::address address = asio::ip::make_address(endpoint.address, error);
  if (error)
    core::throw_input_error(core::ErrorClass::parse, field, "\"" + text + "\"",
                            "an address in numbers, such as 127.0.0.1");
  if (!address.is_loopback())
    core::throw_input_error(core::ErrorClass::unsupported, field, "\"" + text + "\"",
                            "a loopback address, 127.0.0.1 or [::1]: reach it from elsewhere "
                            "through ssh -L");
  return endpoint;
}

struct Network::Inside {
  Inside(const Desk& desk, Hub& of) : hub(of), room{desk, of} {}

  struct Receiver {
    udp::socket socket;
    Datagram datagram;
    udp::endpoint from{};
    std::array<std::uint8_t, 65536> bytes{};
  };

  void accept(tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      // One too many is closed at once.
      if (!error && room.connections < kMostConnections)
        std::make_shared<Visitor>(std::move(socket), room)->read();
      accept(acceptor);
    });
  }

  void receive(Receiver& receiver) {
    receiver.socket.async_receive_from(asio::buffer(receiver.bytes), receiver.from,
                                       [this, &receiver](error_code error, std::size_t size) {
                                         if (error == asio::error::operation_aborted) return;
                                         if (!error)
                                           receiver.datagram({receiver.bytes.data(), size});
                                         receive(receiver);
                                       });
  }

  void offer() {
    for (auto it = room.watching.begin(); it != room.watching.end();) {
      if (const std::shared_ptr<Viewer> viewer = it->lock()) {
        viewer->offer();
        ++it;
      } else {
        it = room.watching.erase(it);
      }
    }
  }

  Hub& hub;
  Room room;
  asio::io_context context{1};
  std::vector<std::unique_ptr<tcp::acceptor>> acceptors;
  std::vector<std::unique_ptr<Receiver>> receivers;
  std::thread thread;
};

Network::Network(const Desk& desk, Hub& hub) : inside_(std::make_unique<Inside>(desk, hub)) {}

Network::~Network() {
  inside_->hub.on_frame({});
  inside_->context.stop();
  if (inside_->thread.joinable()) inside_->thread.join();
}

std::uint16_t Network::serve(const Endpoint& endpoint) {
  const tcp::endpoint at(asio::ip::make_address(endpoint.address), endpoint.port);
  auto acceptor = std::make_unique<tcp::acceptor>(inside_->context);
  error_code error;
  acceptor->open(at.protocol(), error);
  if (!error) acceptor->set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor->bind(at, error);
  if (!error) acceptor->listen(asio::socket_base::max_listen_connections, error);
  if (error) refuse_port(endpoint, error);
  inside_->accept(*acceptor);
  inside_->acceptors.push_back(std::move(acceptor));
  return inside_->acceptors.back()->local_endpoint().port();
}

std::uint16_t Network::receive(const Endpoint& endpoint, Datagram datagram) {
  const udp::endpoint at(asio::ip::make_address(endpoint.address), endpoint.port);
  udp::socket socket(inside_->context);
  error_code error;
  socket.open(at.protocol(), error);
  if (!error) socket.bind(at, error);
  if (error) refuse_port(endpoint, error);
  auto receiver =
      std::make_unique<Inside::Receiver>(Inside::Receiver{std::move(socket), std::move(datagram)});
  inside_->receive(*receiver);
  inside_->receivers.push_back(std::move(receiver));
  return inside_->receivers.back()->socket.local_endpoint().port();
}

void Network::start() {
  inside_->hub.on_frame(
      [inside = inside_.get()] { asio::post(inside->context, [inside] { inside->offer(); }); });
  inside_->thread = std::thread([inside = inside_.get()] { inside->context.run(); });
}

int Network::clients() const { return inside_->room.viewers; }

}  // namespace fanbeam::live
