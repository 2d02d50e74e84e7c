// Clients that every frame goes to, as far as they keep up: one frame is under way to each at a time,
// and the next is then the newest.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "core/stop.h"
#include "live/asio_private.h"
#include "live/desk.h"

namespace fanbeam::live {

using HttpRequest = http::request<http::string_body>;

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

class Watcher : public std::enable_shared_from_this<Watcher> {
 public:
  virtual ~Watcher() = default;
  // The newest frame, unless it was sent or another is under way.
  void offer();

 protected:
  Watcher(const Hub& hub, std::atomic<int>& connections, std::atomic<int>& watchers)
      : hub_(hub), connection_(connections), watcher_(watchers) {}
  virtual void send(const LiveFrame& frame) = 0;

  void open();
  void sent(error_code error);
  void end() { open_ = false; }

 private:
  const Hub& hub_;
  Counted connection_, watcher_;
  std::uint64_t sent_ = 0;
  bool open_ = false, sending_ = false;
};

using Watchers = std::set<std::weak_ptr<Watcher>, std::owner_less<std::weak_ptr<Watcher>>>;

struct Room {
  const Desk& desk;
  const Hub& hub;
  std::chrono::milliseconds patience;  // with a request, an answer, a frame under way
  core::StopSource leaving{};          // of what is rendered for answers
  asio::thread_pool counter{1};        // where requests are answered that need no rendering
  asio::thread_pool office{1};         // and where the others are, one after the other
  std::atomic<int> connections{0}, viewers{0};
  Watchers watching{};  // of the thread alone
};

// GET /stream, /stream/cscope: multipart/x-mixed-replace of JPEG, as cameras send it. GET /frames:
// what a WebSocket gets, each with its size before it in four bytes, lowest first.
bool is_stream(std::string_view path);

// Answer the request and watch from then on.
void watch_by_socket(tcp::socket socket, const HttpRequest& request, Room& room);
void watch_by_stream(tcp::socket socket, std::string_view path, Room& room);

}  // namespace fanbeam::live
