#pragma once
// A bench for conformance tests: the chip (twice, see twin_chip.hpp) on a segment with a scripted requester, and a user
// at its pins. Every call runs simulated time; every time is in ticks (1/12 ns) unless its name says otherwise.
#include <optional>
#include <vector>

#include "bus/master/requester.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tests/conformance/twin_chip.hpp"

namespace dsdpv1::conformance {

using bus::Bytes;

constexpr Tick kCycleTicks = profibus::kTicksPerCycle;
constexpr profibus::Cycle kMs = profibus::kCyclesPerMs;

/// The initialisation block B020..; the defaults give a slave at 5 with 2 input and 2 output bytes, ident 0x0CC9,
/// judged by the chip.
struct Init {
  std::uint8_t address = 5;
  std::uint16_t ident = 0x0CC9;
  std::uint8_t command = 0x0F;  ///< fail-safe, sync, freeze, address change supported
  std::uint8_t max_input = 244, max_output = 244, max_diag = 32, max_prm = 237, prm_mode = 0, max_cfg = 200,
               cfg_mode = 0;
  Bytes cfg = {0x11, 0x21};
  std::optional<std::uint8_t> length = {};  ///< B020; default: up to the last configuration byte
  std::uint16_t crc_error = 0;              ///< exclusive-ored to the right CRC

  Bytes block() const;
};

/// Set_Prm's seven standard bytes and the user's.
struct Prm {
  std::uint8_t status = 0x80;  ///< lock
  std::uint8_t wd1 = 0, wd2 = 0, min_tsdr = 11;
  std::uint16_t ident = 0x0CC9;
  std::uint8_t group = 0;
  Bytes user = {};

  Bytes bytes() const;
};

class SlaveBench {
 public:
  explicit SlaveBench(const dsdpv1::Config& config = {}, Engines engines = Engines::kStepAndSkip);

  // --- time
  Tick now() const { return timeline.now(); }
  void run_for(Tick duration) { run_until(now() + duration); }
  void run_until(Tick until);
  void run_cycles(std::int64_t cycles) { run_for(cycles * 250); }
  void run_ms(std::int64_t ms) { run_for(ms * bus::kTicksPerMs); }

  // --- the user at the pins
  /// RESET high 10 cycles from now, then until B004 = 0xC5.
  void power_on();
  /// R_REQ up, waits for L_REQ = L_STA = 0 seen 4 cycles later, R_STA up. The time from R_REQ to R_STA.
  Tick acquire();
  void release();
  std::uint8_t read(std::uint16_t cell);  ///< fails the test when D is X; the user must own the DPRAM
  void write(std::uint16_t cell, std::uint8_t value);
  /// Area bytes followed by their CRC at `crc_address`.
  void write_block(std::uint16_t base, const Bytes& bytes, std::uint16_t crc_address, std::uint16_t crc_error = 0);
  /// acquire, write one byte, release.
  void poke(std::uint16_t cell, std::uint8_t value);
  std::uint8_t peek(std::uint16_t cell) { return chip.peek(cell); }  ///< debug access: no pins, no time
  Bytes peek(std::uint16_t cell, int count);
  /// Lets the chip have the DPRAM: releases (when held) and runs until `accesses` more of its accesses have ended.
  void chip_accesses(int accesses = 2);

  /// Writes the block, sets B010.2, releases, waits two accesses. True when B00A.0 is 1 afterwards.
  bool initialise(const Init& init = {});
  /// B005 := 0x1D or 0.
  void enable_dpv1(bool on) { poke(dsdpv1::regs::kDpv1Enable, on ? 0x1D : 0x00); }
  void give_inputs(const Bytes& inputs, std::uint16_t crc_error = 0);
  void give_diag(std::uint8_t type, const Bytes& diag, std::uint16_t crc_error = 0);
  /// B00C and B010.7/.6 as given, in one hold.
  void verdict(std::optional<bool> prm_good, std::optional<bool> cfg_good);
  /// What B319.. holds, CRC checked; nothing when B00E.0 is 0 (the flag is cleared by the call).
  std::optional<Bytes> fetch_outputs();

  // --- the master
  /// A baud rate (0 = 12M ... 9 = 9.6k), and one telegram after another to no station until the chip has found it.
  void find_baud(int index = 0);
  /// Request with SRD to the chip's address from `master` (default 2) with a right frame count bit.
  bus::Exchange srd(int dsap, int ssap, const Bytes& data);
  bus::Exchange data_exchange(const Bytes& outputs);
  bus::Exchange set_prm(const Prm& prm) { return srd(61, 62, prm.bytes()); }
  bus::Exchange check_cfg(const Bytes& cfg = {0x11, 0x21}) { return srd(62, 62, cfg); }
  /// The answer's data, the six standard bytes first; empty when there is no right answer.
  Bytes slave_diag();
  void global_control(std::uint8_t command, std::uint8_t group = 0);
  bus::Exchange fdl_status();

  // --- short cuts
  void to_wait_prm(const Init& init = {}, int baud = 0);
  void to_wait_cfg(const Init& init = {}, const Prm& prm = {}, int baud = 0);
  void to_data_exch(const Init& init = {}, const Prm& prm = {}, int baud = 0);

  dsdpv1::DpState dp_state() const { return chip.status().dp_state; }
  /// How often the chip gave this reason, and the last event with it.
  int count(profibus::Reason reason) const;
  const profibus::Event& last(profibus::Reason reason) const;
  /// Changes of a pin, in order.
  std::vector<PinChange> changes(Pin pin) const;

  bus::Timeline timeline;
  bus::Segment segment;
  TwinChip chip;
  bus::Requester requester;
  std::uint8_t address = 5, master = 2;
  bool fcb = true, fcb_valid = false;  ///< the next request's; reset when `master` changes the series

 private:
  bool owns_ = false;
};

}  // namespace dsdpv1::conformance
