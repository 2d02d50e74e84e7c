#include "live/network.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <deque>
#include <exception>
#include <optional>
#include <thread>
#include <vector>

#include "core/errors.h"
#include "core/picture_bytes.h"
#include "core/stop.h"
#include "live/watchers_private.h"

namespace fanbeam::live {
namespace {

constexpr int kMostConnections = 32;
constexpr std::uint32_t kMostHeader_bytes = 8u << 10;
constexpr std::uint64_t kMostBody_bytes = 64u << 10;
// For the first header of who may be anybody, and for the rest of what is too large.
constexpr std::chrono::milliseconds kStranger{5'000};

std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

Request request_of(const HttpRequest& request) {
  return {text_of(request.method_string()),
          text_of(request.target()),
          text_of(request[http::field::host]),
          text_of(request[http::field::origin]),
          text_of(request[http::field::content_type]),
          request.body(),
          text_of(request[http::field::authorization]),
          text_of(request[http::field::cookie]),
          text_of(request["Sec-Fetch-Site"]),
          text_of(request["Sec-Fetch-Mode"])};
}

// A connection until it ends or becomes a viewer.
class Visitor : public std::enable_shared_from_this<Visitor> {
 public:
  Visitor(tcp::socket socket, Room& room)
      : stream_(std::move(socket)), room_(room), connection_(std::in_place, room.connections) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader_bytes);
    parser_->body_limit(kMostBody_bytes);
    // Between two requests one may be silent.
    stream_.expires_after(is_stranger_ ? std::min(room_.patience, kStranger) : room_.patience);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error) return self->refuse(error);
                              self->read_body();
                            });
  }

  // Sent no whole request that was let in.
  bool is_stranger() const { return is_stranger_; }
  // Its place is free at once.
  void leave() {
    connection_.reset();
    stream_.close();
  }

 private:
  void read_body() {
    stream_.expires_after(room_.patience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (error) return self->refuse(error);
                       self->take(self->parser_->release());
                     });
  }

  // What is no HTTP ends the connection without a word.
  void refuse(error_code error) {
    const bool header = error == http::error::header_limit;
    if (!header && error != http::error::body_limit) return;
    HttpRequest none;
    none.version(11);
    none.keep_alive(false);
    is_too_large_ = true;
    answer(none, header ? refusal(431, "a header of at most 8 KiB")
                        : refusal(413, "a body of at most 64 KiB"));
  }

  // Closed before all came that was sent, the connection would be reset, and the answer lost on its way.
  void pass_over() {
    stream_.async_read_some(asio::buffer(passed_over_),
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (!error) self->pass_over();
                            });
  }

  void take(const HttpRequest& request) {
    if (!connection_) return;  // left meanwhile
    Request asked = request_of(request);
    const std::string path = asked.path();
    const std::optional<Answer> refused = room_.desk.access().refuse(asked);
    if (!refused) is_stranger_ = false;
    const bool by_socket = websocket::is_upgrade(request) && path == "/ws";
    const bool by_stream = asked.method == "GET" && is_stream(path);
    if (by_socket || by_stream) {
      if (refused) return answer(request, *refused);
      if (const auto wrong = Desk::refuse_query(asked)) return answer(request, *wrong);
      stream_.expires_never();
      if (by_socket) return watch_by_socket(stream_.release_socket(), request, room_);
      return watch_by_stream(stream_.release_socket(), path, room_);
    }
    // Frames wait for no answer, and what is at hand for none that is rendered. Of each connection one request
    // waits, as the next is read after its answer.
    asio::thread_pool& where = Desk::renders(asked) ? room_.office : room_.counter;
    // What is captured of a const object would be const, and copied with each move.
    asio::post(where, [self = shared_from_this(), request = HttpRequest(request), asked] {
      const core::StopToken leaving = self->room_.leaving.token();
      if (leaving.reason() != 0) return;
      const core::StopScope scope(leaving);
      const auto given = std::make_shared<const Answer>(self->room_.desk.answer(asked));
      asio::post(self->stream_.get_executor(),
                 [self, request = HttpRequest(request), given] { self->answer(request, *given); });
    });
  }

  void answer(const HttpRequest& request, const Answer& answer) {
    response_.emplace(static_cast<http::status>(answer.status), request.version());
    response_->set(http::field::content_type, answer.type);
    response_->set(http::field::cache_control, "no-store");
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Content-Security-Policy",
                   "default-src 'self'; style-src 'self' 'unsafe-inline'; script-src 'self' "
                   "'unsafe-inline'; connect-src 'self' ws:; img-src 'self' data:; "
                   "frame-ancestors 'none'");
    if (!answer.allow.empty()) response_->set(http::field::allow, answer.allow);
    if (!answer.location.empty()) response_->set(http::field::location, answer.location);
    if (!answer.set_cookie.empty()) response_->set(http::field::set_cookie, answer.set_cookie);
    if (answer.status == 401) response_->set(http::field::www_authenticate, "Bearer");
    response_->keep_alive(request.keep_alive());
    // HEAD is told the length of what GET would bring.
    if (request.method() == http::verb::head) {
      response_->content_length(answer.body.size());
    } else {
      response_->body() = answer.body;
      response_->prepare_payload();
    }
    stream_.expires_after(room_.patience);
    http::async_write(stream_, *response_,
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (error) return;
                        if (self->response_->keep_alive()) return self->read();
                        error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                        if (!self->is_too_large_) return;
                        self->stream_.expires_after(std::min(self->room_.patience, kStranger));
                        self->pass_over();
                      });
  }

  beast::tcp_stream stream_;
  Room& room_;
  std::optional<Counted> connection_;
  bool is_stranger_ = true, is_too_large_ = false;
  std::array<char, 4096> passed_over_{};
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::string_body>> response_;
};

// As an IPv4 address where it is one that came in over IPv6, or is written so.
std::string plain_address(const asio::ip::address& address) {
  if (!address.is_v6() || !address.to_v6().is_v4_mapped()) return address.to_string();
  return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string();
}

// On the network that the system chooses, and within this machine.
void join(udp::socket& socket, const asio::ip::address& group, error_code& error) {
  socket.set_option(asio::ip::multicast::join_group(group), error);
  if (!group.is_v4()) return;
  error_code within;
  socket.set_option(
      asio::ip::multicast::join_group(group.to_v4(), asio::ip::address_v4::loopback()), within);
  if (!within) error = within;
}

[[noreturn]] void refuse_port(const Endpoint& endpoint, const error_code& error) {
  core::throw_input_error(core::ErrorClass::io,
                          core::Place{endpoint.address + ":" + std::to_string(endpoint.port)}, "",
                          error.message(), "a port that is free");
}

}  // namespace

std::string parse_address(const std::string& text, const std::string& field) {
  error_code error;
  const asio::ip::address address = asio::ip::make_address(text, error);
  if (error)
    core::throw_input_error(core::ErrorClass::parse, field, "\"" + text + "\"",
                            "an address in numbers, such as 127.0.0.1");
  return plain_address(address);
}

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
  endpoint.address = parse_address(endpoint.address, field);
  const asio::ip::address address = asio::ip::make_address(endpoint.address);
  endpoint.beyond_loopback = !address.is_loopback();
  endpoint.multicast = address.is_multicast();
  return endpoint;
}

struct Network::Inside {
  Inside(const Desk& desk, Hub& of, std::chrono::milliseconds patience)
      : hub(of), room{desk, of, patience} {}

  struct Receiver {
    udp::socket socket;
    Datagram datagram;
    Peers peers{};
    udp::endpoint from{};
    std::array<std::uint8_t, 65536> bytes{};
  };

  void accept(tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later(acceptor);
      forget_those_heard();
      if (room.connections >= kMostConnections) make_room();
      // One too many is closed at once.
      if (room.connections < kMostConnections) let_in(std::move(socket));
      accept(acceptor);
    });
  }

  void let_in(tcp::socket socket) {
    const auto visitor = std::make_shared<Visitor>(std::move(socket), room);
    strangers.push_back(visitor);
    visitor->read();
  }

  // And those that left, each of which keeps its memory until then.
  void forget_those_heard() {
    std::erase_if(strangers, [](const std::weak_ptr<Visitor>& one) {
      const std::shared_ptr<Visitor> visitor = one.lock();
      return !visitor || !visitor->is_stranger();
    });
  }

  // Whoever connects and sends nothing would shut everybody out.
  void make_room() {
    if (strangers.empty()) return;
    if (const std::shared_ptr<Visitor> oldest = strangers.front().lock()) oldest->leave();
    strangers.pop_front();
  }

  // No descriptors are left, say: to try at once would be a busy loop.
  void accept_later(tcp::acceptor& acceptor) {
    const auto pause =
        std::make_shared<asio::steady_timer>(context, std::chrono::milliseconds(100));
    pause->async_wait([this, &acceptor, pause](error_code error) {
      if (!error) accept(acceptor);
    });
  }

  void receive(Receiver& receiver) {
    receiver.socket.async_receive_from(
        asio::buffer(receiver.bytes), receiver.from,
        [this, &receiver](error_code error, std::size_t size) {
          if (error == asio::error::operation_aborted) return;
          if (!error) {
            const std::string from = plain_address(receiver.from.address());
            try {
              receiver.datagram({receiver.bytes.data(), size},
                                {from, receiver.from.port(), receiver.peers.admits(from)});
            } catch (const std::exception&) {  // no datagram ends the flight
              ++faults;
            }
          }
          receive(receiver);
        });
  }

  void offer() {
    for (auto it = room.watching.begin(); it != room.watching.end();) {
      if (const std::shared_ptr<Watcher> watcher = it->lock()) {
        watcher->offer();
        ++it;
      } else {
        it = room.watching.erase(it);
      }
    }
  }

  Hub& hub;
  Room room;
  std::deque<std::weak_ptr<Visitor>> strangers;  // oldest first, and those that were heard since
  asio::io_context context{1}, datagrams{1};
  std::vector<std::unique_ptr<tcp::acceptor>> acceptors;
  std::vector<std::unique_ptr<Receiver>> receivers;
  std::thread thread, listener;
  std::atomic<std::uint64_t> faults{0};
};

Network::Network(const Desk& desk, Hub& hub, std::chrono::milliseconds patience)
    : inside_(std::make_unique<Inside>(desk, hub, patience)) {}

Network::~Network() {
  inside_->hub.on_frame({});
  inside_->room.leaving.request();
  for (auto* const context : {&inside_->datagrams, &inside_->context})
    asio::post(*context, [context] { context->stop(); });  // behind what was sent last
  for (auto* const thread : {&inside_->listener, &inside_->thread})
    if (thread->joinable()) thread->join();
  // Not stop(): who waits in their queues has a socket of `context`, which goes first.
  for (auto* const pool : {&inside_->room.counter, &inside_->room.office}) pool->join();
}

std::uint16_t Network::serve(const Endpoint& endpoint) {
  // Where pictures cannot be made, that is told now and not at a client's request.
  core::png_bytes({.columns = 1, .rows = 1, .pixels = {0}});
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

std::uint16_t Network::receive(const Endpoint& endpoint, Datagram datagram, Peers peers) {
  const udp::endpoint at(asio::ip::make_address(endpoint.address), endpoint.port);
  udp::socket socket(inside_->datagrams);
  error_code error;
  socket.open(at.protocol(), error);
  // Others on this machine may listen to the group too.
  const bool group = at.address().is_multicast();
  if (!error && group) socket.set_option(udp::socket::reuse_address(true), error);
  if (!error) socket.bind(at, error);
  if (!error && group) join(socket, at.address(), error);
  if (error) refuse_port(endpoint, error);
  auto receiver = std::make_unique<Inside::Receiver>(
      Inside::Receiver{std::move(socket), std::move(datagram), std::move(peers)});
  inside_->receive(*receiver);
  inside_->receivers.push_back(std::move(receiver));
  return inside_->receivers.back()->socket.local_endpoint().port();
}

void Network::send(const Endpoint& to, std::vector<std::uint8_t> datagram) {
  if (inside_->receivers.empty()) return;
  asio::ip::address address = asio::ip::make_address(to.address);
  udp::socket& socket = inside_->receivers.back()->socket;
  if (socket.local_endpoint().address().is_v6() && address.is_v4())
    address = asio::ip::make_address_v6(asio::ip::v4_mapped, address.to_v4());
  const udp::endpoint there(address, to.port);
  asio::post(inside_->datagrams, [&socket, there, bytes = std::move(datagram)] {
    error_code ignored;
    socket.send_to(asio::buffer(bytes), there, asio::socket_base::message_flags(MSG_DONTWAIT),
                   ignored);
  });
}

void Network::start() {
  inside_->hub.on_frame(
      [inside = inside_.get()] { asio::post(inside->context, [inside] { inside->offer(); }); });
  inside_->thread = std::thread([inside = inside_.get()] { inside->context.run(); });
  if (!inside_->receivers.empty())
    inside_->listener = std::thread([inside = inside_.get()] { inside->datagrams.run(); });
}

int Network::clients() const { return inside_->room.viewers; }

std::uint64_t Network::faults() const { return inside_->faults; }

}  // namespace fanbeam::live
