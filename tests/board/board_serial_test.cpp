// The board's serial ports, observed at the chip's pins and by firmware: the actions are in
// tests/board/firmware/serial.c.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bitset>
#include <map>

#include "kinds/board/board.hpp"
#include "kinds/dsdpv1/board/wiring.hpp"
#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"
#include "tests/kinds/quiet_device.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using dsdpv1::Pin;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

enum Program {
  kSpi1,
  kSpi2,
  kOverrun,
  kSpiByInterrupt,
  kUart,
  kUartOverrun,
  kOwnEvent,
  kCard2,
  kByHand,
  kMisused,
  kRemapped,
  kQuick,
  kBusy,
  kUnsetUart
};

constexpr Tick kHclk9 = 1500;  // nine periods of 72 MHz
/// So many periods of 72 MHz.
constexpr Tick cycles(Tick count) { return count * kHclk9 / 9; }

/// The memory bus: only the bytes that firmware writes into the chip.
class Memory : public QuietDevice {
 public:
  void set(Tick, tb::PinNumber moved, Level level) override {
    const Pin pin = static_cast<Pin>(moved);
    if (pin == Pin::kA) address_ = level;
    if (pin == Pin::kDIn) data_ = level;
    if (pin == Pin::kWr && level == 1) cells[address_].push_back(data_);
  }
  Level level(tb::PinNumber) const override { return 0; }
  Level sample(Tick) override { return 0; }
  std::map<int, std::vector<int>> cells;  ///< what was written, by address

 private:
  Level address_ = 0, data_ = 0;
};

/// Records the serial pins; MISO gives the bits of `answer`, the most significant first, one for each rise of SCK.
class SerialBus : public user_cpu::PinHostBus {
 public:
  using PinHostBus::PinHostBus;
  struct Change {
    Tick at;
    bool level;
  };
  void set_serial(Tick at, Pin pin, bool level) override {
    EXPECT_GE(at, last_);
    last_ = at;
    changes[pin].push_back({at, level});
    if (pin == Pin::kSck && level) ++rises_;
  }
  bool miso(Tick) override { return (answer >> (7 - rises_ % 8) & 1U) != 0; }
  std::vector<bool> levels(Pin pin) {
    std::vector<bool> all;
    for (const Change& each : changes[pin]) all.push_back(each.level);
    return all;
  }
  void restart() {
    last_ = 0;
    rises_ = 0;
  }
  unsigned answer = 0xFF;
  std::map<Pin, std::vector<Change>> changes;

 private:
  Tick last_ = 0;
  unsigned rises_ = 0;
};

class BoardSerial : public testing::Test {
 protected:
  void start(Program program, unsigned card = 1, bool serial = true, HostMode mode = HostMode::kParallel) {
    arm::BoardOptions options;
    auto firmware = std::make_shared<arm::Firmware>(*arm::load_firmware(SERIAL));
    const std::uint32_t word = firmware->image.symbols.at("program").address;
    for (arm::Segment& segment : firmware->image.segments)
      if (word >= segment.address && word < segment.address + segment.bytes.size())
        segment.bytes[word - segment.address] = static_cast<std::uint8_t>(program);
    options.firmware = firmware;
    options.fsmc.hclk_mhz = 72;
    options.card = card;
    options.wiring = tb::dsdpv1_wiring(card);
    options.serial = serial;
    options.mode = mode;
    board = std::make_unique<arm::Board>(
        host, std::move(options), [this](Tick at, bool level) { resets.emplace_back(at, level); }, kStart);
    board->on_error = [this](const user_cpu::ProgramError& error) {
      misuses.push_back(
          fmt::format("{}, in {} at {}:{}", error.text, error.where->function, error.where->file, error.where->line));
    };
    board->on_failure = [](Tick, const std::string& why, const std::string&) { ADD_FAILURE() << why; };
  }
  void run_until(Tick end) {
    while (board->next() <= end) board->run(board->next());
  }
  void run() { run_until(kStart + bus::kTicksPerMs); }
  /// A character from the chip, the first edge at `at`.
  void say(Tick at, unsigned value, Tick bit = 26 * 250) {
    const unsigned parity = std::bitset<8>(value).count() % 2;
    bool level = true;
    for (unsigned i = 0; i < 11; ++i) {
      const bool next = ((value << 1U | parity << 9U | 1U << 10U) >> i & 1U) != 0;
      run_until(at + i * bit - 1);
      if (next != level) host.on_txd(at + i * bit, next);
      level = next;
    }
    run_until(at + 11 * bit);
  }
  int cell(int address) { return memory.cells[address].empty() ? -1 : memory.cells[address].back(); }

  static constexpr Tick kStart = 1234;
  Memory memory;
  SerialBus host{memory};
  std::vector<std::pair<Tick, bool>> resets;
  std::unique_ptr<arm::Board> board;
  std::vector<std::string> misuses;
};

/// The sixteen edges of a byte lie `half` cycles of HCLK apart, XSS round them.
void expect_a_byte(SerialBus& host, Tick half) {
  const auto& sck = host.changes[Pin::kSck];
  ASSERT_EQ(sck.size(), 16U);
  for (std::size_t i = 0; i < sck.size(); ++i) {
    EXPECT_EQ(sck[i].level, i % 2 == 0);
    EXPECT_NEAR(static_cast<double>(sck[i].at - sck[0].at), static_cast<double>(cycles(half * static_cast<Tick>(i))),
                1);
  }
  const auto& xss = host.changes[Pin::kXss];
  ASSERT_EQ(xss.size(), 2U);
  EXPECT_LT(xss[0].at, sck.front().at - 600);  // SP2: 50 ns
  EXPECT_GT(xss[1].at, sck.back().at + 600);
}

TEST_F(BoardSerial, Spi1MovesThePinsOfCard1AtItsTicks) {
  host.answer = 0xC5;
  start(kSpi1);
  run();
  expect_a_byte(host, 4);
  EXPECT_EQ(cell(0), 0xC5);
  // 1001 1010, the first bit half a bit before the first rise
  EXPECT_EQ(host.levels(Pin::kMosi), (std::vector<bool>{true, false, true, false, true, false}));
  EXPECT_NEAR(static_cast<double>(host.changes[Pin::kSck][0].at - host.changes[Pin::kMosi][0].at),
              static_cast<double>(cycles(4)), 1);
}

/// No other agent is due until `end`.
class Lonely : public user_cpu::Others {
 public:
  explicit Lonely(Tick end) : end_(end) {}
  Tick quiet_until() override { return end_ + 1; }
  bool go_on(Tick tick) override { return tick <= end_; }

 private:
  Tick end_;
};

TEST_F(BoardSerial, EdgesAreAtTheSameTicksWhenTheProcessorIsAloneOnTheBench) {
  for (const Program program : {kSpi1, kUart, kBusy}) {
    const auto changes = [&](user_cpu::Others* others) {
      host.changes.clear();
      memory.cells.clear();
      start(program);
      board->set_others(others);
      run();
      std::vector<std::tuple<Pin, Tick, bool>> all;
      for (const auto& [pin, list] : host.changes)
        for (const auto& each : list) all.emplace_back(pin, each.at, each.level);
      board.reset();
      host.restart();
      return std::pair(all, memory.cells);
    };
    const auto among_others = changes(nullptr);
    Lonely lonely(kStart + bus::kTicksPerMs);
    EXPECT_EQ(changes(&lonely), among_others);
    EXPECT_GT(among_others.first.size(), 4U);
    EXPECT_FALSE(among_others.second.empty());
  }
}

TEST_F(BoardSerial, Spi2OfCard2HasPclk1) {
  host.answer = 0x5C;
  start(kSpi2, 2);
  run();
  expect_a_byte(host, 8);
  EXPECT_EQ(cell(0), 0x5C);
}

TEST_F(BoardSerial, TheOtherCardsSpiMovesNothingAndHearsOnes) {
  start(kSpi2, 1);
  host.answer = 0;
  run();
  EXPECT_THAT(host.changes[Pin::kSck], IsEmpty());
  EXPECT_EQ(cell(0), 0xFF);
}

TEST_F(BoardSerial, ChipWithoutSerialPinsHasNoneMoved) {
  start(kSpi1, 1, false);
  run();
  EXPECT_TRUE(host.changes.empty());
  EXPECT_EQ(cell(0), 0xFF);
}

TEST_F(BoardSerial, RemappedSpiHasLeftThePinsOfTheCard) {
  start(kRemapped);
  run();
  EXPECT_THAT(host.changes[Pin::kSck], IsEmpty());
}

TEST_F(BoardSerial, FirmwareThatFetchesTooLateFindsOvrAndTheFirstByte) {
  host.answer = 0x11;
  start(kOverrun);
  run();
  EXPECT_EQ(cell(0), 0x43);  // OVR, TXE, RXNE
  EXPECT_EQ(cell(1), 0x11);
  EXPECT_EQ(cell(2), 0x42);
  EXPECT_EQ(cell(3), 0x02);
  EXPECT_THAT(board->board()->notes,
              ElementsAre("SPI1: 2 bytes were lost, since those before them had not been fetched (OVR)"));
}

/// Between two tests for interrupts: the byte has gone to the shift register before the next instruction.
TEST_F(BoardSerial, RegistersAreWhatTheyAreAtTheInstruction) {
  start(kQuick);
  run();
  EXPECT_EQ(host.changes[Pin::kSck].size(), 9 * 16U);
  EXPECT_EQ(cell(0), 0x82 | 0x41);  // BSY, TXE; OVR and RXNE of those before
}

TEST_F(BoardSerial, RxneInterruptsASleepingProcessor) {
  host.answer = 0x77;
  start(kSpiByInterrupt);
  run();
  EXPECT_THAT(memory.cells[0], ElementsAre(0x77));
  EXPECT_THAT(memory.cells[8], ElementsAre(1));
}

TEST_F(BoardSerial, Usart2SendsOnRxdAndInterruptsWithWhatTxdSays) {
  start(kUart);
  run_until(kStart + 200 * bus::kTicksPerUs);
  const auto& rxd = host.changes[Pin::kRxd];
  const unsigned frame = 0x31U << 1U | 1U << 9U | 1U << 10U;
  std::vector<Tick> expected;
  for (unsigned i = 0, level = 1; i < 11; ++i)
    if ((frame >> i & 1U) != level) {
      level ^= 1U;
      expected.push_back(i);
    }
  ASSERT_EQ(rxd.size(), expected.size());
  for (std::size_t i = 0; i < rxd.size(); ++i)  // BRR 20, PCLK1 half of HCLK
    EXPECT_NEAR(static_cast<double>(rxd[i].at - rxd[0].at), static_cast<double>(cycles(40 * expected[i])), 1);
  EXPECT_EQ(cell(4), 0xC);  // RTS low, TX high, RX high
  EXPECT_EQ(cell(0), -1);
  const Tick begin = kStart + 300 * bus::kTicksPerUs;
  say(begin, 0xA6);
  run();
  EXPECT_THAT(memory.cells[0], ElementsAre(0xF0 & ~0x10));  // TXE, TC, RXNE
  EXPECT_THAT(memory.cells[1], ElementsAre(0xA6));
  EXPECT_EQ(cell(5), 0xE);  // RTS high while the character waited
  EXPECT_THAT(memory.cells[8], ElementsAre(1));
}

/// Sends a character on TXD, as a chip does in its turns.
class Talker : public bus::Agent {
 public:
  Talker(SerialBus& host, Tick begin, unsigned bits) : host_(host), at_(begin), bits_(bits) {}
  Tick next() const override { return left_ == 0 ? bus::kNever : at_; }
  void run(Tick now) override {
    if (const bool level = (bits_ & 1U) != 0; level != level_) host_.on_txd(now, level_ = level);
    bits_ >>= 1U;
    --left_;
    at_ += Tick{26} * 250;
  }

 private:
  SerialBus& host_;
  Tick at_;
  unsigned bits_, left_ = 11;
  bool level_ = true;
};

TEST_F(BoardSerial, CharacterThatMeetsASleepingProcessorMovesWhatItHasAnnounced) {
  start(kUart);
  Talker chip(host, kStart + 300 * bus::kTicksPerUs, 0xA6U << 1U | 1U << 10U);
  bus::Timeline timeline;
  timeline.add(chip);
  timeline.add(*board);
  timeline.check_announcements();
  timeline.run_until(kStart + bus::kTicksPerMs);
  EXPECT_THAT(memory.cells[1], ElementsAre(0xA6));
}

TEST_F(BoardSerial, FirmwareThatFetchesTooLateFindsOreAndTheFirstCharacter) {
  start(kUartOverrun);
  run_until(kStart + 50 * bus::kTicksPerUs);
  say(kStart + 100 * bus::kTicksPerUs, 0x21);
  say(kStart + 110 * bus::kTicksPerUs, 0x22);
  run();
  EXPECT_EQ(cell(0), 0xE8);  // TXE, TC, RXNE, ORE
  EXPECT_EQ(cell(1), 0x21);
  EXPECT_EQ(cell(2) & 0x28, 0);
  EXPECT_THAT(board->board()->notes,
              ElementsAre("USART2: 1 bytes were lost, since those before them had not been fetched (ORE)"));
}

TEST_F(BoardSerial, OutputThatExtiHearsIsAnEventOnItsChosenEdge) {
  start(kOwnEvent);
  run();
  EXPECT_EQ(cell(0), 0x20);  // pending, though IMR masks it
  EXPECT_EQ(cell(1), 1);
  EXPECT_EQ(cell(2), -1);
}

TEST_F(BoardSerial, Card2HasResetAndIntr0OfItsOwn) {
  start(kCard2, 2);
  const Tick fall = kStart + 500 * bus::kTicksPerUs;
  run_until(fall - 1);
  ASSERT_EQ(resets.size(), 2U);
  EXPECT_FALSE(resets[0].second);
  EXPECT_EQ(cell(0), 1);
  EXPECT_EQ(cell(1), -1);
  board->interrupt_changed(fall, false);
  run();
  EXPECT_EQ(cell(1), 0);
}

TEST_F(BoardSerial, OutputsMoveSpiByHand) {
  host.answer = 0x40;
  start(kByHand);
  run();
  EXPECT_EQ(host.levels(Pin::kXss), (std::vector<bool>{false, true}));
  EXPECT_EQ(host.levels(Pin::kSck), (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(host.levels(Pin::kMosi), (std::vector<bool>{true, false}));
  EXPECT_EQ(cell(0), 1);  // MISO after one rise, after two
  EXPECT_EQ(cell(1), 0);
}

TEST_F(BoardSerial, APortThatSendsWithoutItsPinsIsTold) {
  start(kRemapped, 1, true, HostMode::kSpi);
  run();
  EXPECT_THAT(misuses, ElementsAre(testing::MatchesRegex("SPI1 sends while PA5 \\(SCK\\) is not its pin, in frame at "
                                                         "serial.c:[0-9]+")));
  host.restart();
  start(kUnsetUart, 1, true, HostMode::kUart);
  run();
  EXPECT_THAT(misuses.back(), testing::StartsWith("USART2 sends while PA2 (TX) is not its pin, in unset_uart at"));
  misuses.clear();
  host.restart();
  start(kSpi1, 1, true, HostMode::kSpi);
  run();
  EXPECT_THAT(misuses, IsEmpty());
}

TEST_F(BoardSerial, BytesThatAreLostAtThePortInUseAreTold) {
  start(kOverrun, 1, true, HostMode::kSpi);
  run();
  EXPECT_THAT(misuses, ElementsAre("2 bytes for SPI are lost before DR is read (OVR), in overrun at serial.c:97"));
  misuses.clear();
  host.restart();
  start(kUartOverrun, 1, true, HostMode::kUart);
  run_until(kStart + 50 * bus::kTicksPerUs);
  say(kStart + 100 * bus::kTicksPerUs, 0x21);
  say(kStart + 110 * bus::kTicksPerUs, 0x22);
  run();
  EXPECT_THAT(misuses, ElementsAre("1 characters for USART2 are lost before DR is read (ORE), in uart_overrun at "
                                   "serial.c:134"));
}

TEST_F(BoardSerial, ClocksOffAndFunctionsThatAreMissingAreListed) {
  start(kMisused);
  run();
  EXPECT_EQ(cell(0), 0);  // RCC has reset it
  EXPECT_EQ(cell(1), 0x54);
  EXPECT_THAT(misuses, ElementsAre(HasSubstr("SPI1 is used while its clock is off in RCC_APB2ENR")));
  EXPECT_THAT(board->board()->notes, ElementsAre(HasSubstr("SPI1_CR1.RXONLY is set to 1, which the board does not"),
                                                 HasSubstr("USART2_CR3.HDSEL is set to 1, which the board does not")));
}

}  // namespace
}  // namespace dsdpv1
