// The B-scope as radar displays take it: ASTERIX category 240 over UDP, a radial for each column, unicast
// or multicast (feeds/cat240.h).
//
// A frame's columns go out from left to right, spread over nine tenths of the period; a frame that comes
// while another one is under way waits, and only the newest does. Each second a summary goes ahead
// of a frame. Its text (docs/live-cat240.md) names the scene, where the radar is, what azimuths
// count from and what cells mean.
// Cells: eight bits, the grey of the B-scope; or sixteen, the received power with the receiver's noise as
// 1 + (10 log10(P / 1 W) + 250) / 0.005, rounded: -250 to 77.7 dBW in steps of 0.005 dB, 0 for no power.
// Azimuths: from the nose, or true bearings, of the frame's middle. Roll and pitch of an antenna that is
// not stabilised are neglected in them. Ranges: the first cell begins at a whole number of cells; what that
// is off (at most half a cell) is in the summary. Time of day is that of sending.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "feeds/cat240.h"
#include "live/frame_taker.h"
#include "live/mailbox.h"
#include "live/network.h"
#include "sensors/sensor.h"

namespace fanbeam::live {

struct RadarVideoSettings {
  Endpoint to;
  feeds::cat240::CellBits bits = feeds::cat240::CellBits::eight;
  bool true_bearings = false;  // else from the nose
  bool zlib = false;
  feeds::cat240::Source source;
  std::string interface;  // that multicast leaves by, its IPv4 address; empty: the system's choice
  int hops = 1;           // of multicast: how many networks it crosses
};

class RadarVideo {
 public:
  // Throws InputError: E-IO where no datagram can be sent there, E-RANGE for range cells of 643 m and more.
  RadarVideo(const RadarVideoSettings& settings, const sensors::Sensor& sensor,
             const std::string& scene, double rate_Hz, bool every_frame);
  ~RadarVideo();
  RadarVideo(const RadarVideo&) = delete;
  RadarVideo& operator=(const RadarVideo&) = delete;

  // Sixteen bits need LiveFrame::received_W.
  void write(const std::shared_ptr<const LiveFrame>& frame) { taker_->write(frame); }

 private:
  struct Wire;
  bool put(const LiveFrame& frame, const FrameTaker& taker);
  std::string summary_of(const LiveFrame& frame) const;
  std::vector<std::uint8_t> cells_of(const LiveFrame& frame, int column) const;
  void send_column(const LiveFrame& frame, int column);

  RadarVideoSettings settings_;
  sensors::Sensor sensor_;
  std::string scene_;
  double period_s_;
  std::uint32_t first_cell_, cell_duration_fs_, counter_ = 0;
  Clock::time_point told_{};
  std::unique_ptr<Wire> wire_;
  std::optional<FrameTaker> taker_;
};

}  // namespace fanbeam::live
