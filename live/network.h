// What listens: the page with its WebSocket, and a simulator's datagrams. A thread for each, one that answers what is
// at hand, and one that answers what has to be rendered (Desk::renders): no request keeps a frame or a datagram
// waiting, and a cell that somebody points at no other answer than the next cell's. Of each connection one request
// waits: the next is read after its answer.
//
// Bounded: 32 connections, 8 KiB of header, 64 KiB of body (431 and 413 else), 5 s for the first header of a
// connection, 30 s for a later request, a body, an answer and a frame that is under way, 64 KiB of a message from a
// browser (all are thrown away). Where all 32 are taken, the oldest of those that sent no whole request that is let in
// makes room for the next. A client that reads slowly misses frames: one is under way to it at a time, and the next is
// then the newest; who does not take one within the 30 s is left. Beyond loopback (endpoint.beyond_loopback) the desk must have a token and datagrams a list of
// peers: the caller sees to that.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "live/desk.h"

namespace fanbeam::live {

struct Endpoint {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  // 0: any that is free
  bool beyond_loopback = false;
  bool multicast = false;
};

// Whose datagrams count: anybody's, or those from these addresses.
struct Peers {
  std::vector<std::string> addresses;

  bool admits(const std::string& address) const {
    return addresses.empty() ||
           std::find(addresses.begin(), addresses.end(), address) != addresses.end();
  }
};

// Who sent a datagram.
struct Sender {
  std::string address;
  std::uint16_t port = 0;
  bool is_peer = false;  // whose datagrams count
};

// An address in numbers, in the form that peers are compared in. Throws InputError E-PARSE.
std::string parse_address(const std::string& text, const std::string& field);

// "8416" or "127.0.0.1:8416". Throws InputError: E-PARSE, E-RANGE for a port. `field` is the
// option's name.
Endpoint parse_endpoint(const std::string& text, const std::string& field);

class Network {
 public:
  static constexpr std::chrono::milliseconds kPatience{30'000};

  // All must outlive it. `patience`: the 30 s.
  Network(const Desk& desk, Hub& hub, std::chrono::milliseconds patience = kPatience);
  ~Network();  // closes every connection; what is being rendered for an answer is stopped
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  // Both before start(). Throw InputError E-IO when the port is taken. Give the port.
  std::uint16_t serve(const Endpoint& endpoint);
  // Called on its thread. An endpoint of multicast is a group that is joined.
  using Datagram = std::function<void(std::span<const std::uint8_t>, const Sender&)>;
  std::uint16_t receive(const Endpoint& endpoint, Datagram datagram, Peers peers = {});

  // From the port of the last receive(), from any thread; lost where the network is not ready.
  void send(const Endpoint& to, std::vector<std::uint8_t> datagram);

  void start();
  int clients() const;  // that watch frames
  // Datagrams whose function threw: each is of no use, and the next is heard.
  std::uint64_t faults() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace fanbeam::live
