// The pins of the DSDPV1-RSU in SystemC, with the inputs of golden traces as signals: over SPI, over the UART, and over
// SPI with a CLK. The outputs must match the golden, tick by tick.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "tests/systemc/rsu_board.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::to_time;

namespace {

constexpr Tick kEnd = 20'000 * kUs;  // in data exchange

/// A golden and the boards that play it.
struct Played {
  std::unique_ptr<tb::traces::Trace> trace;
  Changes inputs, outputs;

  explicit Played(const char* golden)
      : trace(tb::traces::read_golden(DSDPV1_SOURCE_DIR "/traces", golden).trace),
        inputs(changes_of(*trace, true, kEnd)),
        outputs(changes_of(*trace, false, kEnd)) {}
};

struct World {
  Played spi{"rsu_spi"}, uart{"rsu_uart"};
  RsuBoard over_spi{"spi", spi.inputs, false}, over_spi_with_clk{"spi_with_clk", spi.inputs, true};
  RsuBoard over_uart{"uart", uart.inputs, false, Engine::kStep};
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
void expect_golden(const RsuBoard& board, const Played& played, Pin port, std::size_t least, Tick end = kEnd) {
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
  expect_golden(world->over_spi_with_clk, world->spi, Pin::kMiso, 500, RsuBoard::kClkEnd);
  expect_golden(world->over_uart, world->uart, Pin::kTxd, 1000);
  for (const auto& [id, text] : reports())
    if (text.rfind("spi_with_clk:", 0) != 0) ADD_FAILURE() << id << " " << text;  // its time ends with its CLK
}

}  // namespace
}  // namespace dsdpv1
