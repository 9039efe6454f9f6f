#pragma once
// The pins of the SPC3 family with a stimulus as signals: a user that starts the chip, and two requests.
#include <map>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "model/systemc/character_line.hpp"
#include "model/systemc/spc3_pins.hpp"
#include "registers/spc3_regs.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

constexpr Tick kSpc3End = 200 * kUs;

/// A change of a pin.
struct Event {
  Tick at;
  spc3::Pin pin;
  spc3::Level level;
  bool operator==(const Event& o) const { return std::tie(at, pin, level) == std::tie(o.at, o.pin, o.level); }
};
using Events = std::vector<Event>;
inline std::ostream& operator<<(std::ostream& out, const Event& e) {
  return out << "tick " << e.at << " " << spc3::name(e.pin) << " = " << e.level;
}

/// All inputs, in order of time; at one tick in the order of the pins' table.
class Stimulus {
 public:
  Events events;

  Stimulus() {
    add(12'007, spc3::Pin::kReset, 0);
    now_ = 20'011;
    write(spc3::regs::kOrgAddress, 9);
    write(spc3::regs::kMode0 + 1, 0x01);
    write(spc3::regs::kImr, 0xFB);  // Baudrate_Detect
    write(spc3::regs::kMode1S, spc3::regs::kMode1Start);
    read(spc3::regs::kOrgAddress);
    for (int i = 0; i < 2; ++i) telegram((60 + 60 * i) * kUs + 7);
    now_ = 185 * kUs + 3;
    read(spc3::regs::kIr);
  }

 private:
  void add(Tick at, spc3::Pin pin, spc3::Level level) { events.push_back({at, pin, level}); }
  void begin(spc3::Pin strobe, int address) {
    add(now_, spc3::Pin::kXCs, 0);
    add(now_ + 61, strobe, 0);
    add(now_ + 61, spc3::Pin::kAb, static_cast<spc3::Level>(address));
  }
  void end(spc3::Pin strobe) {
    add(now_ += 2511, strobe, 1);
    add(now_, spc3::Pin::kDbIn, spc3::kLevelZ);
    add(now_ += 40, spc3::Pin::kXCs, 1);
    now_ += 907;
  }
  void write(int address, int value) {
    begin(spc3::Pin::kXWr, address);
    add(now_ + 100, spc3::Pin::kDbIn, static_cast<spc3::Level>(value));
    end(spc3::Pin::kXWr);
  }
  void read(int address) {
    begin(spc3::Pin::kXRd, address);
    end(spc3::Pin::kXRd);
  }
  void telegram(Tick start) {
    bool level = true;
    for (const int byte : {0x10, 0x09, 0x02, 0x49, 0x54, 0x16}) {
      const std::uint16_t frame = systemc::frame_of(static_cast<std::uint8_t>(byte), true, true);
      for (int bit = 0; bit < 11; ++bit, start += 1000) {
        const bool next = (frame >> bit & 1) != 0;
        if (next != level) add(start, spc3::Pin::kRxd, next);
        level = next;
      }
    }
  }
  Tick now_ = 0;
};

inline const Events& stimulus() {
  static const Stimulus all;
  return all.events;
}

/// The module among its signals.
struct Spc3Board {
  std::map<spc3::Pin, sc_core::sc_signal<bool>> wires;
  sc_core::sc_signal<sc_dt::sc_uint<11>> ab;
  sc_core::sc_signal_rv<8> db;
  sc_core::sc_signal<bool> clk;
  systemc::Spc3PinModule chip;
  Events told, seen, inputs;     ///< from on_pin, and at the signals
  std::vector<std::string> bus;  ///< levels of DB

  /// Begins with the levels at `from`; simulation time is `shift` ticks later.
  Spc3Board(const char* name, const systemc::Spc3PinOptions& options, bool with_clk, Tick shift, Tick from = -1)
      : chip(name, options) {
    using spc3::Pin;
    chip.RESET(wires[Pin::kReset]), chip.XINT_MOT(wires[Pin::kXIntMot]), chip.MODE(wires[Pin::kMode]);
    chip.DIVIDER(wires[Pin::kDivider]), chip.XTEST0(wires[Pin::kXTest0]), chip.XTEST1(wires[Pin::kXTest1]);
    chip.XCS(wires[Pin::kXCs]), chip.XRD_R_W(wires[Pin::kXRd]), chip.XWR_E_CLOCK(wires[Pin::kXWr]);
    chip.ALE_AS(wires[Pin::kAle]), chip.AB(ab), chip.DB(db), chip.RXD(wires[Pin::kRxd]), chip.XCTS(wires[Pin::kXCts]);
    chip.XREADY_XDTACK(wires[Pin::kXReady]), chip.X_INT(wires[Pin::kXInt]), chip.XDATAEXCH(wires[Pin::kXDataExch]);
    chip.TXD(wires[Pin::kTxd]), chip.RTS(wires[Pin::kRts]);
    for (auto& [pin, wire] : wires)
      if (spc3::is_input(pin))
        wire.write(spc3::row(pin).level != 0);
      else
        record(pin, wire);
    chip.on_pin = [this](Tick at, spc3::Pin pin, spc3::Level level) {
      (spc3::is_input(pin) ? inputs : told).push_back({at, pin, level});
    };
    method_on(db.value_changed_event(), [this] { bus.push_back(db.read().to_string()); });
    if (with_clk) chip.CLK(clk), thread([this] { run_clk(); });
    thread([this, shift, from] { play(shift, from); });
  }

 private:
  void record(spc3::Pin pin, sc_core::sc_signal<bool>& wire) {
    method_on(
        wire.value_changed_event(),
        [this, pin = pin, &wire] {
          seen.push_back({systemc::current_tick(), pin, wire.read() ? spc3::Level{1} : spc3::Level{0}});
        });
  }
  void run_clk() {
    for (Tick edge = 0; edge < kSpc3End; edge += 250) {
      wait_until(edge);
      clk.write(true);
      wait_until(edge + 125);
      clk.write(false);
    }
  }
  void play(Tick shift, Tick from) {
    db.write(sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z));
    for (const Event& each : stimulus()) {
      if (each.at > from) wait_until(each.at + shift);
      if (each.pin == spc3::Pin::kAb)
        ab.write(static_cast<unsigned>(each.level));
      else if (each.pin == spc3::Pin::kDbIn)
        db.write(each.level < 0 ? sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z) : sc_dt::sc_lv<8>(static_cast<int>(each.level)));
      else
        wires[each.pin].write(each.level != 0);
    }
  }
};

}  // namespace dsdpv1
