#pragma once
// The pins of the DSDPV1-RSU with the inputs of a golden trace as signals.
#include <algorithm>
#include <map>

#include "lab/traces/golden.hpp"
#include "model/systemc/rsu_pins.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

/// The contents of a golden before `end`, in order of time: pin levels, those of power-on first.
inline Changes changes_of(const tb::traces::Trace& trace, bool inputs, Tick end) {
  constexpr std::size_t kSlave = 0;  // in the golden; its pins are its first signals
  Changes changes;
  for (int number = 0; number < kRsuPinCount; ++number) {
    const Pin pin = static_cast<Pin>(number);
    if (is_input(pin) != inputs) continue;
    auto cursor = trace.cursor(kSlave * kRsuPinCount + static_cast<std::size_t>(number));
    for (; cursor.at() < end; cursor.step()) changes.push_back({cursor.at(), pin, static_cast<Level>(cursor.level())});
  }
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
  return changes;
}

/// The module among its signals, which play a golden's inputs.
struct RsuBoard {
  static constexpr Tick kClkEnd = 2'500 * kUs;  ///< with a bound CLK, which is slow: initialised
  std::map<Pin, sc_core::sc_signal<bool>> wires;
  sc_core::sc_signal<sc_dt::sc_uint<11>> a;
  sc_core::sc_signal<sc_dt::sc_uint<2>> mode, adr;
  sc_core::sc_signal<sc_dt::sc_uint<3>> ubr, uiv;
  sc_core::sc_signal_rv<8> d;
  sc_core::sc_signal_resolved miso;
  sc_core::sc_signal<bool> clk;
  systemc::RsuPinModule chip;
  Changes seen;  ///< of the output signals

  /// Begins with the levels at `from`; simulation time is `shift` ticks later.
  RsuBoard(const char* name, const Changes& inputs, bool with_clk, Engine engine = Engine::kSkip, Tick from = -1,
           Tick shift = 0)
      : chip(name, options(engine)) {
    chip.RESET(wires[Pin::kReset]), chip.R_REQ(wires[Pin::kRReq]), chip.R_STA(wires[Pin::kRSta]);
    chip.CSR(wires[Pin::kCsr]), chip.RD(wires[Pin::kRd]), chip.WR(wires[Pin::kWr]), chip.A(a), chip.D(d);
    chip.L_REQ(wires[Pin::kLReq]), chip.L_STA(wires[Pin::kLSta]), chip.INTR0(wires[Pin::kIntr0]);
    chip.PBRXD(wires[Pin::kPbrxd]), chip.PBTXD(wires[Pin::kPbtxd]), chip.PBRTS(wires[Pin::kPbrts]);
    chip.PBF(wires[Pin::kPbf]), chip.BR(wires[Pin::kBr]), chip.READY(wires[Pin::kReady]);
    chip.XSS(wires[Pin::kXss]), chip.SCK(wires[Pin::kSck]), chip.MOSI(wires[Pin::kMosi]), chip.MISO(miso);
    chip.RXD(wires[Pin::kRxd]), chip.TXD(wires[Pin::kTxd]);
    chip.MODE(mode), chip.ADR(adr), chip.UBR(ubr), chip.UIV(uiv);
    if (with_clk) chip.CLK(clk), thread([this] { run_clk(); });
    thread([this, &inputs, from, shift] { play(inputs, from, shift); });
    for (auto& [pin, wire] : wires)
      if (!is_input(pin)) record(pin, wire);
    method_on(miso.value_changed_event(), [this] { see(Pin::kMiso, level_of_miso()); });
  }

 private:
  /// As in the goldens' scenarios.
  static systemc::PinOptions options(Engine engine) {
    systemc::PinOptions options;
    options.chip.engine = engine;
    options.chip.search_window_ms = 5;
    return options;
  }
  void run_clk() {
    for (Tick edge = 0; edge < kClkEnd; edge += 250) {
      wait_until(edge);
      clk.write(true);
      wait_until(edge + 125);
      clk.write(false);
    }
  }
  void play(const Changes& inputs, Tick from, Tick shift) {
    for (const Change& change : inputs) {
      if (change.at > from) wait_until(change.at + shift);
      drive(change.pin, change.level);
    }
  }
  void drive(Pin pin, Level level) {
    const auto value = static_cast<unsigned>(level);
    switch (pin) {
      case Pin::kA: a.write(value); break;
      case Pin::kMode: mode.write(value); break;
      case Pin::kAdr: adr.write(value); break;
      case Pin::kUbr: ubr.write(value); break;
      case Pin::kUiv: uiv.write(value); break;
      case Pin::kDIn: d.write(sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z)); break;  // an unused parallel port
      default: wires[pin].write(level != 0);
    }
  }
  void record(Pin pin, sc_core::sc_signal<bool>& wire) {
    method_on(
        wire.value_changed_event(), [this, pin, &wire] { see(pin, wire.read() ? 1 : 0); });
  }
  Level level_of_miso() const {
    const sc_dt::sc_logic level = miso.read();
    return level == sc_dt::SC_LOGIC_Z ? kLevelZ : static_cast<Level>(level == sc_dt::SC_LOGIC_1);
  }
  void see(Pin pin, Level level) { seen.push_back({dsdpv1::systemc::current_tick(), pin, level}); }
};

}  // namespace dsdpv1
