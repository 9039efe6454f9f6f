// The mailbox at its pins, with its user and a master, and its two engines compared with each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <regex>
#include <set>

#include "bus/master/master1.hpp"
#include "bus/monitor/monitor.hpp"
#include "tests/mailbox/board.hpp"
#include "tests/mailbox/spi_port.hpp"

namespace dsdpv1::mailbox {
namespace {

using bus::kTicksPerMs;
using bus::kTicksPerUs;
using Bytes = std::vector<std::uint8_t>;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kHalfSck = 600;  // 10 MHz
constexpr Tick kResetUp = 20 * kCycle;
constexpr std::uint8_t kSlave = 5, kMaster = 1;
constexpr std::uint16_t kIdent = 0x0B0C;
const Bytes kStart = {command::kStart, kSlave, kIdent >> 8, kIdent & 0xFF, 0};
const Bytes kRead = {command::kReadOutputs, 0, 0, 0, 0, 0, 0, 0, 0};

Bytes write_frame(const Bytes& inputs) {
  Bytes frame = {command::kWriteInputs};
  frame.insert(frame.end(), inputs.begin(), inputs.end());
  return frame;
}
/// The bytes that MISO shows in a read: zero during the command, then the outputs.
Bytes shown(const Bytes& outputs) {
  Bytes seen = {0};
  seen.insert(seen.end(), outputs.begin(), outputs.end());
  return seen;
}

/// A chip on a segment; the test moves its pins directly.
struct ByHand {
  explicit ByHand(Engine engine = Engine::kSkip) : board(segment, timeline, engine) { timeline.check_announcements(); }

  void run(Tick ticks) { timeline.run_until(timeline.now() + ticks); }
  void set(PinNumber pin, Level level, Tick after = 0) {
    run(after);
    board.set(timeline.now(), pin, level);
  }
  void power_on() {
    set(kit::kReset, 1, kResetUp);
    run(4 * kCycle);
  }
  void select() { set(kXss, 0); }
  /// Sends the first `bits` of `bytes`, then zeros; returns the bits on MISO.
  Bytes clock(const Bytes& bytes, std::size_t bits) {
    Bytes seen((bits + 7) / 8, 0);
    for (std::size_t i = 0; i < bits; ++i) {
      set(kMosi, i / 8 < bytes.size() ? static_cast<Level>(bytes[i / 8] >> (7 - i % 8) & 1) : Level{0});
      set(kSck, 1, kHalfSck);
      seen[i / 8] = static_cast<std::uint8_t>(seen[i / 8] << 1 | (board.level(kMiso) > 0 ? 1 : 0));
      set(kSck, 0, kHalfSck);
    }
    return seen;
  }
  /// XSS rises, and the frame takes effect.
  void deselect() {
    set(kXss, 1, kHalfSck);
    deselected = timeline.now();
    run(3 * kCycle);
  }
  Bytes shift(const Bytes& bytes, std::size_t bits) {
    select();
    Bytes seen = clock(bytes, bits);
    deselect();
    return seen;
  }
  Bytes frame(const Bytes& bytes) { return shift(bytes, bytes.size() * 8); }

  tb::ChipStatus status() const { return board.status(); }
  Level int_level() const { return board.level(kInt); }
  /// The reasons since the last call.
  std::vector<profibus::Reason> said() {
    std::vector<profibus::Reason> reasons;
    for (; told < board.events().size(); ++told) reasons.push_back(board.events()[told].reason);
    return reasons;
  }

  bus::Segment segment;
  bus::Timeline timeline;
  Board board;
  Tick deselected = 0;
  std::size_t told = 0;
};

// --- the pins --------------------------------------------------------------------------------------------------------

struct MailboxPins : testing::Test, ByHand {
  void SetUp() override { power_on(); }
};

TEST_F(MailboxPins, LevelsAtRest) {
  EXPECT_EQ(board.level(kMiso), kReleased);
  EXPECT_EQ(int_level(), 1);
  EXPECT_EQ(board.level(kit::kTxd), 1);
  EXPECT_EQ(board.level(kit::kRts), 0);
  EXPECT_THAT(board.pin_changes(), IsEmpty());
}

TEST_F(MailboxPins, MisoIsDrivenWhileSelectedAndASelectWithoutABitIsNoFrame) {
  select();
  EXPECT_EQ(board.level(kMiso), 0);
  deselect();
  EXPECT_EQ(board.level(kMiso), kReleased);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(MailboxPins, AStartActsAtTheSecondRisingEdgeBehindXss) {
  constexpr Tick kFrame = (2 * 40 + 1) * kHalfSck;
  for (const Tick phase : {Tick{0}, Tick{1}, kCycle - 1}) {  // XSS rises with CLK, just after it, just before it
    while ((timeline.now() + kFrame) % kCycle != phase) run(1);
    said();
    frame(kStart);
    ASSERT_EQ(deselected % kCycle, phase);
    const std::size_t before = board.events().size() - said().size();
    ASSERT_LT(before, board.events().size());
    ASSERT_EQ(board.events()[before].reason, Reason::kStarted);
    EXPECT_EQ(board.events()[before].at, (deselected / kCycle + 2) * kCycle);
    EXPECT_EQ(kind().describe(board.events()[before]), "started: address 5, ident 0B0C");
  }
  EXPECT_EQ(status().dp_state, profibus::DpState::kWaitPrm);
  EXPECT_EQ(status().address, kSlave);
  EXPECT_EQ(status().baud, std::nullopt);
}

TEST_F(MailboxPins, OutputsAreZerosBeforeAnyMaster) {
  frame(kStart);
  EXPECT_EQ(frame(kRead), Bytes(kDataFrame, 0));
  EXPECT_EQ(int_level(), 1);
}

TEST_F(MailboxPins, InputsAreRefusedBeforeTheStart) {
  frame(write_frame({1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_THAT(said(), ElementsAre(profibus::Reason::kInputLength));
  frame(kStart);
  said();
  frame(write_frame({1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(MailboxPins, FramesOfAWrongLengthAreDropped) {
  for (const std::uint8_t code : {command::kWriteInputs, command::kReadOutputs, command::kStart}) {
    const std::size_t right = code == command::kStart ? 40 : 72;
    Bytes bytes = kStart;
    bytes[0] = code;
    for (const std::size_t bits : {std::size_t{8}, right - 8, right - 1, right + 1, right + 8, std::size_t{200}}) {
      shift(bytes, bits);
      ASSERT_THAT(said(), ElementsAre(Reason::kFrameLength)) << int{code} << ", " << bits << " bits";
      EXPECT_EQ(board.events().back().a, bits);
      EXPECT_EQ(board.events().back().b, right);
    }
  }
  EXPECT_EQ(status().dp_state, profibus::DpState::kOffline);
}

TEST_F(MailboxPins, LessThanACommandIsDropped) {
  shift({0xFF}, 7);
  ASSERT_THAT(said(), ElementsAre(Reason::kFrameLength));
  EXPECT_EQ(kind().describe(board.events().back()), "frame dropped: 7 bits with the command 00, which has 8");
}

TEST_F(MailboxPins, UnknownCommandsAreDropped) {
  for (const int code : {0x00, 0x04, 0x81, 0xFF}) {
    frame({static_cast<std::uint8_t>(code), 1, 2, 3, 0});
    ASSERT_THAT(said(), ElementsAre(Reason::kCommandUnknown)) << code;
  }
  EXPECT_EQ(kind().describe(board.events().back()), "frame dropped: FF is no command (40 bits)");
}

TEST_F(MailboxPins, AStartWithAnImpossibleAddressOrFlagsIsRefused) {
  frame({command::kStart, 126, 0, 1, 0});
  frame({command::kStart, 5, 0, 1, 0x80});
  EXPECT_THAT(said(), ElementsAre(Reason::kStartRefused, Reason::kStartRefused));
  EXPECT_EQ(status().dp_state, profibus::DpState::kOffline);
  frame({command::kStart, 125, 0, 1, 0});
  EXPECT_EQ(status().address, 125);
}

TEST_F(MailboxPins, ResetEndsEverythingAtOnceAndAFrameThatBeganInItIsNone) {
  frame(kStart);
  select();
  set(kit::kReset, 0, 10);
  EXPECT_EQ(board.level(kMiso), kReleased);
  EXPECT_EQ(status().dp_state, profibus::DpState::kOffline);
  said();
  power_on();
  EXPECT_EQ(board.level(kMiso), kReleased) << "XSS fell in front of this reset";
  clock(kStart, 40);
  deselect();
  set(kit::kReset, 0);
  frame(kStart);
  power_on();
  EXPECT_THAT(said(), IsEmpty());
  frame(kStart);
  EXPECT_EQ(status().dp_state, profibus::DpState::kWaitPrm);
}

// --- with a master ---------------------------------------------------------------------------------------------------

bus::SlaveParameters slave_parameters() {
  bus::SlaveParameters slave;
  slave.name = "mailbox";
  slave.address = kSlave;
  slave.ident = kIdent;
  slave.cfg = {kConfiguration.begin(), kConfiguration.end()};
  slave.input_length = slave.output_length = kDataBytes;
  slave.wd_fact_1 = 5;  // 50 ms
  slave.wd_fact_2 = 1;
  return slave;
}

/// A master on the chip's segment, and a monitor that must report nothing.
struct Plant : ByHand {
  explicit Plant(Engine engine = Engine::kSkip, int baud = 0)
      : ByHand(engine), master(segment, config(baud)), monitor(segment) {
    timeline.add(master);
    timeline.add(monitor);
    monitor.set_baud(baud);
    monitor.on_flag = [this](const bus::Flag& flag) {
      if (flag.kind != bus::FlagKind::kUnanswered) flags.push_back(format_line(flag));
    };
    power_on();
  }
  static bus::MasterConfig config(int baud) {
    bus::MasterConfig config;
    config.address = kMaster;
    config.baud = baud;
    return config;
  }

  bool exchanging() const { return master.slave(kSlave).state == bus::SlaveState::kDataExchange; }
  bool reach_exchange(Tick limit = 100 * kTicksPerMs) {
    for (const Tick end = timeline.now() + limit; !exchanging() && timeline.now() < end;) run(kTicksPerMs);
    run(kTicksPerMs);
    return exchanging();
  }
  bool bring_up(const bus::SlaveParameters& parameters = slave_parameters(), Tick limit = 100 * kTicksPerMs) {
    master.add_slave(parameters);
    master.start();
    return reach_exchange(limit);
  }
  const Bytes& master_inputs() const { return master.slave(kSlave).inputs; }

  bus::Master1 master;
  bus::Monitor monitor;
  std::vector<std::string> flags;
};

struct MailboxOnTheBus : testing::Test, Plant {
  void start_and_bring_up() {
    frame(kStart);
    ASSERT_TRUE(bring_up()) << master.slave(kSlave).reason;
  }
  /// The master stops; its last outputs are still unread.
  void stop_master() {
    master.stop();
    run(kTicksPerMs);
  }
};

TEST_F(MailboxOnTheBus, IsBroughtUpWithoutAWordOfItsUser) {
  start_and_bring_up();
  EXPECT_EQ(status().dp_state, profibus::DpState::kDataExch);
  EXPECT_EQ(status().baud, 0);
  EXPECT_EQ(status().master, kMaster);
  EXPECT_GT(status().data_exchanges, 10U);
  EXPECT_GT(status().telegrams_received, status().telegrams_answered);
  EXPECT_GT(status().outputs_missed, 10U) << "nobody reads";
  EXPECT_EQ(board.count(profibus::Reason::kCfgAccepted), 1U);
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(MailboxOnTheBus, InputsReachTheMasterAndThoseOfAWrongFrameDoNot) {
  start_and_bring_up();
  frame(write_frame({1, 2, 3, 4, 5, 6, 7, 8}));
  run(kTicksPerMs);
  EXPECT_EQ(master_inputs(), (Bytes{1, 2, 3, 4, 5, 6, 7, 8}));
  shift(write_frame(Bytes(kDataBytes, 0xEE)), 71);
  shift(write_frame(Bytes(kDataBytes, 0xEE)), 73);
  run(kTicksPerMs);
  EXPECT_EQ(board.count(Reason::kFrameLength), 2U);
  EXPECT_EQ(master_inputs(), (Bytes{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST_F(MailboxOnTheBus, IntFallsWithOutputsAndRisesWhenTheyWereRead) {
  start_and_bring_up();
  const Bytes outputs = {0x80, 0x01, 0xFF, 0x00, 0x55, 0xAA, 0x12, 0x34};
  master.set_outputs(kSlave, outputs);
  run(kTicksPerMs);
  stop_master();
  EXPECT_EQ(int_level(), 0);
  EXPECT_EQ(frame(kRead), shown(outputs));
  EXPECT_EQ(int_level(), 1);
  ASSERT_EQ(board.pin_changes().back().pin, kInt);
  EXPECT_EQ(board.pin_changes().back().at, (deselected / kCycle + 2) * kCycle);
  EXPECT_EQ(frame(kRead), shown(outputs)) << "they can be read again";
}

TEST_F(MailboxOnTheBus, AReadOfAWrongLengthLeavesIntLow) {
  start_and_bring_up();
  stop_master();
  shift(kRead, 64);
  EXPECT_EQ(int_level(), 0);
  frame(kRead);
  EXPECT_EQ(int_level(), 1);
}

TEST_F(MailboxOnTheBus, AReadShowsOneBlockAndNewerOutputsKeepIntLow) {
  start_and_bring_up();
  master.set_outputs(kSlave, Bytes(kDataBytes, 0x11));
  run(kTicksPerMs);
  select();
  clock(kRead, 8);
  master.set_outputs(kSlave, Bytes(kDataBytes, 0x22));
  run(kTicksPerMs);
  stop_master();
  EXPECT_EQ(clock({}, 64), Bytes(kDataBytes, 0x11));
  deselect();
  EXPECT_EQ(int_level(), 0);
  EXPECT_EQ(frame(kRead), shown(Bytes(kDataBytes, 0x22)));
  EXPECT_EQ(int_level(), 1);
}

TEST_F(MailboxOnTheBus, TheWatchdogClearsTheOutputsAndSaysSo) {
  start_and_bring_up();
  master.set_outputs(kSlave, Bytes(kDataBytes, 0x11));
  run(kTicksPerMs);
  stop_master();
  EXPECT_EQ(frame(kRead), shown(Bytes(kDataBytes, 0x11)));
  run(60 * kTicksPerMs);
  EXPECT_EQ(board.count(profibus::Reason::kWatchdogExpired), 1U);
  EXPECT_EQ(status().dp_state, profibus::DpState::kWaitPrm);
  EXPECT_EQ(int_level(), 0);
  EXPECT_EQ(frame(kRead), shown(Bytes(kDataBytes, 0)));
  EXPECT_EQ(int_level(), 1);
}

TEST_F(MailboxOnTheBus, AStartHidesNoOutputsFromTheUser) {
  start_and_bring_up();
  stop_master();
  run(60 * kTicksPerMs);  // the watchdog: zeros are to be read
  ASSERT_EQ(status().dp_state, profibus::DpState::kWaitPrm);
  ASSERT_EQ(int_level(), 0);
  frame(kStart);
  EXPECT_EQ(int_level(), 0) << "the slave has forgotten its mail, but the user has not read the zeros";
  frame(kRead);
  EXPECT_EQ(int_level(), 1);
}

TEST_F(MailboxOnTheBus, AStartInDataExchangeBeginsAnew) {
  start_and_bring_up();
  master.set_outputs(kSlave, Bytes(kDataBytes, 0x33));
  run(kTicksPerMs);
  frame(kStart);
  EXPECT_EQ(status().dp_state, profibus::DpState::kWaitPrm);
  EXPECT_EQ(int_level(), 0);
  EXPECT_EQ(frame(kRead), shown(Bytes(kDataBytes, 0)));
  run(5 * kTicksPerMs);
  ASSERT_TRUE(reach_exchange());
  EXPECT_EQ(frame(kRead), shown(Bytes(kDataBytes, 0x33)));
  EXPECT_EQ(board.count(profibus::Reason::kCfgAccepted), 2U);
}

TEST_F(MailboxOnTheBus, TheSlaveItselfRefusesAnotherConfigurationOfTheSameLengths) {
  frame(kStart);
  bus::SlaveParameters other = slave_parameters();
  other.cfg = {0x27, 0x17};
  EXPECT_FALSE(bring_up(other, 20 * kTicksPerMs));
  EXPECT_GT(board.count(profibus::Reason::kCfgDiffers), 0U);
}

TEST_F(MailboxOnTheBus, TheSlaveItselfRefusesMoreConfigurationThanItHolds) {
  frame(kStart);
  bus::SlaveParameters other = slave_parameters();
  other.cfg = {0x13, 0x13, 0x27};
  EXPECT_FALSE(bring_up(other, 20 * kTicksPerMs));
  EXPECT_GT(board.count(profibus::Reason::kCfgTooLong), 0U);
}

TEST_F(MailboxOnTheBus, TheSlaveItselfRefusesUserParametersAndDpv1) {
  frame(kStart);
  bus::SlaveParameters other = slave_parameters();
  other.user_prm = {0x00};
  EXPECT_FALSE(bring_up(other, 20 * kTicksPerMs));
  EXPECT_GT(board.count(profibus::Reason::kPrmUserLength), 0U);
  EXPECT_EQ(board.count(profibus::Reason::kPrmDpv1), 0U);
  other.address = kSlave + 1;
  other.dpv1 = true;
  frame({command::kStart, kSlave + 1, kIdent >> 8, kIdent & 0xFF, 0});
  master.add_slave(other);
  run(20 * kTicksPerMs);
  EXPECT_GT(board.count(profibus::Reason::kPrmDpv1), 0U);
}

// --- with its user ---------------------------------------------------------------------------------------------------

struct UsersPlant : Plant {
  explicit UsersPlant(Engine engine = Engine::kSkip, int baud = 0, const UserConfig& config = {})
      : Plant(engine, baud), user(make_user(board.chip(), config)) {
    timeline.add(*user);
  }
  void set_inputs(const Bytes& bytes) { user->command(timeline.now(), user_cpu::command::SetInputs{bytes}); }
  user_cpu::ProgramCounters counters() const { return *user->counters().program; }
  std::unique_ptr<user_cpu::StationCpu> user;
};

struct MailboxUser : testing::Test, UsersPlant {};

TEST_F(MailboxUser, StartsTheChipAndKeepsItsPeriod) {
  run(20 * kTicksPerUs);
  EXPECT_EQ(status().dp_state, profibus::DpState::kWaitPrm);
  run(1010 * kTicksPerUs);  // the tenth round ends about 15 us after its beginning
  EXPECT_EQ(counters().inputs_written, 10U);
  EXPECT_EQ(counters().outputs_received, 0U) << "no master";
  EXPECT_EQ(board.count(Reason::kStarted), 1U);
  EXPECT_EQ(board.events().size(), 3U) << "STARTED, DP_STATE, BAUD_SEARCH: no frame is refused";
}

TEST_F(MailboxUser, OutputsComeBackAsInputs) {
  ASSERT_TRUE(bring_up());
  const Bytes data = {0x80, 0x01, 0xFF, 0x00, 0x55, 0xAA, 0x12, 0x34};
  master.set_outputs(kSlave, data);
  run(kTicksPerMs);
  EXPECT_EQ(user->outputs(), data);
  EXPECT_EQ(master_inputs(), data);
  EXPECT_GT(counters().outputs_received, 5U);
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(MailboxUser, InputsOfItsOwnReachTheMaster) {
  ASSERT_TRUE(bring_up());
  master.set_outputs(kSlave, Bytes(kDataBytes, 0x77));
  set_inputs({1, 2, 3, 4, 5, 6, 7, 8});
  run(kTicksPerMs);
  EXPECT_EQ(master_inputs(), (Bytes{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(user->outputs(), Bytes(kDataBytes, 0x77));
}

TEST(MailboxUserConfig, OtherClockAndPeriodServeAsWell) {
  UserConfig config;
  config.sck_period = 520;  // 23 MHz: a frame ends two cycles before the next one begins
  config.period = 1000 * kTicksPerUs;
  UsersPlant plant(Engine::kSkip, 0, config);
  ASSERT_TRUE(plant.bring_up());
  plant.master.set_outputs(kSlave, Bytes(kDataBytes, 0x5A));
  plant.run(3 * kTicksPerMs);
  EXPECT_EQ(plant.master_inputs(), Bytes(kDataBytes, 0x5A));
  EXPECT_EQ(plant.board.count(Reason::kFrameLength) + plant.board.count(Reason::kCommandUnknown), 0U);
}

// --- the engines -----------------------------------------------------------------------------------------------------

std::string words(const tb::PinEdge& change) {
  return std::string(kind().pins()[change.pin].name) + "=" + std::to_string(change.level) + " at tick " +
         std::to_string(change.at);
}
std::string words(const profibus::Event& event) {
  return std::string(profibus::code(event.reason)) + " at tick " + std::to_string(event.at) + ": " +
         kind().describe(event);
}

template <typename T>
std::vector<std::string> all_words(const std::vector<T>& list) {
  std::vector<std::string> lines(list.size());
  std::transform(list.begin(), list.end(), lines.begin(), [](const T& each) { return words(each); });
  return lines;
}

void expect_same(const std::vector<std::string>& step, const std::vector<std::string>& skip) {
  const auto [first, second] = std::mismatch(step.begin(), step.end(), skip.begin(), skip.end());
  EXPECT_TRUE(first == step.end() && second == skip.end())
      << "step: " << (first == step.end() ? "nothing more" : *first)
      << "\nskip: " << (second == skip.end() ? "nothing more" : *second);
}

void expect_same(const ByHand& step, const ByHand& skip) {
  expect_same(all_words(step.board.pin_changes()), all_words(skip.board.pin_changes()));
  expect_same(all_words(step.board.events()), all_words(skip.board.events()));
  EXPECT_EQ(step.status().telegrams_received, skip.status().telegrams_received);
  EXPECT_EQ(step.status().data_exchanges, skip.status().data_exchanges);
  EXPECT_EQ(step.status().outputs_missed, skip.status().outputs_missed);
}

class MailboxEngines : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(BaudIndex, MailboxEngines, testing::Values(0, 1));

// From power-on through data exchange with a reset in the middle, and the watchdog.
TEST_P(MailboxEngines, StepAndSkipGiveTheSamePinsAndEvents) {
  const auto play = [](UsersPlant& plant) {
    ASSERT_TRUE(plant.bring_up());
    plant.master.set_outputs(kSlave, Bytes(kDataBytes, 0x5A));
    plant.run(kTicksPerMs + 77);
    plant.set_inputs({9, 8, 7, 6, 5, 4, 3, 2});
    plant.run(kTicksPerMs + 131);
    EXPECT_GT(plant.status().data_exchanges, 5U);
    plant.master.stop();
    plant.run(55 * kTicksPerMs);
    plant.set(kit::kReset, 0, 11);
    plant.run(kTicksPerMs);
  };
  UsersPlant step(Engine::kStep, GetParam()), skip(Engine::kSkip, GetParam());
  play(step);
  play(skip);
  EXPECT_EQ(step.board.count(profibus::Reason::kWatchdogExpired), 1U);
  EXPECT_GT(step.board.count(kInt, 0), 5U);
  EXPECT_GT(step.board.count(kit::kRts, 1), 20U);
  EXPECT_GT(step.board.count(kMiso, 1), 20U);
  expect_same(step, skip);
}

/// Correct and faulty frames with any clock and gap, and an occasional reset; the same for each seed.
class RandomFrames {
 public:
  RandomFrames(ByHand& chip, unsigned seed) : chip_(chip), random_(seed) {}

  void play(int frames) {
    frame(kStart, 40);
    for (int i = 0; i < frames; ++i) {
      if (one_in(50)) reset();
      one_in(15) ? frame(kStart, 40) : one_in(2) ? frame(kRead, 72) : frame(random_frame(), 72);
      chip_.run(one_in(4) ? up_to(600) : up_to(200'000));
    }
  }

 private:
  int up_to(int most) { return std::uniform_int_distribution<int>(1, most)(random_); }
  bool one_in(int many) { return up_to(many) == 1; }
  Bytes random_frame() {
    Bytes bytes(kDataFrame, 0);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(up_to(256) - 1);
    if (!one_in(10)) bytes[0] = command::kWriteInputs;
    return bytes;
  }
  void frame(const Bytes& bytes, int bits) {
    if (one_in(8)) bits = up_to(80) - 1;
    const int half = up_to(800);
    chip_.select();
    for (int i = 0; i < bits; ++i) {
      const auto byte = static_cast<std::size_t>(i) / 8;
      chip_.set(kMosi, byte < bytes.size() ? static_cast<Level>(bytes[byte] >> (7 - i % 8) & 1) : Level{1});
      chip_.set(kSck, 1, up_to(half));
      chip_.set(kSck, 0, up_to(half));
    }
    chip_.set(kXss, 1, up_to(half));
  }
  void reset() {
    chip_.set(kit::kReset, 0);
    chip_.set(kit::kReset, 1, up_to(2000));
    chip_.run(5 * kCycle);
    frame(kStart, 40);
    chip_.run(5 * kTicksPerMs);
  }

  ByHand& chip_;
  std::mt19937 random_;
};

class MailboxRandom : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, MailboxRandom, testing::Range(1U, 9U));

TEST_P(MailboxRandom, StepAndSkipGiveTheSamePinsAndEventsForAnyFrames) {
  Plant step(Engine::kStep), skip(Engine::kSkip);
  for (Plant* plant : {&step, &skip}) {
    plant->master.add_slave(slave_parameters());
    plant->master.set_outputs(kSlave, {0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF});
    plant->master.start();
    RandomFrames(*plant, GetParam()).play(300);
  }
  EXPECT_GT(step.board.count(Reason::kFrameLength), 10U);
  EXPECT_GT(step.board.count(profibus::Reason::kCfgAccepted), 0U);
  expect_same(step, skip);
}

// --- the reasons -----------------------------------------------------------------------------------------------------

const std::regex kValue("\\{[abc](:(2x|3x|4x|state|rate|sap|rm|high|low|low2x))?\\}");

TEST(MailboxReasons, EveryReasonHasACodeOfItsOwnAndNoPlaceholderIsLeft) {
  std::set<std::string> codes;
  for (const tb::CodeText& each : kind().codes().front().codes) {
    EXPECT_TRUE(codes.insert(each.code).second) << each.code;
    EXPECT_EQ(std::regex_replace(each.text, kValue, "").find('{'), std::string::npos) << each.code;
    EXPECT_EQ(each.advice.find('{'), std::string::npos) << each.code;
  }
  EXPECT_EQ(codes.size(), kind().reasons().size());
  EXPECT_EQ(codes.count("STARTED") + codes.count("PRM_IDENT"), 2U) << "a room is missing";
}

TEST(MailboxReasons, TheSlavesReasonsSpeakOfTheMailboxInItsOwnWords) {
  EXPECT_EQ(
      profibus::advice(profibus::Reason::kPrmIdent, kind().made_of().words),
      "Use the GSD file of this device, or initialise with the ident number of the GSD file (bytes 2 and 3 of the "
      "start frame).");
  EXPECT_EQ(kind().describe({0, profibus::Reason::kDpState, 0, 1}), "DP state OFFLINE to WAIT_PRM");
}

}  // namespace
}  // namespace dsdpv1::mailbox
