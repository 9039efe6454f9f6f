// The pins of the SPC3 family in SystemC: one stimulus for the core alone and for the module with CLK unbound, bound
// and in another phase. Each output changes at the same tick of the chip, and so do its signals.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "model/systemc/character_line.hpp"
#include "model/systemc/spc3_pins.hpp"
#include "model/systemc/spi_pins.hpp"
#include "registers/spc3_regs.hpp"
#include "tests/systemc/bench.hpp"
#include "tests/systemc/spc3_initiator.hpp"

namespace dsdpv1 {

using systemc::current_tick;
using systemc::Spc3PinModule;
using systemc::to_time;
namespace regs = spc3::regs;

namespace {

constexpr Tick kSpc3End = 200 * kUs, kPhase = 100, kBit = 1000;

struct Event {
  Tick at;
  spc3::Pin pin;
  spc3::Level level;
  bool operator==(const Event& o) const { return std::tie(at, pin, level) == std::tie(o.at, o.pin, o.level); }
};
using Events = std::vector<Event>;
std::ostream& operator<<(std::ostream& out, const Event& e) {
  return out << "tick " << e.at << " " << spc3::name(e.pin) << " = " << e.level;
}

/// All inputs, in order of time; at one tick in the order of the pins' table.
class Stimulus {
 public:
  Events events;

  Stimulus() {
    add(12'007, spc3::Pin::kReset, 0);
    now_ = 20'011;
    write(regs::kOrgAddress, 9);
    write(regs::kMode0 + 1, 0x01);
    write(regs::kImr, 0xFB);  // Baudrate_Detect
    write(regs::kMode1S, regs::kMode1Start);
    read(regs::kOrgAddress);
    for (int i = 0; i < 2; ++i) telegram((60 + 60 * i) * kUs + 7);
    now_ = 185 * kUs + 3;
    read(regs::kIr);
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
      for (int bit = 0; bit < 11; ++bit, start += kBit) {
        const bool next = (frame >> bit & 1) != 0;
        if (next != level) add(start, spc3::Pin::kRxd, next);
        level = next;
      }
    }
  }
  Tick now_ = 0;
};

const Events& stimulus() {
  static const Stimulus all;
  return all.events;
}

/// Outputs of the core alone, without DB.
struct Core {
  Events all;
  Core() {
    spc3::Chip chip;
    chip.watch({[](void* self, Tick at, spc3::Pin pin, spc3::Level level) {
                  static_cast<Events*>(self)->push_back({at, pin, level});
                },
                &all},
               spc3::kOutputPins);
    for (const Event& each : stimulus()) chip.set(each.at, each.pin, each.level);
    chip.advance(kSpc3End);
  }
};

/// The module among its signals.
struct Board {
  std::map<spc3::Pin, sc_core::sc_signal<bool>> wires;
  sc_core::sc_signal<sc_dt::sc_uint<11>> ab;
  sc_core::sc_signal_rv<8> db;
  sc_core::sc_signal<bool> clk;
  Spc3PinModule chip;
  Events told, seen, inputs;     ///< from on_pin, and at the signals
  std::vector<std::string> bus;  ///< levels of DB

  Board(const char* name, const systemc::Spc3PinOptions& options, bool with_clk, Tick shift) : chip(name, options) {
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
    thread([this, shift] { play(shift); });
  }

 private:
  void record(spc3::Pin pin, sc_core::sc_signal<bool>& wire) {
    method_on(
        wire.value_changed_event(),
        [this, pin = pin, &wire] {
          seen.push_back({current_tick(), pin, wire.read() ? spc3::Level{1} : spc3::Level{0}});
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
  void play(Tick shift) {
    db.write(sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z));
    for (const Event& each : stimulus()) {
      wait_until(each.at + shift);
      if (each.pin == spc3::Pin::kAb)
        ab.write(static_cast<unsigned>(each.level));
      else if (each.pin == spc3::Pin::kDbIn)
        db.write(each.level < 0 ? sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z) : sc_dt::sc_lv<8>(static_cast<int>(each.level)));
      else
        wires[each.pin].write(each.level != 0);
    }
  }
};

/// A VPC3+S at SPI. Its bus is at rest.
struct SpiBoard {
  std::map<spc3::Pin, sc_core::sc_signal<bool>> wires;
  sc_core::sc_signal<sc_dt::sc_uint<11>> ab;
  sc_core::sc_signal_rv<8> db;
  sc_core::sc_signal<sc_dt::sc_logic> miso{"miso"};
  Spc3PinModule chip;
  systemc::SpiPins host{"spi_host"};
  Initiator cpu{"spi_cpu"};
  std::vector<std::uint8_t> read, by_bytes;
  sc_dt::sc_logic rest;  ///< of MISO after all

  SpiBoard() : chip("spi", of_vpc3()) {
    using spc3::Pin;
    chip.RESET(wires[Pin::kReset]), chip.XINT_MOT(wires[Pin::kXIntMot]), chip.MODE(wires[Pin::kMode]);
    chip.DIVIDER(wires[Pin::kDivider]), chip.XTEST0(wires[Pin::kXTest0]), chip.XTEST1(wires[Pin::kXTest1]);
    chip.XCS(wires[Pin::kXCs]), chip.XRD_R_W(wires[Pin::kXRd]), chip.XWR_E_CLOCK(wires[Pin::kXWr]);
    chip.ALE_AS(wires[Pin::kAle]), chip.AB(ab), chip.DB(db), chip.RXD(wires[Pin::kRxd]), chip.XCTS(wires[Pin::kXCts]);
    chip.XREADY_XDTACK(wires[Pin::kXReady]), chip.X_INT(wires[Pin::kXInt]), chip.XDATAEXCH(wires[Pin::kXDataExch]);
    chip.TXD(wires[Pin::kTxd]), chip.RTS(wires[Pin::kRts]);
    chip.AB11(wires[Pin::kAb11]), chip.SERIAL(wires[Pin::kSerial]), chip.SCK(wires[Pin::kSck]);
    chip.MOSI(wires[Pin::kMosi]), chip.XSS(wires[Pin::kXss]), chip.MISO(miso);
    host.XSS(wires[Pin::kXss]), host.SCK(wires[Pin::kSck]), host.MOSI(wires[Pin::kMosi]), host.MISO(miso);
    cpu.socket.bind(host.socket);
    for (auto& [pin, wire] : wires)
      if (spc3::is_input(pin) && pin != Pin::kXss && pin != Pin::kSck && pin != Pin::kMosi)
        wire.write(spc3::row(pin).level != 0);
    wires[Pin::kSerial].write(true);
    thread([this] {
      wait_until(12'007);
      wires[Pin::kReset].write(false);
      wait_until(20'011);
      exchange({0x12, 0x01, 0x23, 0xA5});
      wait_until(120'011);
      read = exchange({0x13, 0x01, 0x23, 0x00});
      host.set_cs(false);  // as a controller of single bytes from here on
      for (const std::uint8_t byte : std::vector<std::uint8_t>{0x13, 0x01, 0x23, 0x00})
        by_bytes.push_back(exchange({byte}).front());
      host.set_cs(true);
      sc_core::wait(1, sc_core::SC_US);
      rest = miso.read();
    });
  }

 private:
  static systemc::Spc3PinOptions of_vpc3() {
    systemc::Spc3PinOptions options;
    options.chip.variant = spc3::Variant::kVpc3;
    return options;
  }
  std::vector<std::uint8_t> exchange(std::vector<std::uint8_t> bytes) {
    return cpu.send(tlm::TLM_READ_COMMAND, 0, std::move(bytes)).data;
  }
};

systemc::Spc3PinOptions shifted() {
  systemc::Spc3PinOptions options;
  options.phase = kPhase;
  return options;
}

struct World {
  Board unbound{"unbound", {}, false, 0}, bound{"bound", {}, true, 0}, later{"later", shifted(), false, kPhase};
  SpiBoard spi;
};
std::unique_ptr<World> world;

Events sorted(Events events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return std::tie(a.at, a.pin) < std::tie(b.at, b.pin); });
  return events;
}
/// The changes of single wires after power-on and before `end`.
Events single(const Events& all, Tick end, Tick shift = 0) {
  Events some;
  for (const Event& each : all)
    if (spc3::width(each.pin) == 1 && each.at > shift && each.at < end + shift)
      some.push_back({each.at - shift, each.pin, each.level});
  return sorted(some);
}

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>();
  sc_core::sc_start(to_time(kSpc3End));
}

namespace {

TEST(Spc3Pins, ChangeAtTheTicksOfTheCoreAlone) {
  const Core core;
  const Events wanted = sorted(core.all);
  const auto changes = [&](spc3::Pin pin) {
    return std::count_if(wanted.begin(), wanted.end(), [pin](const Event& each) { return each.pin == pin; });
  };
  EXPECT_EQ(changes(spc3::Pin::kXReady), 2 * 6);
  EXPECT_EQ(changes(spc3::Pin::kXInt), 1);
  EXPECT_EQ(changes(spc3::Pin::kRts), 2);  // an answer
  EXPECT_GT(changes(spc3::Pin::kTxd), 20);
  EXPECT_EQ(sorted(world->unbound.told), wanted);
  EXPECT_EQ(sorted(world->bound.told), wanted);
  EXPECT_EQ(sorted(world->later.told), wanted);
}

TEST(Spc3Pins, SignalsChangeAtTheirTicks) {
  const Core core;
  const Events wanted = single(core.all, kSpc3End - kUs);
  EXPECT_EQ(single(world->unbound.seen, kSpc3End - kUs), wanted);
  EXPECT_EQ(single(world->later.seen, kSpc3End - kUs, kPhase), wanted);
}

/// The inputs of the core at DB_IN.
Events user_data(const Events& all) {
  Events some;
  for (const Event& each : all)
    if (each.pin == spc3::Pin::kDbIn && (some.empty() ? spc3::kLevelZ : some.back().level) != each.level)
      some.push_back(each);
  return some;
}

TEST(Spc3Pins, DbIsDrivenByUserAndChipInTurn) {
  EXPECT_EQ(user_data(world->unbound.inputs), user_data(stimulus()));  // not what the chip drives
  // 09 of the first write, and again as the read of that cell gives it; 00 of the read of IR's low byte is 04.
  const std::vector<std::string>& bus = world->unbound.bus;
  EXPECT_EQ(std::count(bus.begin(), bus.end(), "00001001"), 2);
  EXPECT_EQ(std::count(bus.begin(), bus.end(), "00000100"), 1);
  EXPECT_EQ(std::count(bus.begin(), bus.end(), "XXXXXXXX"), 2);  // both reads, until ready
  EXPECT_EQ(world->unbound.chip.peek(regs::kOrgAddress), 9);
}

TEST(Spc3Pins, OfAVpc3HaveSpi) {
  const SpiBoard& board = world->spi;
  EXPECT_EQ(board.chip.peek(0x123), 0xA5);
  EXPECT_EQ(board.read, (std::vector<std::uint8_t>{0xFF, 0xFF, 0xFF, 0xA5}));
  EXPECT_EQ(board.by_bytes, board.read);
  EXPECT_EQ(board.rest, sc_dt::SC_LOGIC_Z);
}

/// CLKOUT2/4 has none (A43); DB is one port for both directions.
TEST(Spc3Pins, EachPinOfTheTableIsAPort) {
  for (int i = 0; i < spc3::kPinCount; ++i) {
    const std::string pin = spc3::name(static_cast<spc3::Pin>(i));
    const std::string port = pin.rfind("DB_", 0) == 0 ? "DB" : pin;
    EXPECT_EQ(sc_core::sc_find_object(("unbound." + port).c_str()) != nullptr, pin != "CLKOUT2_4") << pin;
  }
}

}  // namespace
}  // namespace dsdpv1
