#include "live/radar_video.h"

#include <fmt/core.h>
#include <netinet/in.h>
#include <netinet/ip.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/constants.h"
#include "core/errors.h"
#include "core/units.h"
#include "live/asio_private.h"

namespace fanbeam::live {
namespace {

namespace cat240 = feeds::cat240;

double time_of_day_s() {
  const auto now = std::chrono::system_clock::now();
  return std::chrono::duration<double>(now - std::chrono::floor<std::chrono::days>(now)).count();
}

// There and back.
std::uint32_t duration_fs(double cell_m) {
  const double duration_fs = 2e15 * cell_m / core::kSpeedOfLight_mps;
  constexpr double kMost_m = 643.0;
  if (!(cell_m < kMost_m))
    core::throw_input_error(core::ErrorClass::range, "range cell", cell_m,
                            "below 643 m, what category 240 can tell");
  return static_cast<std::uint32_t>(std::llround(duration_fs));
}

std::uint16_t log_power(double power_W) {
  constexpr double kLowest_dBW = -250.0, kStep_dB = 0.005;
  if (!(power_W > 0.0)) return 0;
  const double steps = 1.0 + (10.0 * std::log10(power_W) - kLowest_dBW) / kStep_dB;
  return static_cast<std::uint16_t>(std::lround(std::clamp(steps, 1.0, 65535.0)));
}

}  // namespace

struct RadarVideo::Wire {
  explicit Wire(const RadarVideoSettings& settings) {
    const asio::ip::address address = asio::ip::make_address(settings.to.address);
    const udp::endpoint to(address, settings.to.port);
    error_code error;
    socket.open(to.protocol(), error);
    if (!error && address.is_multicast()) {
      socket.set_option(asio::ip::multicast::hops(settings.hops), error);
      if (!error && !settings.interface.empty() && address.is_v4())
        socket.set_option(
            asio::ip::multicast::outbound_interface(asio::ip::make_address_v4(settings.interface)),
            error);
    }
    if (!error) socket.connect(to, error);
    if (error)
      core::throw_input_error(
          core::ErrorClass::io,
          core::Place{settings.to.address + ":" + std::to_string(settings.to.port)}, "--to",
          error.message(), "a place that datagrams can be sent to");
    ask_path();
  }

  // What the path takes in one piece, as far as the system knows; never more than Ethernet's.
  void ask_path() {
    constexpr int kEthernet_bytes = 1500;
    const bool six = socket.local_endpoint().protocol() == udp::v6();
    int mtu_bytes = kEthernet_bytes;
    socklen_t size = sizeof mtu_bytes;
    if (::getsockopt(socket.native_handle(), six ? IPPROTO_IPV6 : IPPROTO_IP,
                     six ? IPV6_MTU : IP_MTU, &mtu_bytes, &size) != 0)
      mtu_bytes = kEthernet_bytes;
    const std::size_t headers = six ? 48 : 28;
    most_bytes = static_cast<std::size_t>(std::clamp(mtu_bytes, 576, kEthernet_bytes)) - headers;
  }

  // Nobody there, or no room: lost, as datagrams may be.
  void send(const cat240::Bytes& message) {
    error_code ignored;
    socket.send(asio::buffer(message), 0, ignored);
  }

  asio::io_context context{1};
  udp::socket socket{context};
  std::size_t most_bytes = 0;
};

RadarVideo::RadarVideo(const RadarVideoSettings& settings, const sensors::Sensor& sensor,
                       const std::string& scene, double rate_Hz, bool every_frame)
    : settings_(settings),
      sensor_(sensor),
      scene_(scene),
      period_s_(1.0 / rate_Hz),
      first_cell_(
          static_cast<std::uint32_t>(std::lround(sensor.range.minimum_m / sensor.range.cell_m))),
      cell_duration_fs_(duration_fs(sensor.range.cell_m)),
      wire_(std::make_unique<Wire>(settings)) {
  taker_.emplace(
      [this](const LiveFrame& frame, const FrameTaker& taker) { return put(frame, taker); },
      every_frame);
}

RadarVideo::~RadarVideo() { taker_.reset(); }

std::string RadarVideo::summary_of(const LiveFrame& frame) const {
  const core::Geodetic& at = frame.pose.position;
  const std::string cells = settings_.bits == cat240::CellBits::sixteen
                                ? "16 bit dBW=-250+0.005(v-1)"
                                : fmt::format("8 bit {:g} to {:g} dB", frame.low_dB, frame.high_dB);
  return fmt::format(
      "fanbeam {:.40} lat {:.6f} lon {:.6f} deg h {:.1f} m WGS84 heading {:.2f} deg; azimuth {}; "
      "range {:+.3f} m; {}",
      scene_, core::degrees(at.latitude_rad), core::degrees(at.longitude_rad), at.height_m,
      core::wrap_360_deg(core::degrees(core::attitude_from(frame.pose.q_NB).heading_rad)),
      settings_.true_bearings ? "true" : "from nose",
      sensor_.range.minimum_m - first_cell_ * sensor_.range.cell_m, cells);
}

// Of a column, from near to far.
std::vector<std::uint8_t> RadarVideo::cells_of(const LiveFrame& frame, int column) const {
  std::vector<std::uint8_t> cells;
  const auto columns = static_cast<std::size_t>(sensor_.scan.columns);
  const auto rows = static_cast<std::size_t>(sensor_.range.cells);
  for (std::size_t row = 0; row < rows; ++row) {
    if (settings_.bits == cat240::CellBits::eight) {
      const std::size_t top_first = rows - 1 - row;
      cells.push_back(frame.bscope.pixels[top_first * columns + static_cast<std::size_t>(column)]);
    } else {
      const std::uint16_t level =
          log_power(frame.received_W[row * columns + static_cast<std::size_t>(column)]);
      cells.push_back(static_cast<std::uint8_t>(level >> 8));
      cells.push_back(static_cast<std::uint8_t>(level & 0xff));
    }
  }
  return cells;
}

void RadarVideo::send_column(const LiveFrame& frame, int column) {
  const double from_rad =
      settings_.true_bearings ? core::attitude_from(frame.pose.q_NB).heading_rad : 0.0;
  const std::vector<std::uint8_t> cells = cells_of(frame, column);
  cat240::Radial radial;
  radial.start_azimuth_rad = from_rad + sensor_.mounting.yaw_rad -
                             sensor_.scan.field_of_view_rad / 2 +
                             column * sensor_.scan.column_width_rad();
  radial.end_azimuth_rad = radial.start_azimuth_rad + sensor_.scan.column_width_rad();
  radial.first_cell = first_cell_;
  radial.cell_duration_fs = cell_duration_fs_;
  radial.bits = settings_.bits;
  radial.cells = cells;
  radial.time_of_day_s = time_of_day_s();
  for (const cat240::Bytes& message :
       cat240::video(settings_.source, radial, {wire_->most_bytes, settings_.zlib}, counter_))
    wire_->send(message);
}

bool RadarVideo::put(const LiveFrame& frame, const FrameTaker& taker) {
  constexpr std::chrono::seconds kBetweenSummaries(1);
  constexpr std::chrono::milliseconds kShortestNap(1);
  constexpr double kOfPeriod = 0.9;
  const Clock::time_point begin = Clock::now();
  if (begin - told_ >= kBetweenSummaries) {
    told_ = begin;
    wire_->ask_path();
    wire_->send(cat240::summary(settings_.source, time_of_day_s(), summary_of(frame)));
  }
  const int columns = sensor_.scan.columns;
  for (int column = 0; column < columns && !taker.leaving(); ++column) {
    send_column(frame, column);
    const std::chrono::duration<double> spent_s(kOfPeriod * period_s_ * (column + 1) / columns);
    const auto due = begin + std::chrono::duration_cast<Clock::duration>(spent_s);
    if (due - Clock::now() >= kShortestNap) std::this_thread::sleep_until(due);
  }
  return true;
}

}  // namespace fanbeam::live
