#include <algorithm>
#include <array>
#include <chrono>
#include <exception>

#include "core/picture_bytes.h"
#include "live/watchers_private.h"

namespace fanbeam::live {
namespace {

constexpr std::uint64_t kMostHeard_bytes = 64u << 10;  // of a message; it is thrown away

class SocketWatcher : public Watcher {
 public:
  SocketWatcher(tcp::socket socket, Room& room)
      : Watcher(room.hub, room.connections, room.viewers),
        patience_(room.patience),
        stream_(std::move(socket)),
        late_(stream_.get_executor()) {
    stream_.read_message_max(kMostHeard_bytes);
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.binary(true);
  }

  void accept(const HttpRequest& request) {
    stream_.async_accept(request, [this, self = shared_from_this()](error_code error) {
      if (error) return;
      read();
      open();
    });
  }

 private:
  void send(const LiveFrame& frame) override {
    message_ = message_of(frame);
    late_.expires_after(patience_);
    late_.async_wait([this, self = shared_from_this()](error_code error) {
      // Set anew, if the frame got through meanwhile.
      if (!error && late_.expiry() <= std::chrono::steady_clock::now())
        beast::get_lowest_layer(stream_).close();
    });
    stream_.async_write(asio::buffer(message_),
                        [this, self = shared_from_this()](error_code error, std::size_t) {
                          late_.expires_at(asio::steady_timer::time_point::max());
                          sent(error);
                        });
  }

  // What a browser says means nothing; reading answers pings and sees it leave.
  void read() {
    stream_.async_read(heard_, [this, self = shared_from_this()](error_code error, std::size_t) {
      heard_.clear();
      if (error)
        end();
      else
        read();
    });
  }

  std::chrono::milliseconds patience_;
  websocket::stream<beast::tcp_stream> stream_;
  asio::steady_timer late_;  // with the frame that is under way
  beast::flat_buffer heard_;
  std::string message_;
};

std::string jpeg_part(const core::Picture8& picture) {
  const std::string bytes = core::jpeg_bytes(picture);
  return "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(bytes.size()) +
         "\r\n\r\n" + bytes + "\r\n";
}

std::string sized(const std::string& message) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(message.size() >> shift & 0xffU);
  return bytes + message;
}

struct StreamKind {
  std::string_view path, type;
  std::string (*part)(const LiveFrame&);
};

constexpr std::string_view kMixed = "multipart/x-mixed-replace; boundary=frame";
constexpr std::array kStreams{
    StreamKind{
        "/stream", kMixed,
        [](const LiveFrame& frame) { return jpeg_part(picture_to_show(frame, Scope::bscope)); }},
    StreamKind{
        "/stream/bscope", kMixed,
        [](const LiveFrame& frame) { return jpeg_part(picture_to_show(frame, Scope::bscope)); }},
    StreamKind{
        "/stream/cscope", kMixed,
        [](const LiveFrame& frame) { return jpeg_part(picture_to_show(frame, Scope::cscope)); }},
    StreamKind{"/frames", "application/octet-stream",
               [](const LiveFrame& frame) { return sized(message_of(frame)); }}};

const StreamKind* stream_of(std::string_view path) {
  const auto found = std::find_if(kStreams.begin(), kStreams.end(),
                                  [&](const StreamKind& kind) { return kind.path == path; });
  return found == kStreams.end() ? nullptr : &*found;
}

class StreamWatcher : public Watcher {
 public:
  StreamWatcher(tcp::socket socket, const StreamKind& kind, Room& room)
      : Watcher(room.hub, room.connections, room.viewers),
        patience_(room.patience),
        stream_(std::move(socket)),
        kind_(kind) {
    error_code ignored;  // nothing is written while no frames come: else a dead peer would stay
    stream_.socket().set_option(asio::socket_base::keep_alive(true), ignored);
  }

  void begin() {
    message_ = "HTTP/1.1 200 OK\r\nContent-Type: " + std::string(kind_.type) +
               "\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
               "Connection: close\r\n\r\n";
    read();
    write([this](error_code error) {
      if (!error) open();
    });
  }

 private:
  void send(const LiveFrame& frame) override {
    message_ = kind_.part(frame);
    write([this](error_code error) { sent(error); });
  }

  template <class Done>
  void write(Done done) {
    stream_.expires_after(patience_);
    asio::async_write(stream_, asio::buffer(message_),
                      [this, self = shared_from_this(), done](error_code error, std::size_t) {
                        stream_.expires_never();
                        done(error);
                      });
  }

  // Sees it leave.
  void read() {
    stream_.socket().async_read_some(
        asio::buffer(heard_), [this, self = shared_from_this()](error_code error, std::size_t) {
          if (error)
            end();
          else
            read();
        });
  }

  std::chrono::milliseconds patience_;
  beast::tcp_stream stream_;
  const StreamKind& kind_;
  std::string message_;
  std::array<char, 512> heard_{};
};

// Those that left go here too: no frame may come to do so, and each keeps its memory until then.
void let_in(const std::shared_ptr<Watcher>& watcher, Watchers& watching) {
  std::erase_if(watching, [](const std::weak_ptr<Watcher>& one) { return one.expired(); });
  watching.insert(watcher);
}

}  // namespace

void Watcher::offer() {
  if (!open_ || sending_) return;
  const std::shared_ptr<const LiveFrame> frame = hub_.newest();
  if (!frame || frame->number == sent_) return;
  sent_ = frame->number;
  sending_ = true;
  try {
    send(*frame);
  } catch (const std::exception&) {  // no picture ends the flight: the next frame is tried
    sending_ = false;
  }
}

void Watcher::open() {
  open_ = true;
  offer();
}

void Watcher::sent(error_code error) {
  sending_ = false;
  if (error)
    open_ = false;
  else
    offer();
}

bool is_stream(std::string_view path) { return stream_of(path) != nullptr; }

void watch_by_socket(tcp::socket socket, const HttpRequest& request, Room& room) {
  const auto watcher = std::make_shared<SocketWatcher>(std::move(socket), room);
  let_in(watcher, room.watching);
  watcher->accept(request);
}

void watch_by_stream(tcp::socket socket, std::string_view path, Room& room) {
  const auto watcher = std::make_shared<StreamWatcher>(std::move(socket), *stream_of(path), room);
  let_in(watcher, room.watching);
  watcher->begin();
}

}  // namespace fanbeam::live
