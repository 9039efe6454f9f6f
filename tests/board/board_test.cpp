// The board's peripherals and wiring, observed at the pins: the actions are in tests/board/firmware/probe.c, the test
// checks the host bus.
#include "kinds/board/board.hpp"
#include "kinds/dsdpv1/board/mailbox_link.hpp"
#include "kinds/dsdpv1/board/wiring.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "kinds/dsdpv1/chip/core_device.hpp"
#include "kinds/dsdpv1/chip/dsdpv1_pin_chip.hpp"
#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"
#include "tests/kinds/quiet_device.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr Tick kHclk3 = 500;  // three periods of 72 MHz

enum Program {
  kHandshake,
  kAccesses,
  kUnsetAccesses,
  kInterrupt,
  kChipReset,
  kText,
  kStrange,
  kUndefined,
  kBankOff,
  kMaskedAndRising,
  kInputs,
  kClockTree,
  kNonsense,
  kLacking,
  kRegisters,
  kClocksOff,
  kBusy,
  kDivided,
  kRestarted,
  kWideBus,
  kMultiplexed,
  kFloatingBus,
  kWrongPins,
  kOutside,
  kBank2,
  kTimer,
  kTimerWhileBusy,
  kIrqStorm,
  kWatchdog,
  kWatchdogAsleep,
  kStuck,
  kAsks,
  kCallAstray,
  kSleeps,
  kByteStores,
  kFloats,
  kNwait
};

/// Pins of a chip that answers every read with the low byte of its address.
class Pins : public QuietDevice {
 public:
  struct Change {
    Tick at;
    Pin pin;
    Level level;
  };
  void set(Tick at, tb::PinNumber moved, Level level) override {
    const Pin pin = static_cast<Pin>(moved);
    changes.push_back({at, pin, level});
    if (pin == Pin::kA) address_ = level;
    if (pin == Pin::kDIn) data_ = level;
    if (pin == Pin::kWr && level == 1) written.emplace_back(address_, data_);
  }
  Level level(tb::PinNumber of) const override {
    const Pin pin = static_cast<Pin>(of);
    if (pin == Pin::kLReq) return l_req;
    if (pin == Pin::kLSta) return l_sta;
    if (pin == Pin::kPbf || pin == Pin::kReady) return 1;
    return static_cast<Level>(pin == Pin::kDOut ? address_ & 0xFF : 0);
  }
  Level sample(Tick) override { return level(number(Pin::kDOut)); }
  std::vector<Change> of(Pin pin) const {
    std::vector<Change> found;
    for (const Change& each : changes)
      if (each.pin == pin) found.push_back(each);
    return found;
  }

  Level l_req = 0, l_sta = 0;
  std::vector<Change> changes;
  std::vector<std::pair<int, int>> written;  ///< address and data of each write

 private:
  Level address_ = 0, data_ = 0;
};

class BoardTest : public testing::Test {
 protected:
  static user_cpu::FsmcOverride at_72_mhz() {
    user_cpu::FsmcOverride fsmc;
    fsmc.hclk_mhz = 72;
    return fsmc;
  }
  void start(Program program, const user_cpu::FsmcOverride& fsmc = at_72_mhz(), const arm::Switches& switches = {},
             std::optional<std::uint32_t> mailbox = {}) {
    arm::BoardOptions options;
    options.firmware = with(program, mailbox);
    options.wiring = tb::dsdpv1_wiring();
    options.make_mailbox = [](std::uint8_t* memory) {
      return std::make_unique<arm::MailboxLink>(memory, user_cpu::ProgramOptions());
    };
    options.fsmc = fsmc;
    options.switches = switches;
    board = std::make_unique<arm::Board>(
        host, std::move(options), [this](Tick at, bool level) { resets.emplace_back(at, level); }, kStart);
    board->on_text = [this](Tick, const std::string& line) { lines.push_back(line); };
    board->on_error = [this](const user_cpu::ProgramError& error) {
      EXPECT_GE(error.at, kStart);
      codes.push_back(error.code);
      misuses.push_back(
          fmt::format("{}, in {} at {}:{}", error.text, error.where->function, error.where->file, error.where->line));
    };
    board->on_failure = [this](Tick at, const std::string& why, const std::string& table) {
      failure = {why, table};
      failed_in = board->where(user_cpu::Act::done(at))->function;
      ++failures;
    };
  }
  static std::shared_ptr<const arm::Firmware> with(Program program, std::optional<std::uint32_t> mailbox = {}) {
    auto firmware = std::make_shared<arm::Firmware>(*arm::load_firmware(PROBE));
    firmware->mailbox = mailbox;
    const std::uint32_t word = firmware->image.symbols.at("program").address;
    for (arm::Segment& segment : firmware->image.segments)
      if (word >= segment.address && word < segment.address + segment.bytes.size())
        segment.bytes[word - segment.address] = static_cast<std::uint8_t>(program);
    return firmware;
  }
  void run_until(Tick end) {
    while (board->next() <= end) board->run(board->next());
  }
  void run() { run_until(kStart + bus::kTicksPerMs); }

  static constexpr Tick kStart = 1234;
  Pins pins;
  user_cpu::PinHostBus host{pins};
  std::vector<std::pair<Tick, bool>> resets;
  std::vector<std::string> lines;
  std::pair<std::string, std::string> failure;
  std::string failed_in;
  std::vector<std::string> codes, misuses;  ///< of what a real board would not forgive
  int failures = 0;
  std::unique_ptr<arm::Board> board;
};

std::vector<Level> levels(const std::vector<Pins::Change>& changes) {
  std::vector<Level> list;
  list.reserve(changes.size());
  for (const Pins::Change& each : changes) list.push_back(each.level);
  return list;
}

TEST_F(BoardTest, PortCIsTheHandshake) {
  pins.l_req = 1;
  start(kHandshake);
  run();
  EXPECT_THAT(levels(pins.of(Pin::kRReq)), ElementsAre(1, 0, 1, 0));
  EXPECT_THAT(levels(pins.of(Pin::kRSta)), ElementsAre(1, 0, 1, 0));
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 1)));  // PC8 high, PC9 low
  EXPECT_LT(pins.of(Pin::kRReq).at(0).at, pins.of(Pin::kRSta).at(0).at);
  EXPECT_EQ(board->counters().port.holds, 2U);
}

TEST_F(BoardTest, NonsenseInTheMailboxIsAFaultOfTheFirmware) {
  start(kNonsense, at_72_mhz(), {}, 0x20008000);
  board->on_error = [](const user_cpu::ProgramError&) { ADD_FAILURE() << "no error of the driver"; };
  run();
  EXPECT_EQ(
      failure.first,
      "the firmware has written nonsense into its mailbox (dsdpv1_bench): report.errors[0].error is 200, expected "
      "the failures of dsdpv1_error");
  EXPECT_EQ(failed_in, "nonsense");
  EXPECT_THAT(failure.second, HasSubstr("xpsr"));
  EXPECT_EQ(failures, 1);
}

TEST_F(BoardTest, BothPinsOfOneStoreMoveAtOneTick) {
  start(kHandshake);
  run();
  EXPECT_EQ(pins.of(Pin::kRReq).at(1).at, pins.of(Pin::kRSta).at(1).at);  // ODR = 0
  EXPECT_EQ(pins.of(Pin::kRReq).at(2).at, pins.of(Pin::kRSta).at(2).at);
}

TEST_F(BoardTest, FloatingRStaIsLowByThePullDown) {
  start(kFloats);
  run();
  EXPECT_THAT(levels(pins.of(Pin::kRSta)), ElementsAre(1, 0));
}

/// A cell that the program has not written: the place is the last fall of R_STA or R_REQ, and not what followed.
TEST_F(BoardTest, RuleOfAHoldIsAtItsRelease) {
  start(kHandshake);
  run();
  const auto line_of = [this](const user_cpu::Act& act) { return board->where(act)->line; };
  const auto r_req = pins.of(Pin::kRReq), r_sta = pins.of(Pin::kRSta);
  for (const auto& [until, release] :
       {std::pair(r_req.at(2), r_req.at(1)), std::pair(r_sta.at(3), r_sta.at(3)), std::pair(r_req.at(3), r_req.at(3))})
    EXPECT_EQ(line_of(user_cpu::Act::written(0x7FF, until.at)), line_of(user_cpu::Act::done(release.at)));
}

TEST_F(BoardTest, ByteStoredToARegisterLeavesTheRest) {
  start(kByteStores);
  run();
  EXPECT_THAT(pins.written,
              ElementsAre(std::pair(0, 0x11), std::pair(1, 0xA5), std::pair(2, 0x11), std::pair(3, 0x22)));
}

TEST_F(BoardTest, BtrOfTheFirmwareMovesTheEdges) {
  start(kAccesses);
  run();
  const auto rd = pins.of(Pin::kRd), wr = pins.of(Pin::kWr), csr = pins.of(Pin::kCsr);
  // Read, mode 1: RD falls with CSR, low for ADDSET + 1 + DATAST + 1 + 2 = 14.
  EXPECT_EQ(csr.at(0).at, rd.at(0).at);
  EXPECT_NEAR(static_cast<double>(rd.at(1).at - rd.at(0).at), 14 * kHclk3 / 3.0, 1);
  // Write: WR falls ADDSET + 1 = 4 after CSR, low for DATAST = 7, CSR rises one later.
  EXPECT_NEAR(static_cast<double>(wr.at(0).at - csr.at(2).at), 4 * kHclk3 / 3.0, 1);
  EXPECT_NEAR(static_cast<double>(wr.at(1).at - wr.at(0).at), 7 * kHclk3 / 3.0, 1);
  EXPECT_NEAR(static_cast<double>(csr.at(3).at - wr.at(1).at), 1 * kHclk3 / 3.0, 1);
}

TEST_F(BoardTest, ModeAHasATimingOfItsOwnForWrites) {
  start(kAccesses);
  run();
  const auto rd = pins.of(Pin::kRd), wr = pins.of(Pin::kWr), csr = pins.of(Pin::kCsr);
  EXPECT_NEAR(static_cast<double>(rd.at(2).at - csr.at(4).at), 4 * kHclk3 / 3.0, 1);  // RD falls ADDSET + 1 after CSR
  EXPECT_NEAR(static_cast<double>(wr.at(3).at - wr.at(2).at), 2 * kHclk3 / 3.0, 1);   // BWTR: DATAST = 2
}

TEST_F(BoardTest, HalfwordIsTwoBytesTheLowerAddressFirstAndTheDpramRepeats) {
  start(kAccesses);
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0x123, 0x56), std::pair(0x10, 0xFE), std::pair(0x11, 0xFF)));
}

/// Notes for each access what the FSMC does about NWAIT: 0 nothing, 1 it waits while it is high, -1 while it is low.
struct Waits : user_cpu::PinHostBus {
  using PinHostBus::PinHostBus;
  void set_wait(const user_cpu::WaitTiming& timing) override { wait = timing; }
  void begin(Tick at, const user_cpu::Access& access, const AccessTiming& timing) override {
    seen.push_back(!wait.on ? 0 : wait.while_high ? 1 : -1);
    EXPECT_EQ(wait.hclk_hz, 72'000'000);
    PinHostBus::begin(at, access, timing);
  }
  user_cpu::WaitTiming wait;
  std::vector<int> seen;
};

/// The waits of the program's four accesses, and its notes.
std::pair<std::vector<int>, std::vector<std::string>> waits_of(Pins& pins, arm::BoardOptions options, bool wired) {
  options.wiring.wait = wired;
  Waits host(pins);
  arm::Board board(
      host, std::move(options), [](Tick, bool) {}, 0);
  while (board.next() <= bus::kTicksPerMs) board.run(board.next());
  return {host.seen, board.board()->notes};
}

TEST_F(BoardTest, AnAccessWaitsForNwaitIfItIsConnectedAndItsDataPhaseHasTheTime) {
  arm::BoardOptions options;
  options.firmware = with(kNwait);
  options.wiring = tb::dsdpv1_wiring();
  options.fsmc = at_72_mhz();
  const auto [wired, nothing] = waits_of(pins, options, true);
  EXPECT_THAT(wired, ElementsAre(1, 0, 0, -1));
  EXPECT_THAT(nothing, testing::IsEmpty());
  const auto [unwired, notes] = waits_of(pins, options, false);
  EXPECT_THAT(unwired, ElementsAre(0, 0, 0, 0));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("FSMC_BCR1.ASYNCWAIT is set to 1"));
}

TEST_F(BoardTest, ResetIsPulledToItsInactiveLevelOfEitherPolarity) {
  for (const bool high : {false, true}) {
    arm::BoardOptions options;
    options.firmware = with(kChipReset);
    options.wiring = tb::dsdpv1_wiring();
    options.wiring.reset_high = high;
    std::vector<bool> released;
    arm::Board moved(
        host, std::move(options), [&released](Tick, bool level) { released.push_back(level); }, kStart);
    while (moved.next() <= kStart + bus::kTicksPerMs) moved.run(moved.next());
    EXPECT_EQ(released, high ? std::vector<bool>({false}) : std::vector<bool>({false, true}));  // low, then high
  }
}

TEST_F(BoardTest, RegistersNeverWrittenGiveTheDefaultTiming) {
  start(kUnsetAccesses);
  run();
  const auto rd = pins.of(Pin::kRd);
  EXPECT_NEAR(static_cast<double>(rd.at(1).at - rd.at(0).at), (1 + 1 + 5 + 1 + 2) * kHclk3 / 3.0, 1);
}

TEST_F(BoardTest, ScenarioTimingStandsAboveTheFirmwares) {
  user_cpu::FsmcOverride fsmc = at_72_mhz();
  fsmc.datast = 2;
  start(kAccesses, fsmc);
  run();
  const auto wr = pins.of(Pin::kWr);
  EXPECT_NEAR(static_cast<double>(wr.at(1).at - wr.at(0).at), 2 * kHclk3 / 3.0, 1);
}

TEST_F(BoardTest, Intr0RunsTheHandlerThroughExtiLine6) {
  start(kInterrupt);
  const Tick fall = kStart + 100 * bus::kTicksPerUs;
  run_until(fall - 1);
  EXPECT_TRUE(pins.written.empty());
  board->interrupt_changed(fall, false);
  board->interrupt_changed(fall + 64 * 250, true);
  run();
  EXPECT_THAT(pins.written,
              ElementsAre(std::pair(0x7FF, 0), std::pair(0, 1)));  // the handler, then the main loop; once
  const Tick handler = pins.of(Pin::kCsr).at(0).at;
  EXPECT_GE(handler - fall, 12 * kHclk3 / 3);  // 12 cycles of entry
  EXPECT_LE(handler - fall, 30 * kHclk3 / 3);
}

/// No other agent has a turn until a tick; a chip that runs ahead may have reported an edge before it.
struct QuietUntil : user_cpu::Others {
  explicit QuietUntil(Tick at) : end(at) {}
  Tick quiet_until() override { return end; }
  bool go_on(Tick tick) override { return tick < end; }
  Tick end;
};

TEST_F(BoardTest, Intr0ComesAtItsCycleToABusyProcessorThatNobodyElseStops) {
  QuietUntil others(kStart + 200 * bus::kTicksPerUs);
  start(kBusy);
  board->set_others(&others);
  const Tick fall = kStart + 100 * bus::kTicksPerUs;
  board->interrupt_changed(fall, false);
  run();
  const Tick handler = pins.of(Pin::kCsr).at(0).at;
  EXPECT_GE(handler - fall, 12 * kHclk3 / 3);
  EXPECT_LE(handler - fall, 30 * kHclk3 / 3);
}

struct LookedAt : user_cpu::PinHostBus {
  using PinHostBus::PinHostBus;
  void looked(const user_cpu::Looks& last) override { looks.push_back(last); }
  std::vector<user_cpu::Looks> looks;
};

/// The looks that R_STA's rises follow, its last one by the handler of an INTR0 that falls at `fall`.
std::vector<user_cpu::Looks> looks_of(Pins& pins, arm::BoardOptions options, Tick start, Tick fall) {
  LookedAt host(pins);
  QuietUntil others(start + 200 * bus::kTicksPerUs);
  arm::Board board(
      host, std::move(options), [](Tick, bool) {}, start);
  board.set_others(&others);
  board.interrupt_changed(fall, false);
  while (board.next() <= start + bus::kTicksPerMs / 4) board.run(board.next());
  return host.looks;
}

TEST_F(BoardTest, LookIsALoadOfPc8AndPc9AlsoOneThatAnUnchangedLoopLeavesOut) {
  pins.l_req = 1;
  arm::BoardOptions options;
  options.firmware = with(kAsks);
  options.wiring = tb::dsdpv1_wiring();
  options.fsmc = at_72_mhz();
  for (Tick fall = kStart + 100 * bus::kTicksPerUs, i = 0; i < 30; ++i, fall += 100) {
    options.timing.leaves_out_polls = false;
    const auto all = looks_of(pins, options, kStart, fall);
    options.timing.leaves_out_polls = true;
    const auto some = looks_of(pins, options, kStart, fall);
    ASSERT_EQ(all.size(), 3U);
    ASSERT_EQ(some.size(), 3U);
    EXPECT_LE(all[0].l_req, kStart);
    EXPECT_GT(all[1].l_req, kStart);
    EXPECT_LT(std::abs(all[2].l_req - fall), 2 * bus::kTicksPerUs);
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(all[k].l_req, some[k].l_req) << k << ", INTR0 at " << fall;
      EXPECT_EQ(all[k].l_sta, all[k].l_req);
    }
  }
}

TEST_F(BoardTest, MaskedLineIsPendingOnItsChosenEdgeOnly) {
  start(kMaskedAndRising);
  const Tick fall = kStart + 50 * bus::kTicksPerUs;
  board->interrupt_changed(fall, false);
  run_until(fall + 10 * bus::kTicksPerUs);
  EXPECT_TRUE(pins.written.empty());
  board->interrupt_changed(fall + 20 * bus::kTicksPerUs, true);
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 1), std::pair(1, 0)));  // PG6 high; PR cleared by writing 1
}

TEST_F(BoardTest, PortE4IsTheChipsReset) {
  start(kChipReset);
  run();
  ASSERT_EQ(resets.size(), 2U);
  EXPECT_FALSE(resets[0].second);
  EXPECT_TRUE(resets[1].second);
  EXPECT_GT(resets[1].first - resets[0].first, bus::kTicksPerUs);
  EXPECT_GT(pins.of(Pin::kCsr).at(0).at, resets[1].first);
}

TEST_F(BoardTest, InputsReadTheirPullsTheSwitchesAndTheLamps) {
  arm::Switches switches;
  switches.held[0] = 0xF0;
  switches.levels[0] = 0xE0;  // low against a pull-up, high against a pull-down, on a floating and on an analog input
  start(kInputs, at_72_mhz(), switches);
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 0x61), std::pair(1, 0b101), std::pair(2, 0x10)));
}

/// From the first to the tenth write of each ten, by period of HCLK.
std::vector<double> write_periods(const std::vector<Pins::Change>& wr) {
  std::vector<Tick> falls;
  for (const Pins::Change& each : wr)
    if (each.level == 0) falls.push_back(each.at);
  falls.erase(falls.begin() + 10);  // from reading SWS
  std::vector<double> periods;
  for (std::size_t i = 0; i + 9 < falls.size(); i += 10)
    periods.push_back(static_cast<double>(falls[i + 9] - falls[i]));
  return periods;
}

TEST_F(BoardTest, HclkFollowsRccFrom8MhzOn) {
  start(kClockTree, {});
  run();
  EXPECT_EQ(pins.written.at(10), std::pair(1, 0));  // the crystal was off: SWS still says HSI
  const std::vector<double> periods = write_periods(pins.of(Pin::kWr));
  ASSERT_EQ(periods.size(), 5U);
  EXPECT_NEAR(periods[0] / periods[1], 8, 0.2);
  EXPECT_NEAR(periods[0] / periods[2], 9, 0.2);
  EXPECT_NEAR(periods[0] / periods[3], 4.5, 0.1);
  EXPECT_GT(periods[4], periods[3] * 1.2) << "flash waits";
  EXPECT_EQ(board->board()->hclk_hz, 36'000'000);
  EXPECT_EQ(board->board()->hclk_source, "PLL, 9 x HSE, divided by 2");
  EXPECT_THAT(
      misuses,
      Contains(HasSubstr(
          "SYSCLK is 64 MHz with 0 wait states of flash (FLASH_ACR.LATENCY), which needs 2, in clock_tree at")));
  EXPECT_THAT(codes, ElementsAre("BOARD_FLASH_LATENCY", "BOARD_CLOCK_FAST"));  // PCLK1
}

TEST_F(BoardTest, FlashWaitsForSysclkWhateverTheAhbDividerMakesOfIt) {
  start(kDivided, {});
  run();
  EXPECT_EQ(board->board()->hclk_hz, 36'000'000);
  EXPECT_THAT(
      misuses,
      ElementsAre(HasSubstr("SYSCLK is 72 MHz with 1 wait states of flash (FLASH_ACR.LATENCY), which needs 2")));
}

TEST_F(BoardTest, AResetByTheFirmwareSwitchesTheTerminalOff) {
  start(kRestarted, {});
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 0)));
}

/// Halts once, at the thirtieth instruction or at an address, and reads the state.
class Looker : public arm::Debugger {
 public:
  Looker(arm::DebugTarget& target, std::function<void(arm::DebugTarget&)> look, std::uint32_t place = 0)
      : target_(target), look_(std::move(look)), place_(place) {}
  bool wanted() const override { return true; }
  void before_instruction(std::uint32_t pc) override {
    if (place_ != 0 ? pc == place_ : ++instructions_ == 30) look_(target_);
  }
  void data_access(std::uint32_t, std::uint32_t, bool) override {}
  void poll() override {}
  void fault(const std::string&) override {}

 private:
  arm::DebugTarget& target_;
  std::function<void(arm::DebugTarget&)> look_;
  std::uint32_t place_;
  int instructions_ = 0;
};

TEST_F(BoardTest, DebuggerLooksAtPeripheralsAndDpramWithoutAnEffect) {
  bus::Segment segment;
  tb::Dsdpv1PinChip chip("chip", std::make_unique<tb::CoreDevice>(dsdpv1::Config()), Part::kDsdpv1, 0, segment);
  chip.poke(0, 0x123, 0xA5);
  arm::BoardOptions options;
  options.firmware = with(kAccesses);
  options.wiring = tb::dsdpv1_wiring();
  options.fsmc = at_72_mhz();
  Tick asked_at = -1;
  options.chip = [&](Tick now) -> const tb::ChipView& {
    asked_at = now;
    return chip;
  };
  std::size_t looks = 0;
  const auto look = [&](arm::DebugTarget& target) {
    const Tick before = target.now();
    const std::size_t changes = pins.changes.size();
    for (const std::uint32_t address : {0x60000123U, 0x6000'0923U, 0x40021018U, 0x40011008U, 0x40012008U, 0x40010414U,
                                        0x40013804U, 0x40001024U, 0xA0000000U}) {
      std::uint8_t byte = 0;
      looks += target.read_memory(address, &byte, 1);
      EXPECT_TRUE(byte == 0xA5 || address >> 28U != 6U);
    }
    std::uint8_t byte = 0;
    EXPECT_EQ(target.read_memory(0x5000'0000, &byte, 1), 0U);
    EXPECT_EQ(target.now(), before);
    EXPECT_EQ(pins.changes.size(), changes);
    EXPECT_GT(asked_at, kStart);
    EXPECT_LE(asked_at, before);
  };
  options.make_debugger = [&](arm::DebugTarget& target) { return std::make_unique<Looker>(target, look); };
  board = std::make_unique<arm::Board>(
      host, std::move(options), [](Tick, bool) {}, kStart);
  run();
  EXPECT_EQ(looks, 9U);
  const auto changes = pins.changes;
  EXPECT_TRUE(board->board()->notes.empty());  // TIM6 was read, not used
  pins.changes.clear();
  start(kAccesses);
  run();
  ASSERT_EQ(changes.size(), pins.changes.size());
  for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_EQ(changes[i].at, pins.changes[i].at);
}

TEST_F(BoardTest, DebuggerSeesInEachRegisterWhatTheFirmwareReads) {
  arm::BoardOptions options;
  options.firmware = with(kRegisters);
  options.wiring = tb::dsdpv1_wiring();
  std::vector<int> seen;
  std::size_t lamps = 0;  // of the chip, which this debugger cannot see
  const auto look = [&](arm::DebugTarget& target) {
    for (const std::uint32_t base : {0x40010000U, 0x40010400U, 0x40010800U, 0x40010C00U, 0x40011000U, 0x40011400U,
                                     0x40011800U, 0x40011C00U, 0x40012000U, 0x40013000U, 0x40003800U, 0x40004400U,
                                     0x40013800U, 0x40021000U, 0x40022000U, 0xA0000000U, 0xA0000100U})
      for (std::uint32_t offset = 0; offset < 0x40; offset += 4) {
        std::array<std::uint8_t, 4> bytes{};
        EXPECT_EQ(target.read_memory(base + offset, bytes.data(), 4), 4U);
        if (base + offset == 0x4001'2008) lamps = seen.size();
        seen.insert(seen.end(), bytes.begin(), bytes.end());
      }
  };
  const std::uint32_t place = options.firmware->image.symbols.at("all_registers").address & ~1U;
  options.make_debugger = [&](arm::DebugTarget& target) { return std::make_unique<Looker>(target, look, place); };
  board = std::make_unique<arm::Board>(
      host, std::move(options), [](Tick, bool) {}, kStart);
  run_until(kStart + 10 * bus::kTicksPerMs);
  ASSERT_EQ(pins.written.size(), seen.size());
  seen.at(lamps + 1) |= pins.written.at(lamps + 1).second & 0x70;
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], pins.written[i].second) << i;
}

TEST_F(BoardTest, HclkOfTheScenarioStandsAboveRcc) {
  start(kClockTree);
  run();
  std::vector<double> periods = write_periods(pins.of(Pin::kWr));
  periods.pop_back();  // with the wait states of flash
  for (const double period : periods) EXPECT_NEAR(period / periods[0], 1, 0.05);
  EXPECT_EQ(board->board()->hclk_hz, 72'000'000);
  EXPECT_EQ(board->board()->hclk_source, "fsmc.hclk of the scenario");
}

TEST_F(BoardTest, UsartPrintsLinesAndRccIsReadyAtOnce) {
  start(kText);
  run();
  EXPECT_THAT(lines, ElementsAre("ready"));
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 1)));
  EXPECT_THAT(board->board()->notes, ElementsAre("USART1, a line without end: half a li"));
}

TEST_F(BoardTest, OtherPeripheralsKeepWhatIsWrittenAndAreListed) {
  start(kStrange);
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 77), std::pair(1, 0), std::pair(2, 0)));
  EXPECT_THAT(board->board()->notes,
              ElementsAre(testing::AllOf(HasSubstr("TIM6 is not on the board: 2 reads and 1 writes"),
                                         HasSubstr("strange at probe.c"))));
  EXPECT_THAT(codes, ElementsAre("BOARD_CLOCK_OFF"));
}

TEST_F(BoardTest, FieldsAndRegistersThatTheBoardDoesNotHaveAreListedOnceWithTheirLine) {
  start(kLacking);
  run();
  const int last = pins.written.at(0).second | pins.written.at(1).second << 8;
  const auto lacks = [last](const std::string& what, int before) {
    return testing::AllOf(testing::StartsWith(what), testing::EndsWith("probe.c:" + std::to_string(last - before)));
  };
  EXPECT_THAT(board->board()->notes,
              ElementsAre(lacks("AFIO_MAPR.USART1_REMAP is set to 1, which the board does not have, first in", 12),
                          lacks("EXTI_IMR.MR[18:16] is set to 2,", 11), lacks("GPIOB_LCKR.LCKK is set to 1,", 10),
                          lacks("SPI1_CR2.TXDMAEN is set to 1,", 9), lacks("SPI1_CR2.RXDMAEN is set to 1,", 8),
                          lacks("SPI2_CR1.MSTR is set to 0,", 7), lacks("USART1_CR1.RE is set to 1,", 6),
                          lacks("USART2_CR3.CTSE is set to 1,", 5), lacks("RCC_CR.HSITRIM is set to 0,", 4),
                          lacks("RCC has no register at 0x40021028 on the board, first in", 3),
                          lacks("FLASH_ACR.HLFCYA is set to 1,", 2), lacks("FSMC_BCR1.MTYP is set to 1,", 1)));
}

TEST_F(BoardTest, PeripheralsWithoutTheirClockReadZeroAndTheFsmcDoesNotAnswer) {
  start(kClocksOff);
  run();
  std::vector<std::string> expected, names;
  for (const char* name : {"AFIO", "GPIOA", "GPIOB", "GPIOC", "GPIOD", "GPIOE", "GPIOF", "GPIOG", "SPI1", "USART1",
                           "SPI2", "USART2", "FSMC", "FSMC"})
    expected.emplace_back(name);
  for (const std::string& misuse : misuses) names.push_back(misuse.substr(0, misuse.find(' ')));
  EXPECT_EQ(names, expected);
  EXPECT_EQ(codes, std::vector<std::string>(14, "BOARD_CLOCK_OFF"));
  EXPECT_THAT(misuses.at(1), testing::MatchesRegex("GPIOA is used while its clock is off in RCC_APB2ENR, in clocks_off "
                                                   "at probe.c:[0-9]+"));
  EXPECT_EQ(failed_in, "clocks_off");
  ASSERT_EQ(pins.written.size(), 14U);
  for (const auto& [cell, value] : pins.written) EXPECT_EQ(value, 0) << cell;  // CRL after a reset: 44444444
}

TEST_F(BoardTest, ABusOf16BitsHalvesAddressesAndHasNoOddBytes) {
  start(kWideBus);
  run();
  EXPECT_THAT(pins.written,
              ElementsAre(std::pair(0x10, 0x23), std::pair(0x10, 0), std::pair(0x18, 0x28), std::pair(0x19, 0x29)));
  EXPECT_EQ(codes, std::vector<std::string>(6, "BOARD_FSMC_MODE"));
  EXPECT_THAT(misuses.at(0), HasSubstr("the chip is accessed with FSMC_BCR1.MWID = 1, in wide_bus at probe.c:"));
}

TEST_F(BoardTest, AMultiplexedBusHasNoAddressForTheChip) {
  start(kMultiplexed);
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 0)));
  EXPECT_EQ(codes, std::vector<std::string>(2, "BOARD_FSMC_MODE"));
}

TEST_F(BoardTest, LinesOfTheBusThatFloatCarryNothing) {
  start(kFloatingBus);
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0x25, 0x44), std::pair(0x25, 0)));  // 4C without D3
  EXPECT_EQ(codes, std::vector<std::string>(5, "BOARD_PIN_MODE"));
  EXPECT_THAT(misuses.at(0), HasSubstr("while pins are not set up for it: PF1 (A1), PD1 (D3), in floating_bus at"));
  EXPECT_THAT(misuses.at(2), HasSubstr("for it: PD4 (NOE), PF1 (A1), in"));
  EXPECT_THAT(misuses.at(4), HasSubstr("for it: PD7 (NE1), PF1 (A1), in"));
}

TEST(MemoryBus, NamesThePinsThatAreWrongForThePortInUse) {
  constexpr std::uint32_t kLow = 0x00, kHigh = 0x04;
  std::array<arm::Gpio, 7> ports;
  for (const unsigned port : {3U, 4U, 5U, 6U})
    for (const std::uint32_t half : {kLow, kHigh}) ports.at(port).write(half, 0xBBBB'BBBB);
  const arm::Fsmc fsmc({});  // as after a reset
  EXPECT_EQ(arm::memory_bus(ports, fsmc, false, false).wrong_pins, "");
  EXPECT_EQ(arm::memory_bus(ports, fsmc, true, false).wrong_pins, "PC6 (R_REQ), PC7 (R_STA)");
  ports.at(2).write(kLow, 0x3344'4444);
  ports.at(2).write(kHigh, 0x4444'4404);  // PC9 is analog
  EXPECT_EQ(arm::memory_bus(ports, fsmc, true, false).wrong_pins, "PC9 (L_STA)");
  for (const std::uint32_t mode : {0xBU, 0x3U, 0x0U})  // alternate function, output, analog
    EXPECT_EQ(
        (ports.at(3).write(kLow, 0xB0BB'BBBB | mode << 24U), arm::memory_bus(ports, fsmc, false, true).wrong_pins),
        "PD6 (NWAIT)");
  for (const std::uint32_t mode : {0x4U, 0x8U})
    EXPECT_EQ(
        (ports.at(3).write(kLow, 0xB0BB'BBBB | mode << 24U), arm::memory_bus(ports, fsmc, false, true).wrong_pins), "");
  ports.at(3).write(kLow, 0xFBBB'BBBB);  // NE1 is open drain
  const arm::MemoryBus bus = arm::memory_bus(ports, fsmc, false, false);
  EXPECT_EQ(bus.wrong_pins, "PD7 (NE1)");
  EXPECT_FALSE(bus.reads || bus.writes);
  EXPECT_TRUE(bus.wide && bus.multiplexed);
}

TEST_F(BoardTest, PinsThatAreMovedAreOutputsAndThoseOfTheChipAreNot) {
  start(kWrongPins);
  run();
  EXPECT_THAT(misuses,
              ElementsAre(HasSubstr("PC6 (R_REQ) is set or cleared while it is not an output, in wrong_pins at"),
                          HasSubstr("PC6 (R_REQ) is set while it is open drain: it stays low"),
                          HasSubstr("PE4 (RESET) is set or cleared while it is not an output"),
                          HasSubstr("PC8 is an output, and the chip drives L_REQ"),
                          HasSubstr("PC9 is an output, and the chip drives L_STA"),
                          HasSubstr("PG6 is an output, and the chip drives INTR0")));
  EXPECT_THAT(codes, ElementsAre("BOARD_PIN_MODE", "BOARD_PIN_MODE", "BOARD_PIN_MODE", "BOARD_PIN_CONFLICT",
                                 "BOARD_PIN_CONFLICT", "BOARD_PIN_CONFLICT"));
  EXPECT_TRUE(pins.of(Pin::kRReq).empty());
}

TEST_F(BoardTest, AnAddressWithoutAnythingIsToldAndMayBeABusFault) {
  start(kOutside);
  run();
  EXPECT_THAT(pins.written, ElementsAre(std::pair(0, 0)));
  EXPECT_THAT(codes, ElementsAre("BOARD_NOT_MAPPED", "BOARD_NOT_MAPPED", "BOARD_NOT_MAPPED"));
  EXPECT_EQ(failed_in, "outside");
  start(kBank2);
  run();
  EXPECT_EQ(failed_in, "bank_2");
}

TEST_F(BoardTest, ATimerAsksForItsInterruptToASleepingAndToABusyProcessor) {
  for (const Program program : {kTimer, kTimerWhileBusy}) {
    pins = Pins();
    start(program);
    run();
    EXPECT_THAT(pins.written,
                ElementsAre(std::pair(0, 1), std::pair(1, 1), std::pair(2, 1), std::pair(3, 8)));  // UG sets UIF; OPM
    const auto wr = pins.of(Pin::kWr);
    const Tick since = wr.at(5).at - wr.at(3).at;  // from before CEN until the handler
    EXPECT_GT(since, 100 * bus::kTicksPerUs);
    EXPECT_LT(since, 101 * bus::kTicksPerUs);
    EXPECT_THAT(misuses, ElementsAre());
  }
}

TEST_F(BoardTest, AHandlerThatLeavesItsFlagIsAStorm) {
  start(kIrqStorm);
  run();
  EXPECT_THAT(codes, ElementsAre("BOARD_IRQ_STORM"));
  EXPECT_THAT(misuses.at(0), testing::StartsWith("the handler of IRQ 28 has returned 100 times, and its source still "
                                                 "asks, in TIM2_handler at probe.c:"));
}

TEST_F(BoardTest, TheWatchdogResetsAProcessorThatDoesNotReloadIt) {
  for (const Program program : {kWatchdog, kWatchdogAsleep}) {
    pins = Pins();
    codes.clear();
    misuses.clear();
    start(program);
    run_until(kStart + 2 * bus::kTicksPerMs);
    EXPECT_THAT(pins.written, ElementsAre(std::pair(1, 0xFF), std::pair(2, 3),
                                          std::pair(0, 0x2C)));  // closed; PVU, RVU; IWDGRSTF, PORRSTF, PINRSTF
    EXPECT_THAT(codes, ElementsAre("BOARD_WATCHDOG"));
    EXPECT_THAT(misuses.at(0), HasSubstr("resets the processor 0.4 ms after its last reload, in watchdog"));
    const auto wr = pins.of(Pin::kWr);
    EXPECT_GT(wr.at(5).at - wr.at(3).at, 500 * bus::kTicksPerUs) << "it was reloaded once";
    EXPECT_LT(wr.at(5).at - wr.at(3).at, 1000 * bus::kTicksPerUs);
  }
}

TEST_F(BoardTest, FaultAfterAJumpOutOfTheProgramIsInTheFunctionThatCalledLast) {
  start(kCallAstray);
  run();
  EXPECT_EQ(failed_in, "call_astray");
}

TEST_F(BoardTest, FirmwareThatOnlyComputesIsStuckAndOneThatSleepsIsNot) {
  start(kStuck);
  run_until(kStart + 250 * bus::kTicksPerMs);
  EXPECT_THAT(codes, ElementsAre("STUCK", "STUCK"));
  EXPECT_THAT(misuses.at(0), testing::StartsWith("100 ms without an access or sleep, in stuck at probe.c:"));
  for (const Program program : {kAccesses, kSleeps}) {
    start(program);
    run_until(kStart + 350 * bus::kTicksPerMs);
    EXPECT_EQ(codes.size(), 2U) << program;
  }
}

// Although the firmware has a handler for it, which writes to the chip.
TEST_F(BoardTest, FaultEndsTheRunWithPlaceAndRegisters) {
  start(kUndefined);
  run();
  EXPECT_EQ(failed_in, "undefined");
  EXPECT_THAT(failure.second, HasSubstr("pc"));
  EXPECT_EQ(board->next(), bus::kNever);
  EXPECT_TRUE(pins.written.empty());
}

TEST_F(BoardTest, BankSwitchedOffIsABusFault) {
  start(kBankOff);
  run();
  EXPECT_EQ(failed_in, "bank_off");
  EXPECT_TRUE(pins.written.empty());
}

TEST_F(BoardTest, EndsInTheMiddleOfAnAccess) {
  start(kUnsetAccesses);
  while (pins.of(Pin::kCsr).empty()) board->run(board->next());
  board.reset();  // the processor's stack is unwound through the emulator
  EXPECT_TRUE(pins.written.empty());
}

}  // namespace
}  // namespace dsdpv1
