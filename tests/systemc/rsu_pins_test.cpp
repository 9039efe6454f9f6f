// The pins of the DSDPV1-RSU in SystemC, with the inputs of golden traces as signals: over SPI, over the UART, and over
// SPI with a CLK. The outputs must match the golden, tick by tick.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "lab/traces/golden.hpp"
#include "model/systemc/rsu_pins.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::PinOptions;
using dsdpv1::systemc::to_time;

namespace {

constexpr Tick kEnd = 20'000 * kUs;    // in data exchange
constexpr Tick kClkEnd = 2'500 * kUs;  // with a bound CLK, which is slow: initialised
constexpr std::size_t kSlave = 0;      // in the golden; its pins are its first signals

/// The contents of a golden up to kEnd, in order of time: pin levels, those of power-on first.
Changes changes_of(const tb::traces::Trace& trace, bool inputs) {
  Changes changes;
  for (int number = 0; number < kRsuPinCount; ++number) {
    const Pin pin = static_cast<Pin>(number);
    if (is_input(pin) != inputs) continue;
    auto cursor = trace.cursor(kSlave * kRsuPinCount + static_cast<std::size_t>(number));
    for (; cursor.at() < kEnd; cursor.step()) changes.push_back({cursor.at(), pin, static_cast<Level>(cursor.level())});
  }
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
  return changes;
}

/// The module among its signals, which play a golden's inputs.
struct Board {
  std::map<Pin, sc_core::sc_signal<bool>> wires;
  sc_core::sc_signal<sc_dt::sc_uint<11>> a;
  sc_core::sc_signal<sc_dt::sc_uint<2>> mode, adr;
  sc_core::sc_signal<sc_dt::sc_uint<3>> ubr, uiv;
  sc_core::sc_signal_rv<8> d;
  sc_core::sc_signal_resolved miso;
  sc_core::sc_signal<bool> clk;
  systemc::RsuPinModule chip;
  Changes seen;  ///< of the output signals

  Board(const char* name, const Changes& inputs, bool with_clk, Engine engine = Engine::kSkip)
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
    thread([this, &inputs] { play(inputs); });
    for (auto& [pin, wire] : wires)
      if (!is_input(pin)) record(pin, wire);
    method_on(miso.value_changed_event(), [this] { see(Pin::kMiso, level_of_miso()); });
  }

 private:
  /// As in the goldens' scenarios.
  static PinOptions options(Engine engine) {
    PinOptions options;
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
  void play(const Changes& inputs) {
    for (const Change& change : inputs) {
      wait_until(change.at);
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

/// A golden and the boards that play it.
struct Played {
  std::unique_ptr<tb::traces::Trace> trace;
  Changes inputs, outputs;

  explicit Played(const char* golden)
      : trace(tb::traces::read_golden(DSDPV1_SOURCE_DIR "/traces", golden).trace),
        inputs(changes_of(*trace, true)),
        outputs(changes_of(*trace, false)) {}
};

struct World {
  Played spi{"rsu_spi"}, uart{"rsu_uart"};
  Board over_spi{"spi", spi.inputs, false}, over_spi_with_clk{"spi_with_clk", spi.inputs, true};
  Board over_uart{"uart", uart.inputs, false, Engine::kStep};
};

std::unique_ptr<World> world;

/// Each signal's changes after power-on and before `end`.
std::map<Pin, Changes> by_pin(const Changes& all, Tick end) {
  std::map<Pin, Changes> pins;
  for (const Change& change : all)
    if (change.at > 0 && change.at < end && change.pin != Pin::kDOut) pins[change.pin].push_back(change);
  return pins;
}

/// `port`: its output, with at least `least` changes.
void expect_golden(const Board& board, const Played& played, Pin port, std::size_t least, Tick end = kEnd) {
  const auto seen = by_pin(board.seen, end), golden = by_pin(played.outputs, end);
  EXPECT_GT(golden.at(port).size(), least);
  ASSERT_EQ(seen.size(), golden.size());
  for (const auto& [pin, changes] : golden) EXPECT_TRUE(seen.at(pin) == changes) << name(pin);
}

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>();
  sc_core::sc_start(to_time(kEnd));
}

namespace {

TEST(RsuPins, SignalsOverBothPortsGiveTheGoldens) {
  expect_golden(world->over_spi, world->spi, Pin::kMiso, 1000);
  expect_golden(world->over_spi_with_clk, world->spi, Pin::kMiso, 500, kClkEnd);
  expect_golden(world->over_uart, world->uart, Pin::kTxd, 1000);
  for (const auto& [id, text] : reports())
    if (text.rfind("spi_with_clk:", 0) != 0) ADD_FAILURE() << id << " " << text;  // its time ends with its CLK
}

}  // namespace
}  // namespace dsdpv1
