// The waveforms of the user CPU's SPI and UART, edge by edge, against a recorder in place of a chip.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "kinds/dsdpv1/user_cpu/uart_master.hpp"
#include "kinds/user_cpu/spi_master.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using testing::ElementsAre;
using user_cpu::PinSpiMaster;
using user_cpu::PinUartSender;
using user_cpu::UartReceiver;
using Bytes = std::vector<std::uint8_t>;

struct Change {
  Tick at;
  Pin pin;
  bool level;
  bool operator==(const Change& other) const { return at == other.at && pin == other.pin && level == other.level; }
};

void PrintTo(const Change& change, std::ostream* out) {
  *out << "{" << change.at << ", " << static_cast<int>(change.pin) << ", " << change.level << "}";
}

/// Records changes; MISO comes from `answer`.
class Recorder : public user_cpu::SerialPins {
 public:
  void set_serial(Tick at, Pin pin, bool level) override {
    bool& old = levels[pin];
    if (std::exchange(old, level) != level) changes.push_back({at, pin, level});
  }
  bool miso(Tick at) override {
    sampled.push_back(at);
    return answer.empty() || answer[(sampled.size() - 1) % answer.size()];
  }
  std::vector<Change> of(Pin pin) const {
    std::vector<Change> found;
    for (const Change& change : changes)
      if (change.pin == pin) found.push_back(change);
    return found;
  }
  std::map<Pin, bool> levels{{Pin::kXss, true}, {Pin::kRxd, true}};
  std::vector<Change> changes;
  std::vector<Tick> sampled;
  std::vector<bool> answer;
};

void run(user_cpu::Transfer& transfer) {
  while (!transfer.done()) transfer.run(transfer.next());
}

class SpiMasterTest : public testing::Test {
 protected:
  Recorder pins;
  SpiTiming timing{600, 700, 1000, 1100, 5000, 50};
  PinSpiMaster master{pins, timing};
};

TEST_F(SpiMasterTest, AByteHasItsEdgesAtTheirTicks) {
  master.begin(10'000, {0xA0});
  run(master);
  std::vector<Change> clock;
  for (int bit = 0; bit < 8; ++bit) {
    clock.push_back({11'000 + 1300 * bit, Pin::kSck, true});
    clock.push_back({11'600 + 1300 * bit, Pin::kSck, false});
  }
  EXPECT_EQ(pins.of(Pin::kSck), clock);
  EXPECT_THAT(pins.of(Pin::kXss),
              ElementsAre(Change{10'000, Pin::kXss, false}, Change{11'600 + 1300 * 7 + 1100, Pin::kXss, true}));
  EXPECT_THAT(pins.of(Pin::kMosi), ElementsAre(Change{10'000, Pin::kMosi, true}, Change{11'600, Pin::kMosi, false},
                                               Change{12'900, Pin::kMosi, true}, Change{14'200, Pin::kMosi, false}));
}

TEST_F(SpiMasterTest, MosiFollowsSckLaterButStaysWithinTheFrame) {
  timing.mosi_delay = 650;
  timing.lead = 620;
  timing.lag = 630;
  PinSpiMaster late{pins, timing};
  late.begin(0, {0xA1});
  run(late);
  EXPECT_THAT(
      pins.of(Pin::kMosi),
      ElementsAre(Change{620, Pin::kMosi, true}, Change{1220 + 650, Pin::kMosi, false},
                  Change{1220 + 1300 + 650, Pin::kMosi, true}, Change{1220 + 2 * 1300 + 650, Pin::kMosi, false},
                  Change{1220 + 6 * 1300 + 650, Pin::kMosi, true}, Change{1220 + 7 * 1300 + 630, Pin::kMosi, false}));
}

TEST_F(SpiMasterTest, MisoIsSampledAtEachRise) {
  pins.answer = {true, false, false, false, false, false, false, true,
                 true, true,  false, false, true,  false, true,  false};
  master.begin(0, {0, 0});
  run(master);
  EXPECT_THAT(master.received(), ElementsAre(0x81, 0xCA));
  EXPECT_EQ(pins.sampled.front(), 1000);
  EXPECT_EQ(pins.sampled[8], 1000 + 8 * 1300 + 50) << "the gap between bytes";
}

TEST_F(SpiMasterTest, NextFrameWaitsForTheGap) {
  master.begin(0, {0});
  run(master);
  const Tick rose = pins.of(Pin::kXss).back().at;
  master.begin(rose + 1, {0});
  EXPECT_EQ(master.next(), rose + 5000);
  run(master);
  master.begin(1'000'000, {0});
  EXPECT_EQ(master.next(), 1'000'000);
}

TEST_F(SpiMasterTest, FaultsFlipABitOrCutTheFrame) {
  user_cpu::SpiFault fault;
  fault.flipped_bit = 2;
  master.begin(0, {0x00}, fault);
  run(master);
  EXPECT_THAT(pins.of(Pin::kMosi), ElementsAre(Change{1000 + 1300 + 600, Pin::kMosi, true},
                                               Change{1000 + 2 * 1300 + 600, Pin::kMosi, false}));
  pins.changes.clear();
  fault = {};
  fault.cut_after = 3;
  master.begin(100'000, {0x00, 0x00}, fault);
  run(master);
  EXPECT_EQ(pins.of(Pin::kSck).size(), 6U);
  EXPECT_EQ(pins.of(Pin::kXss).back().at, 101'000 + 2 * 1300 + 600 + 1100);
}

class UartMasterTest : public testing::Test {
 protected:
  static constexpr Tick kBit = 1'250'000;  ///< 9600 bit/s
  void hear(const std::vector<bool>& cells, Tick at, Tick bit = kBit) {
    bool last = true;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (std::exchange(last, cells[i]) != cells[i]) receiver.txd_changed(at + static_cast<Tick>(i) * bit, cells[i]);
  }
  Recorder pins;
  UartTiming timing{9600, 0};
  PinUartSender sender{pins, timing};
  UartReceiver receiver{timing};
};

TEST_F(UartMasterTest, ACharacterHasItsBitsLeastSignificantFirstAndEvenParity) {
  sender.begin(1000, {0x13});
  run(sender);
  const auto edge = [](int bit, bool level) { return Change{1000 + bit * kBit, Pin::kRxd, level}; };
  EXPECT_EQ(pins.changes, (std::vector<Change>{edge(0, false), edge(1, true), edge(3, false), edge(5, true),
                                               edge(6, false), edge(9, true)}))
      << "start, 11001000, parity 1 of three ones, stop";
}

TEST_F(UartMasterTest, TheEndIsThatOfTheLastStopBit) {
  timing.gap = 77;
  PinUartSender gapped(pins, timing);
  gapped.begin(0, {0x55, 0x55});
  Tick last = 0;
  while (!gapped.done()) gapped.run(last = gapped.next());
  EXPECT_EQ(last, 22 * kBit + 77);
  EXPECT_EQ(pins.changes[10].at, 11 * kBit + 77) << "the second start bit";
}

TEST_F(UartMasterTest, BitTimesDoNotDrift) {
  timing.baud = 1'843'200;
  PinUartSender fast(pins, timing);
  fast.begin(0, Bytes(100, 0x55));
  Tick last = 0;
  while (!fast.done()) fast.run(last = fast.next());
  EXPECT_EQ(last, (1100 * bus::kTicksPerSecond + 921'600) / 1'843'200);
}

TEST_F(UartMasterTest, FaultsAreTheParityABitOrTheEnd) {
  user_cpu::UartFault fault;
  fault.wrong_parity = 0;
  sender.begin(0, {0x00}, fault);
  run(sender);
  EXPECT_THAT(pins.changes, ElementsAre(Change{0, Pin::kRxd, false}, Change{9 * kBit, Pin::kRxd, true}));
  fault = {};
  fault.cut_after = 1;
  sender.begin(100 * kBit, {0xFF, 0xFF}, fault);
  Tick last = 0;
  while (!sender.done()) sender.run(last = sender.next());
  EXPECT_EQ(last, 111 * kBit);
}

TEST_F(UartMasterTest, FaultsAreABreakAPauseOrACharacterTooMany) {
  const auto edge = [](int bit, bool level) { return Change{bit * kBit, Pin::kRxd, level}; };
  user_cpu::UartFault fault;
  fault.break_at = 1;
  sender.begin(0, {0xFE, 0xFE, 0xFE}, fault);
  run(sender);
  EXPECT_THAT(pins.changes, ElementsAre(edge(0, false), edge(2, true), edge(11, false), edge(22, true)));
  pins.changes.clear();
  fault = {};
  fault.pause_before = 1;
  fault.pause = 5 * kBit;
  sender.begin(0, {0xFE, 0xFE, 0xFE}, fault);
  run(sender);
  EXPECT_THAT(pins.changes, ElementsAre(edge(0, false), edge(2, true), edge(16, false), edge(18, true), edge(27, false),
                                        edge(29, true)));
  pins.changes.clear();
  fault = {};
  fault.talk_over = 20 * kBit;
  sender.begin(0, {0xFE}, fault);
  run(sender);
  EXPECT_THAT(pins.changes, ElementsAre(edge(0, false), edge(2, true), edge(31, false), edge(32, true), edge(40, false),
                                        edge(41, true)));
}

TEST_F(UartMasterTest, CharactersAreHeardAlsoBeforeSomebodyAsks) {
  hear({false, true, true, false, false, true, false, false, false, true, true}, 0);
  hear({false, true, false, false, false, false, false, false, false, true, true}, 11 * kBit);
  receiver.begin(30 * kBit, 2, 5 * kBit);
  run(receiver);
  EXPECT_THAT(receiver.received(), ElementsAre(0x13, 0x01));
}

TEST_F(UartMasterTest, TheyEndInTheMiddleOfTheStopBit) {
  receiver.begin(0, 1, 100 * kBit);
  hear({false, true, true, false, false, true, false, false, false, true, true}, 7 * kBit);
  EXPECT_EQ(receiver.next(), 7 * kBit + 21 * kBit / 2);
  run(receiver);
  EXPECT_TRUE(receiver.done());
}

TEST_F(UartMasterTest, SilenceEndsTheWaiting) {
  receiver.begin(0, 3, 20 * kBit);
  hear({false, true, true, false, false, true, false, false, false, true, true}, 5 * kBit);
  Tick last = 0;
  while (!receiver.done()) receiver.run(last = receiver.next());
  EXPECT_EQ(last, 5 * kBit + 21 * kBit / 2 + 20 * kBit);
  EXPECT_THAT(receiver.received(), ElementsAre(0x13));
}

TEST_F(UartMasterTest, WrongParityIsLeftOutAndCounted) {
  hear({false, true, true, false, false, true, false, false, false, false, true}, 0);
  hear({false, true, false, false, false, false, false, false, false, true, true}, 20 * kBit);
  receiver.begin(40 * kBit, 2, kBit);
  run(receiver);
  EXPECT_THAT(receiver.received(), ElementsAre(0x01));
  EXPECT_EQ(receiver.errors(), 1U);
}

}  // namespace
}  // namespace dsdpv1
