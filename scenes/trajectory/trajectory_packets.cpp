#include "scenes/trajectory/trajectory_packets.h"

#include <array>
#include <map>
#include <string>

#include "feeds/packet_file.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using feeds::PacketFault;

class PacketTrackBuilder {
 public:
  PacketTrackBuilder(const std::filesystem::path& path, const TrackPackets& packets,
                     const TrajectoryColumns& columns, core::ProblemList& problems)
      : file_(path.string()),
        packets_(packets),
        columns_(columns),
        problems_(problems),
        port_(packets.port) {}

  void take(const feeds::RecordedDatagram& datagram) {
    PacketFault fault{};
    const auto state = packets_.protocol->decode(datagram.bytes, fault);
    if (state) {
      ++of_port_[datagram.port];
      if (!port_) port_ = datagram.port;
    }
    if (port_ != datagram.port) return;
    ++row_;
    if (row_ < columns_.first_row.value_or(row_) || row_ > columns_.last_row.value_or(row_)) return;
    if (state)
      add(*state, datagram);
    else
      leave_out(fault, datagram.byte_offset);
  }

  RawTrack finish() {
    tell_left_out();
    if (of_port_.size() > 1 && !packets_.port) tell_ports();
    if (track_.rows.size() > kMostTrackRows)
      problems_.error(ErrorClass::limit, {file_}, "packets",
                      "more than " + std::to_string(kMostTrackRows),
                      "at most that many; choose a part by time or row");
    if (track_.rows.empty() && !problems_.has_errors())
      problems_.error(ErrorClass::ref, {file_}, "packets",
                      "none of " + std::string(packets_.protocol->name) + where(),
                      "at least one inside the window");
    track_.file = file_;
    track_.has_roll = track_.has_pitch = track_.has_heading = true;
    return std::move(track_);
  }

 private:
  void add(const feeds::AircraftState& state, const feeds::RecordedDatagram& datagram) {
    const double clock_s = packets_.protocol->fine_clock ? state.clock_s : datagram.time_s;
    if (!begin_s_) begin_s_ = clock_s;
    const double time_s = clock_s - *begin_s_;
    if (last_s_ && time_s <= *last_s_) return late(*last_s_ - time_s, datagram.byte_offset);
    last_s_ = time_s;
    if (time_s < columns_.from_time_s.value_or(time_s)) return;
    if (time_s > columns_.to_time_s.value_or(time_s)) return;
    if (track_.rows.size() > kMostTrackRows) return;
    const core::Pose pose = feeds::pose_of(state);
    const core::Attitude attitude = core::attitude_from(pose.q_NB);
    TrackRow row{time_s, pose.position, attitude.roll_rad, attitude.pitch_rad, attitude.heading_rad,
                 row_};
    row.position.height_m += columns_.height_offset_m;
    track_.rows.push_back(row);
  }

  void late(double by_s, std::int64_t byte_offset) {
    constexpr double kMost_s = 1.0;  // that packets overtake each other by
    if (by_s <= kMost_s) return leave_out(PacketFault::late, byte_offset);
    if (told_jump_) return;
    told_jump_ = true;
    problems_.error(
        ErrorClass::time, {file_, 0, 0, byte_offset}, "clock of packets",
        "goes back by " + core::number_text(by_s) + " s at packet " + std::to_string(row_),
        "one that goes on; choose a part with from_row and to_row");
  }

  void leave_out(PacketFault fault, std::int64_t byte_offset) {
    LeftOut& left = left_out_[static_cast<std::size_t>(fault)];
    if (left.count++ == 0) left.first = byte_offset;
  }

  void tell_left_out() {
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (left_out_[i].count > 0)
        problems_.warning("PACKETS", {file_, 0, 0, left_out_[i].first},
                          feeds::name_of(static_cast<PacketFault>(i)),
                          std::to_string(left_out_[i].count), "left out, the first of them here");
  }

  void tell_ports() {
    std::string ports;
    for (const auto& [port, count] : of_port_)
      ports += (ports.empty() ? "" : ", ") + std::to_string(port) + " (" + std::to_string(count) +
               " packets)";
    problems_.error(ErrorClass::ref, {file_}, "port", "missing", "one of " + ports);
  }

  std::string where() const {
    return packets_.port ? " to port " + std::to_string(*packets_.port) : std::string();
  }

  struct LeftOut {
    std::int64_t count = 0, first = 0;
  };

  std::string file_;
  const TrackPackets& packets_;
  const TrajectoryColumns& columns_;
  core::ProblemList& problems_;
  RawTrack track_;
  std::map<std::uint16_t, std::int64_t> of_port_;
  std::optional<std::uint16_t>
      port_;  // of the flight: that asked for, else the first with a packet
  std::int32_t row_ = 0;
  std::optional<double> begin_s_, last_s_;
  bool told_jump_ = false;
  std::array<LeftOut, feeds::kPacketFaults> left_out_{};
};

}  // namespace

RawTrack read_track_packets(const std::filesystem::path& path, const TrackPackets& packets,
                            const TrajectoryColumns& columns, core::ProblemList& problems) {
  PacketTrackBuilder builder(path, packets, columns, problems);
  feeds::read_datagrams(
      path, [&](const feeds::RecordedDatagram& datagram) { builder.take(datagram); }, problems);
  return builder.finish();
}

}  // namespace fanbeam::scenes
