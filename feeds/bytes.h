// Fields of a datagram at their offsets, in the sender's byte order or the other one.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace fanbeam::feeds {

template <std::size_t Size>
using Bits = std::conditional_t<
    Size == 8, std::uint64_t,
    std::conditional_t<Size == 4, std::uint32_t,
                       std::conditional_t<Size == 2, std::uint16_t, std::uint8_t>>>;

template <class T>
T swapped(T value) {
  const auto bits = std::bit_cast<Bits<sizeof(T)>>(value);
  Bits<sizeof(T)> turned = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    turned = static_cast<Bits<sizeof(T)>>(
        turned | static_cast<Bits<sizeof(T)>>(static_cast<Bits<sizeof(T)>>(bits >> (8 * i)) & 0xffU)
                     << (8 * (sizeof(T) - 1 - i)));
  return std::bit_cast<T>(turned);
}

// Whether bytes of that order are swapped here.
inline constexpr bool kSwapBig = std::endian::native == std::endian::little;
inline constexpr bool kSwapLittle = !kSwapBig;

// Offsets are inside the packet: who makes one has checked its size.
class Fields {
 public:
  Fields(std::span<const std::uint8_t> packet, bool swap) : packet_(packet), swap_(swap) {}

  template <class T>
  T at(std::size_t offset) const {
    T value{};
    std::memcpy(&value, packet_.data() + offset, sizeof(T));
    return swap_ ? swapped(value) : value;
  }
  std::uint8_t byte(std::size_t offset) const { return packet_[offset]; }
  // `count` bits from the lowest `first` on.
  std::uint8_t bits(std::size_t offset, unsigned first, unsigned count = 1) const {
    return static_cast<std::uint8_t>(packet_[offset] >> first & ((1U << count) - 1U));
  }
  // Of a number that is not finite it is remembered that there was one.
  double number32(std::size_t offset) { return seen(static_cast<double>(at<float>(offset))); }
  double number64(std::size_t offset) { return seen(at<double>(offset)); }
  bool all_finite() const { return finite_; }

 private:
  double seen(double value) {
    finite_ = finite_ && std::isfinite(value);
    return value;
  }

  std::span<const std::uint8_t> packet_;
  bool swap_;
  bool finite_ = true;
};

// A packet in the making: `size` bytes of zeros behind id and size.
class Packet {
 public:
  Packet(std::uint8_t id, std::uint8_t size, bool swap) : bytes_(size, 0), swap_(swap) {
    bytes_[0] = id;
    bytes_[1] = size;
  }

  template <class T>
  Packet& put(std::size_t offset, T value) {
    const T ordered = swap_ ? swapped(value) : value;
    std::memcpy(bytes_.data() + offset, &ordered, sizeof(T));
    return *this;
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
  bool swap_;
};

}  // namespace fanbeam::feeds
