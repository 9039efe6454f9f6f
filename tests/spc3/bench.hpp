#pragma once
// A chip of the SPC3 family on a segment: twice, in step and in skip, with the same accesses. Every difference of pins,
// events or read values fails the test, and from time to time one of the two continues from a saved state, its own or
// the other's. A master sends telegrams; the user is the register call. Times are ticks unless their name says
// otherwise.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "bus/master/requester.hpp"
#include "model/profibus/station.hpp"
#include "model/spc3/chip.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3_test {

using bus::Bytes;
using bus::Tick;
using profibus::Cycle;
using profibus::DpState;
using spc3::Address;
using spc3::Pin;
using spc3::Variant;
namespace regs = spc3::regs;

constexpr Cycle kMs = profibus::kCyclesPerMs;
constexpr int kDefaultSap = -1;

struct PinChange {
  Tick at;
  Pin pin;
  spc3::Level level;
};

/// Alone, in skip, the chip keeps no trace either: for long campaigns.
enum class Engines : std::uint8_t { kStepAndSkip, kSkipAlone };

/// Both chips. The one in skip takes telegrams as runs, every second one for the chip, and hears the rest of the line
/// as late as it may. The one in step gets each change of the line.
class Twins : public bus::Agent, public bus::Listener {
 public:
  Twins(bus::Segment& segment, const spc3::Config& config, Engines engines);

  std::uint8_t load(Cycle cycle, Address address);
  void store(Cycle cycle, Address address, std::uint8_t value);
  void set(Tick at, Pin pin, spc3::Level level);
  spc3::Level sample(Tick at);
  const spc3::Chip& chip() const { return skip_; }
  spc3::Chip& chip() { return skip_; }
  void poke(Address address, std::uint8_t value);

  Tick next() const override { return skip_.next_event(); }
  void run(Tick now) override;
  void line_changed(Tick at, bool level) override;
  bool run_begins(const bus::CharacterRun& run) override;
  void run_cut(Tick at, bool level) override;
  void runs_passed(std::uint64_t for_stations) override { skip_.pass(for_stations); }

  /// Both have come to `at`: their traces are equal. Each `restored`-th time one of them continues from a state.
  void compare(Tick at);

  std::vector<PinChange> trace;
  std::vector<profibus::Event> events;
  unsigned restored = 25;
  int runs_taken = 0;

 private:
  static void on_skip_pin(void* self, Tick at, Pin pin, spc3::Level level);
  static void on_step_pin(void* self, Tick at, Pin pin, spc3::Level level);
  static void on_skip_event(void* self, const profibus::Event& event);
  static void on_step_event(void* self, const profibus::Event& event);
  void compare_with_step(Tick at);
  void compare_traces();
  void restore_one(Tick at);
  void hear();
  void leave_run(Tick at);
  void filter();

  /// Hears for step_.
  class Ear : public bus::Listener {
   public:
    explicit Ear(spc3::Chip& chip) : chip_(chip) {}
    void line_changed(Tick at, bool level) override { chip_.set(at, Pin::kRxd, level ? 1 : 0); }

   private:
    spc3::Chip& chip_;
  };

  const bool twin_;
  bus::Segment& segment_;
  bus::StationId station_;
  spc3::Chip skip_, step_;
  Ear ear_{step_};
  std::vector<PinChange> step_trace_;
  std::vector<PinChange> unheard_;  // of RXD, not told to skip_ yet
  std::vector<profibus::Event> step_events_;
  std::size_t compared_pins_ = 0, compared_events_ = 0;
  unsigned comparisons_ = 0, own_runs_ = 0;
};

/// The organisation that initialise() writes: every buffer has 64 bytes, but Len_Dout and Len_Din are short.
struct Organisation {
  std::uint8_t address = 5;
  std::uint16_t ident = 0x0CC9;
  std::uint8_t outputs = 2, inputs = 3;
  std::uint8_t aux_select = 0;
  std::uint16_t user_watchdog = 0;
  std::uint16_t modes = regs::kMode0DpMode | regs::kMode0SyncSupported | regs::kMode0FreezeSupported;
  bool no_add_change = false;
  bool ssa = true;
  Bytes read_cfg = {0x12, 0x21};
};
// Segments of the buffers.
constexpr std::uint8_t kDout = 0x08, kDin = 0x20, kDiag = 0x38, kAux = 0x48, kSsa = 0x58, kPrm = 0x60, kCfg = 0x68,
                       kReadCfg = 0x70;
constexpr int kBufferSize = 64;

class Bench {
 public:
  explicit Bench(Variant variant = Variant::kApc3, spc3::Config config = {}, Engines engines = Engines::kStepAndSkip);

  // --- time
  Tick now() const { return timeline.now(); }
  Cycle cycle() const { return now() / profibus::kTicksPerCycle; }
  void run_until(Tick until);
  void run_cycles(Cycle cycles) { run_until((cycle() + cycles) * profibus::kTicksPerCycle); }
  void run_ms(Cycle ms) { run_cycles(ms * kMs); }

  // --- the user
  std::uint8_t load(Address cell) { return twins.load(cycle(), cell); }
  void store(Address cell, std::uint8_t value) { twins.store(cycle(), cell, value); }
  std::uint16_t irr() { return static_cast<std::uint16_t>(load(regs::kIrr) | load(regs::kIrr + 1) << 8); }
  bool raised(std::uint16_t events) { return (irr() & events) == events; }
  void acknowledge(std::uint16_t events);
  void set_mode1(std::uint8_t bits) { store(regs::kMode1S, bits); }
  /// The bytes of the buffer to which a cell points.
  Bytes buffer(Address pointer, int size);
  void fill(Address pointer, const Bytes& bytes);
  /// Din's U, and New_Din.
  int give_inputs(const Bytes& bytes);
  /// Next_Dout, and the bytes of U.
  Bytes fetch_outputs(int* answer = nullptr);

  void power_on();
  void initialise(const Organisation& given = {});
  void start();  ///< mode register 1, bit 0
  void find_baud(int index = 0);

  // --- the master: single requests, each the begin of a series
  bus::Exchange ask(int dsap, const Bytes& data = {}, std::uint8_t master = 2);
  bus::Exchange repeat(int dsap, const Bytes& data = {}, std::uint8_t master = 2, bool fcb = true);
  void control(std::uint8_t command, std::uint8_t group = 0, std::uint8_t master = 2);
  bus::Exchange exchange(const Bytes& outputs) { return ask(kDefaultSap, outputs); }
  bus::Exchange set_prm(const Bytes& user = {}, std::uint8_t status = 0x80, std::uint8_t wd1 = 0, std::uint8_t wd2 = 0,
                        std::uint8_t tsdr = 0, std::uint8_t group = 0, std::uint8_t master = 2);
  bus::Exchange check_cfg(const Bytes& cfg = {0x12, 0x21}) { return ask(62, cfg); }
  Bytes diag(std::uint8_t master = 2);
  /// Until the effects of the last telegram are there (A40).
  void settle() { run_cycles(64); }

  // --- short cuts
  void to_wait_prm(const Organisation& given = {});
  void to_wait_cfg(const Organisation& given = {}, const Bytes& user_prm = {});
  void to_data_ex(const Organisation& given = {}, const Bytes& user_prm = {});

  Variant variant() const { return variant_; }
  DpState state() const { return twins.chip().status().dp_state; }
  int count(profibus::Reason reason) const;
  int count(const profibus::ReasonRow& row) const { return count(profibus::Reason(row)); }
  std::vector<PinChange> changes(Pin pin) const;

  bus::Timeline timeline;
  bus::Segment segment;
  Twins twins;
  bus::Requester requester;
  Organisation organisation;
  std::uint8_t address = 5;

 private:
  const Variant variant_;
};

/// "SC", "RS", "RR", "DL", "DH", "silent" or the bytes.
std::string kind_of(const bus::Exchange& exchange);

}  // namespace dsdpv1::spc3_test
