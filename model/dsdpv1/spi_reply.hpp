#pragma once
// The reply to a telegram of SPI, built byte by byte as it is sent (SP4 to SP8; docs/microarchitecture_rsu.md 5.4).
#include <cstdint>

#include "model/dpram/crc16.hpp"
#include "model/dpram/ram.hpp"

namespace dsdpv1 {

class SpiReply {
 public:
  /// `gap` bytes of FF, then `start`, error code and `data` bytes. kOutputs: as many as B319 says.
  static constexpr int kOutputs = -1;
  void begin(std::uint8_t start, std::uint8_t code, int data, int gap) {
    *this = {};
    start_ = start;
    code_ = code;
    data_ = data;
    next_ = -gap;
  }

  /// The index of the data byte that the next byte takes from the DPRAM; -1: none.
  int wants() const {
    const int index = next_ - kHead;
    return index >= 0 && (data_ == kOutputs || index < data_) ? index : -1;
  }
  /// The next byte; `data` is the byte requested by wants().
  std::uint8_t take(std::uint8_t data) {
    const int index = next_++;
    if (index < 0) return 0xFF;
    if (index == 0) return count(start_);
    if (index == 1) return count(code_);
    if (data_ == kOutputs) data_ = 1 + (data = limited(data));
    if (index < kHead + data_) return count(data);
    if (index == kHead + data_) return static_cast<std::uint8_t>(crc_ >> 8);
    return index == kHead + data_ + 1 ? static_cast<std::uint8_t>(crc_ & 0xFF) : std::uint8_t{0xFF};
  }

  /// Size of the whole reply; 0 until the number of outputs has been read.
  int size() const { return data_ == kOutputs ? 0 : kHead + data_ + 2; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [start, code, data, next, crc] = *this;
    archive(start, code, crc);
    archive.within(kOutputs, 0xFF, data);
    archive.within(-kMostGap, kMostBytes, next);
  }

 private:
  static constexpr int kHead = 2, kMostGap = 16, kMostBytes = 1 << 30;
  static std::uint8_t limited(std::uint8_t outputs) {
    return outputs > regs::kOutputDataSize ? static_cast<std::uint8_t>(regs::kOutputDataSize) : outputs;
  }
  std::uint8_t count(std::uint8_t byte) {
    crc_ = dpram::crc16_with(crc_, byte);
    return byte;
  }

  std::uint8_t start_ = 0, code_ = 0;
  int data_ = 0, next_ = 0;
  std::uint16_t crc_ = dpram::kCrc16Start;
};

}  // namespace dsdpv1
