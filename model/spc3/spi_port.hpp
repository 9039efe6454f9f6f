#pragma once
// SPI of the VPC3+S at the pins (A59 to A61): frames of XSS, an instruction, an address, and data. An edge of SCK acts
// with tick resolution.
#include "model/profibus/event_log.hpp"
#include "model/spc3/address_map.hpp"
#include "model/spc3/pins.hpp"

namespace dsdpv1::spc3 {

class SpiPort {
 public:
  SpiPort(profibus::EventLog& log, const Config& config, AddressMap& map) : log_(log), config_(config), map_(map) {}

  /// RESET is high, or another bus is chosen: frames are ignored.
  void reset();
  /// A frame without an edge of SCK yet is heard.
  void release();
  // Changes of the pins.
  void xss(Tick at, bool level, bool sck);
  void sck(Tick at, bool level, bool mosi);
  /// As the chip drives it.
  Level miso() const { return miso_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, config, map, enabled, part, bits, bytes, shift, out, instruction, address, told, miso] = *this;
    archive.given(log, config, map);
    archive.within(Part::kNone, Part::kIgnored, part);
    archive.within(0U, 7U, bits);
    archive.within(0U, kMostBytes, bytes);
    archive(enabled, shift, out, instruction, address, told);
    archive.within(kLevelZ, Level{1}, miso);
  }

 private:
  static constexpr unsigned kMostBytes = 0xFFFF;
  enum class Part : std::uint8_t { kNone, kInstruction, kAddressHigh, kAddressLow, kData, kEnded, kIgnored };

  bool reads() const { return (instruction_ & 1U) != 0; }
  void begin(Tick at, bool sck);
  void end(Tick at);
  void ignore(Tick at);
  void take_bit(Tick at, bool level);
  void take_byte(Tick at);
  void take_instruction(Tick at);
  void take_data(Tick at);
  void prepare(Tick at);
  void begin_byte(Tick at);
  std::uint8_t read(Tick at);
  void check_address(Tick at);

  profibus::EventLog& log_;
  const Config& config_;
  AddressMap& map_;
  bool enabled_ = false;
  Part part_ = Part::kNone;        ///< of the frame; kNone: XSS is high
  unsigned bits_ = 0, bytes_ = 0;  ///< bits of the present byte, complete bytes of the frame
  std::uint8_t shift_ = 0;         ///< MOSI
  std::uint8_t out_ = 0xFF;        ///< the byte on MISO
  std::uint8_t instruction_ = 0;
  std::uint16_t address_ = 0;  ///< of the next byte of data
  bool told_ = false;          ///< a wrong address, or bytes too many, in this frame
  Level miso_ = kLevelZ;
};

}  // namespace dsdpv1::spc3
