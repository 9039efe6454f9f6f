#pragma once
// The module's SPI at its pins (4.7.4, X14): MSB first, shifted by SCK itself, to and from whole bytes.
#include <cstdint>

namespace dsdpv1::xgate {

/// `Bytes` has begin_byte(), end_byte(mosi), cut_byte() of HostLink.
class SpiSide {
 public:
  /// CPOL in bit 1, CPHA in bit 0.
  explicit SpiSide(unsigned mode) : mode_(mode) {}

  void reset() { selected_ = false; }
  bool selected() const { return selected_; }
  bool miso() const { return miso_; }

  template <class Bytes>
  void select(bool low, Bytes&& bytes) {
    if (selected_ && !low) bytes.cut_byte();
    selected_ = low;
    bits_ = 0;
    miso_ = true;
    if (low && !late()) load(bytes);
  }
  template <class Bytes>
  void clock(bool level, bool mosi, Bytes&& bytes) {
    if (!selected_) return;
    if (level == (mode_ == 0 || mode_ == 3)) {
      in_ = (in_ << 1 | (mosi ? 1U : 0U)) & 0xFFU;
      if (++bits_ < 8) return;
      bits_ = 0;
      bytes.end_byte(static_cast<std::uint8_t>(in_));
    } else if (bits_ == 0) {
      load(bytes);
    } else {
      miso_ = (out_ >> (7U - bits_) & 1U) != 0;
    }
  }
  /// The answer may have become ready: a byte of which no bit has been clocked is that of now.
  template <class Bytes>
  void look_again(bool sck, Bytes&& bytes) {
    const bool rests = sck == ((mode_ & 2U) != 0);
    if (selected_ && bits_ == 0 && rests && !late()) load(bytes);
  }

  template <class Archive>
  void store(Archive& archive) {
    auto& [mode, out, in, bits, is_selected, level] = *this;
    archive.given(mode);
    archive.within(0U, 255U, out, in);
    archive.within(0U, 7U, bits);
    archive(is_selected, level);
  }

 private:
  bool late() const { return (mode_ & 1U) != 0; }
  template <class Bytes>
  void load(Bytes&& bytes) {
    out_ = bytes.begin_byte();
    miso_ = (out_ & 0x80U) != 0;
  }

  unsigned mode_, out_ = 0xFF, in_ = 0, bits_ = 0;  ///< bits_: of the present byte, taken
  bool selected_ = false, miso_ = true;
};

}  // namespace dsdpv1::xgate
