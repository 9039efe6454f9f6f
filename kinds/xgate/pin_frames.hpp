#pragma once
// Frames between host and module, read from the pins alone: for logs, waves and checks.
#include <cstdint>
#include <string>

#include "bus/bytes.hpp"
#include "kinds/user_cpu/uart_receiver.hpp"
#include "kinds/xgate/settings.hpp"
#include "model/xgate/frame.hpp"
#include "tb/chip/checks/spi_frame_reader.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::xgate {

/// A frame on the line, whole or not.
struct HostFrame {
  Tick start = 0, end = 0;  ///< of its first and last byte
  bool answer = false;      ///< from the module
  bus::Bytes bytes;
  Frame frame;             ///< as far as the bytes go; an error has kErrorFlag in either form (X3)
  std::string wrong;       ///< what is wrong with it; empty: nothing
  bool heard = true;       ///< of a command: the module took it
  std::uint8_t asked = 0;  ///< of an answer: the command
};

/// Derived classes receive the frames. One command is open at a time (X2).
class PinFrames : private tb::SpiFrameReader {
 public:
  PinFrames(const Config& chip, unsigned spi_mode);
  ~PinFrames() override = default;

  static tb::PinMask mask();
  /// In order of time.
  void pin(Tick at, tb::PinNumber pin, tb::Level level);
  Tick next() const;
  void run(Tick now);
  const Config& config() const { return config_; }

 protected:
  PinFrames(const PinFrames&) = delete;
  PinFrames& operator=(const PinFrames&) = delete;
  /// When it has ended, at the latest when that is known.
  virtual void frame(const HostFrame& frame) = 0;
  /// A byte of a frame of the host that has begun; `last_end`: of the byte before it.
  virtual void byte_of_frame(Tick /*end*/, Tick /*last_end*/) {}
  /// SPI: NSS rose at `at`, after so many bits.
  virtual void nss_rose(Tick /*at*/, unsigned /*bits*/) {}
  /// Command 03 or /Rst has set the rate.
  virtual void rate_changed() {}
  /// The module has been reset; frames in progress are dropped.
  virtual void module_reset() {}
  /// From an answered command on to the end of its answer.
  bool awaits_answer() const { return awaits_; }
  const UartTiming& timing() const { return timing_; }
  /// Between the ends of two bytes of a frame (X4).
  Tick longest_gap() const;

 private:
  /// A side of the line.
  struct Side {
    HostFrame open;

    bool begun() const { return !open.bytes.empty(); }
    std::size_t size() const { return open.bytes.size(); }
  };
  bool by_spi() const { return config_.port == Port::kSpi; }
  void reset(Tick at, bool low);
  void set_rate(std::uint32_t rate);
  void take_uart(user_cpu::UartReceiver& from, Tick now, bool answer);
  Tick next_of(const user_cpu::UartReceiver& from) const;
  void host_byte(Tick start, Tick end, std::uint8_t byte);
  void module_byte(Tick start, Tick end, std::uint8_t byte);
  void add(Side& side, Tick start, Tick end, std::uint8_t byte);
  bool is_printed_error() const;
  void end_command(const std::string& wrong);
  void end_answer(const std::string& wrong);
  void follow_rate();
  Tick half(int count) const { return dsdpv1::half_bits(timing_, count); }
  void hand_over(Side& side, const std::string& wrong);
  Tick gap_end() const;

  // tb::SpiFrameReader
  void frame_began(Tick /*at*/) override {}
  void byte(Tick at, std::uint8_t mosi, std::uint8_t miso) override;
  void frame_ended(Tick at) override { nss_rose(at, bits()); }

  const Config config_;
  UartTiming timing_;
  user_cpu::UartReceiver from_host_, from_module_;
  Side command_, answer_;
  Frame last_;        ///< the last command that was heard
  std::string deaf_;  ///< why the open command is not heard
  bool awaits_ = false;
  Tick serves_from_ = bus::kNever, rate_at_ = bus::kNever;
  std::uint32_t new_rate_ = 0;
};

}  // namespace dsdpv1::xgate
