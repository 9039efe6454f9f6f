#pragma once
// A saturated 12 Mbit/s bus for a single DSDPV1: data exchanges of one size, back to back at T_SYN. The edges of the
// requests are made beforehand and the user is idle, so that a measurement contains little except the chip. The core
// gets its requests as runs of characters, the RTL as changes of PBRXD.
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "model/dpram/crc16.hpp"
#include "model/dsdpv1/pins.hpp"
#include "model/profibus/character_run.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tests/conformance/slave_bench.hpp"

namespace dsdpv1::speed {

using bus::Bytes;
using profibus::Tick;

constexpr Tick kBit = 1000;  ///< 12 Mbit/s
constexpr double kTicksPerSecond = 12e9;
constexpr int kSynBits = 33;  ///< T_SYN: the idle time before a request

struct LineEdge {
  Tick at;
  bool level;
};

/// A telegram on the line: its changes, relative to its first start bit, and its length.
struct Wave {
  std::vector<LineEdge> edges;
  Tick length = 0;
};

inline Wave wave_of(const Bytes& telegram) {
  Wave wave;
  bool level = true;
  for (const bus::Character& character : bus::characters(telegram)) {
    for (int i = 0; i < bus::kCharacterBits; ++i, wave.length += kBit) {
      const bool bit = ((character.bits >> i) & 1) != 0;
      if (bit != level) wave.edges.push_back({wave.length, bit});
      level = bit;
    }
  }
  return wave;
}

/// A request in every form.
struct Request {
  explicit Request(const Bytes& bytes) : telegram(bytes), wave(wave_of(bytes)) {}
  Bytes telegram;
  Wave wave;
};

/// Identifiers for as many inputs as outputs, at most 16 of each in one.
inline Bytes identifiers(int io) {
  Bytes cfg;
  for (int left = io; left > 0; left -= 16) cfg.push_back(static_cast<std::uint8_t>(0x30 | (std::min(left, 16) - 1)));
  return cfg;
}

/// Cells and values written by the user at start-up, in order.
struct Cell {
  std::uint16_t address;
  std::uint8_t value;
};

inline std::vector<Cell> initialisation(int io) {
  conformance::Init init;
  init.cfg = identifiers(io);
  const Bytes block = init.block();
  const unsigned crc = dpram::crc16(block.data(), static_cast<int>(block.size()));
  std::vector<Cell> cells;
  std::uint16_t address = dsdpv1::regs::kInit;
  for (const std::uint8_t byte : block) cells.push_back({address++, byte});
  cells.push_back({dsdpv1::regs::kInitCrc, static_cast<std::uint8_t>(crc >> 8)});
  cells.push_back({dsdpv1::regs::kInitCrc + 1, static_cast<std::uint8_t>(crc & 0xFF)});
  cells.push_back({dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Init});
  return cells;
}

/// FDL status (which ends the baud rate search), Set_Prm, Chk_Cfg.
inline std::vector<Bytes> bring_up(int io) {
  return {bus::encode(bus::make_telegram(100, 2, 0x49)),
          bus::encode(bus::make_telegram(5, 2, 0x6D, conformance::Prm().bytes(), 61, 62)),
          bus::encode(bus::make_telegram(5, 2, 0x5D, identifiers(io), 62, 62))};
}

/// A data exchange with either frame count bit.
inline std::vector<Bytes> exchange_requests(int io) {
  const Bytes outputs(static_cast<std::size_t>(io), 0x5A);
  return {bus::encode(bus::make_telegram(5, 2, 0x5D, outputs)), bus::encode(bus::make_telegram(5, 2, 0x7D, outputs))};
}

/// Bit times from the end of a request to the next one: T_SDR, the answer, T_SYN. The master keeps the minimum idle
/// time, so that a late answer is not overwritten.
inline int answer_and_syn_bits(int io) {
  constexpr int kTsdr = 12, kFrame = 9;
  return kTsdr + bus::kCharacterBits * (io + kFrame) + kSynBits;
}

/// The master's side. `Device`: set(Tick, Pin, Level), hear(Tick, CharacterRun), advance(Tick), like the chips.
template <class Device, auto kRxd>
class RequestLine {
 public:
  RequestLine(Device& device, int io) : device_(device), io_(io) {
    for (const Bytes& request : exchange_requests(io)) requests_.emplace_back(request);
  }

  void exchange() {
    send(requests_[toggle_ ^= 1U], answer_and_syn_bits(io_));
    ++exchanges_;
  }
  /// As long as exchanges take less than this time.
  void exchange_for(Tick duration) {
    for (const Tick end = now_ + duration; now_ < end;) exchange();
  }

  Tick now() const { return now_; }
  std::uint64_t exchanges() const { return exchanges_; }

 protected:
  static constexpr Tick kMillisecond = 12'000'000;

  void wait(Tick ticks) { device_.advance(now_ += ticks); }
  template <class InputPin>
  void set(Tick after, InputPin pin, Level level) {
    device_.set(now_ += after, pin, level);
  }
  /// A request, and longer than any answer of the bring-up.
  void bring_up_by(const Bytes& request) { send(Request(request), 1000); }
  Device& device_;
  const int io_;

 private:
  void send(const Request& request, int idle_bits) {
    if (!hears(request.telegram))
      for (const LineEdge& edge : request.wave.edges) device_.set(now_ + edge.at, kRxd, edge.level ? 1 : 0);
    wait(request.wave.length + idle_bits * kBit);
  }
  bool hears(const Bytes& telegram) {
    const profibus::CharacterRun run{now_, kBit / profibus::kTicksPerCycle, telegram.data(),
                                     static_cast<int>(telegram.size())};
    return device_.hear(now_, run);
  }

  Tick now_ = 0;
  std::vector<Request> requests_;
  unsigned toggle_ = 0;
  std::uint64_t exchanges_ = 0;
};

/// With the user of a DSDPV1. `Device`: level(Pin), too.
template <class Device>
class SaturatedBus : public RequestLine<Device, Pin::kPbrxd> {
  using Line = RequestLine<Device, Pin::kPbrxd>;

 public:
  using Line::Line;

  /// From power-on to data exchange.
  void start() {
    reset();
    initialise();
    for (const Bytes& request : bring_up(io_)) this->bring_up_by(request);
  }

  // --- for what does not begin with data exchange
  void reset() {
    constexpr Tick kReady = 6000 * profibus::kTicksPerCycle;  // D1: 4096 cycles
    set(10 * profibus::kTicksPerCycle, Pin::kReset, 1);
    wait(kReady);
  }
  void initialise() {
    take();
    for (const Cell& cell : initialisation(io_)) write(cell);
    set(0, Pin::kRSta, 0);
    set(0, Pin::kRReq, 0);
    wait(kMillisecond);
  }

 private:
  using Line::device_;
  using Line::io_;
  using Line::kMillisecond;
  using Line::set;
  using Line::wait;

  void take() {
    set(0, Pin::kRReq, 1);
    do wait(4 * profibus::kTicksPerCycle);
    while (device_.level(Pin::kLReq) != 0 || device_.level(Pin::kLSta) != 0);
    set(0, Pin::kRSta, 1);
    wait(4 * profibus::kTicksPerCycle);
  }
  void write(const Cell& cell) {
    constexpr Tick kSetup = 240, kStrobe = 600, kHold = 240;  // 20 ns, 50 ns, 20 ns
    set(0, Pin::kA, static_cast<Level>(cell.address));
    set(0, Pin::kDIn, cell.value);
    set(0, Pin::kCsr, 0);
    set(kSetup, Pin::kWr, 0);
    set(kStrobe, Pin::kWr, 1);
    set(kHold, Pin::kCsr, 1);
    set(0, Pin::kDIn, dsdpv1::kLevelZ);
    wait(kHold);
  }
};

/// Counts the changes of the watched pins: the minimum cost of an observer of L_REQ and PBTXD.
struct PinCounter {
  static constexpr std::uint32_t kWatched = dsdpv1::mask(Pin::kLReq) | dsdpv1::mask(Pin::kPbtxd);
  std::uint64_t line = 0, requests = 0;

  dsdpv1::PinSink sink() {
    return {[](void* self, Tick, Pin pin, Level) { static_cast<PinCounter*>(self)->count(pin); }, this};
  }
  void count(Pin pin) { ++(pin == Pin::kPbtxd ? line : requests); }
  bool has_seen() const { return line > 0 && requests > 0; }
  bool operator==(const PinCounter& other) const { return line == other.line && requests == other.requests; }
};

/// Thrown if a measurement would be meaningless.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace dsdpv1::speed
