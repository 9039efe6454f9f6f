#pragma once
// The additional host ports of the DSDPV1-RSU, SPI and UART, and the straps that choose one (R1, R11). Only the live
// one is evaluated; in parallel mode, in reset and in other parts none is.
#include <array>

#include "model/dsdpv1/host_uart.hpp"
#include "model/dsdpv1/spi_port.hpp"

namespace dsdpv1 {

class SerialPorts {
 public:
  SerialPorts(profibus::EventLog& log, dpram::Ram& ram, const Config& config)
      : log_(log), config_(config), spi_(log, ram, config_), uart_(log, ram, config_) {}

  void reset();
  /// The end of a reset (cycle R): samples the straps and starts the port that they choose.
  void release(Cycle now);
  /// A change of a pin that only the DSDPV1-RSU has; ignored in other parts.
  void set(Tick at, Pin pin, Level level);
  Level level(Pin pin) const;

  HostMode mode() const { return mode_; }
  bool live() const { return mode_ != HostMode::kParallel; }
  /// Evaluates the live port at the edge `now`.
  void eval(Cycle now, const ChipSide& side);
  Cycle next() const;
  /// The chip must not begin an access; valid after eval().
  bool holds() const { return mode_ == HostMode::kSpi ? spi_.holds() : uart_.holds(); }
  /// The block CRCs in the DPRAM are judged (SP15).
  bool judges_crc() const { return !live() || config_.serial_block_crc != 0; }
  /// Whether cell `address` is a register of SPI, whose value is then ownership().
  bool is_register(std::uint16_t address) const { return mode_ == HostMode::kSpi && address == regs::kOwnership; }
  std::uint8_t ownership(bool owns) const { return spi_.ownership(owns); }

  Level miso() const { return spi_.shift().miso(); }
  bool txd() const { return uart_.txd(); }
  /// The tick of MISO's next change.
  Tick drive_at() const { return spi_.shift().drive_at(); }
  void drive() { spi_.shift().drive(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, config, mode, running, straps, in_force, spi, uart] = *this;
    archive.given(log, config);
    archive.within(HostMode::kParallel, HostMode::kUart, mode);
    for (std::size_t i = 0; i < kStraps; ++i) archive.within(0, kHighestStrap, straps[i], in_force[i]);
    archive(running, spi, uart);
    archive.check(!live() || has_serial_ports(config.part));
  }

 private:
  static constexpr std::size_t kStraps = 4;  // MODE, ADR, UBR, UIV
  static constexpr Level kHighestStrap = 7;
  static std::size_t strap(Pin pin) { return static_cast<std::size_t>(pin) - static_cast<std::size_t>(Pin::kMode); }
  void set_strap(Tick at, Pin pin, Level level);

  profibus::EventLog& log_;
  const Config config_;
  HostMode mode_ = HostMode::kParallel;
  bool running_ = false;
  std::array<Level, kStraps> straps_{}, in_force_{};
  SpiPort spi_;
  HostUart uart_;
};

}  // namespace dsdpv1
