// The bus side of the TLM module: characters to PBRXD and from PBTXD.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <memory>

#include "registers/dsdpv1_regs.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::BusCharacter;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;

namespace {

constexpr Tick kBit = 1000;  // 12 Mbit/s
constexpr Tick kSearch = 120 * kUs, kRequest = 200 * kUs, kBroken = 300 * kUs, kSlow = 310 * kUs, kOverlap = 320 * kUs,
               kPast = 330 * kUs;
constexpr std::uint8_t kAddress = 9, kMaster = 2;
const std::vector<std::uint8_t> kFdlStatus = {0x10, kAddress, kMaster, 0x49, 0x54, 0x16};

constexpr Tick kPhase = 100;

/// The characters that a chip sends, and the times at which they are reported.
struct Ear : tlm::tlm_analysis_if<BusCharacter> {
  std::vector<BusCharacter> heard;
  std::vector<sc_time> heard_at;

  void write(const BusCharacter& character) override {
    heard.push_back(character);
    heard_at.push_back(sc_core::sc_time_stamp());
  }
};

/// A chip whose pins have no observer, so that characters pass as runs: to it, and from it.
struct Unheard : sc_core::sc_module, Ear {
  dsdpv1::systemc::TlmModule chip;
  tlm_utils::simple_initiator_socket<Unheard> cpu{"cpu"};  // required, idle

  Unheard(const sc_core::sc_module_name& name, sc_core::sc_signal<bool>& reset, sc_core::sc_signal<bool>& low)
      : sc_module(name), chip("chip", options()) {
    chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low);
    cpu.bind(chip.host_socket);
    chip.bus_out.bind(*this);
  }
  static dsdpv1::systemc::TlmOptions options() {
    dsdpv1::systemc::TlmOptions options;
    options.phase = kPhase;
    return options;
  }
  bool found_a_rate() const { return chip.chip().status().baud_index.known(); }
};

struct World : sc_core::sc_module, Ear {
  dsdpv1::systemc::TlmModule chip{"chip"};
  tlm_utils::simple_initiator_socket<World> cpu{"cpu"};  // required, idle
  sc_core::sc_signal<bool> reset, r_req, r_sta, pbtxd, pbrts, pbrxd;
  Unheard phased{"phased", reset, r_req};
  Unheard two_rates{"two_rates", reset, r_req};  // the last character of the first telegram has half the rate
  Changes changes;
  std::vector<sc_time> rts_at;
  Tick request_end = 0;

  explicit World(const sc_core::sc_module_name& name) : sc_module(name), pbrxd("pbrxd", true) {
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta), chip.PBTXD(pbtxd), chip.PBRTS(pbrts), chip.PBRXD(pbrxd);
    cpu.bind(chip.host_socket);
    chip.bus_out.bind(*this);
    chip.on_pin = [this](Tick at, Pin pin, dsdpv1::Level level) { changes.push_back({at, pin, level}); };
    method_on(
        pbrts.value_changed_event(), [this] { rts_at.push_back(sc_core::sc_time_stamp()); });
    thread([this] { run(); });
  }

  void run() {
    wait_until(100);
    reset.write(true);
    wait_until(100 * kUs);
    for (auto* each : {&chip, &phased.chip, &two_rates.chip}) initialise(*each);
    send(chip, kSearch, kFdlStatus);
    send(phased.chip, kSearch, kFdlStatus);
    const std::vector<std::uint8_t> but_last(kFdlStatus.begin(), kFdlStatus.end() - 1);
    const Tick last = send(two_rates.chip, kSearch, but_last);
    two_rates.chip.bus_in->write({to_time(last), to_time(2 * kBit), kFdlStatus.back(), true, true});
    request_end = send(chip, kRequest, kFdlStatus);
    send(phased.chip, kRequest, kFdlStatus);
    wait_until(kBroken);
    chip.bus_in->write({to_time(kBroken), to_time(kBit), 0x00, false, false});
    wait_until(kSlow);
    // 0.3 % slow: 1003 ticks a bit
    chip.bus_in->write({to_time(kSlow), sc_time::from_value(to_time(kBit).value() * 1003 / 1000), 0x55, true, true});
    wait_until(kOverlap);
    chip.bus_in->write({to_time(kOverlap), to_time(kBit), 0x00, true, true});
    chip.bus_in->write({to_time(kOverlap + 5 * kBit), to_time(kBit), 0xFF, true, true});
    wait_until(kPast);
    chip.bus_in->write({to_time(kPast - 1), to_time(kBit), 0x00, true, true});
    chip.bus_in->write({to_time(kPast + 1), sc_core::SC_ZERO_TIME, 0x00, true, true});
    pbrxd.write(false);
    wait_until(kPast + 777);
    pbrxd.write(true);
  }

  /// The user's part without the pins: table 2's initialisation data and their flag.
  static void initialise(dsdpv1::systemc::TlmModule& chip) {
    std::vector<std::uint8_t> init = {16, kAddress, 0x0C, 0x0D, 0, 0, 0, 4, 4, 0, 0, 0, 2, 0, 2, 0x13, 0x23};
    std::uint16_t crc = 0xFFFF;  // D2
    std::uint16_t cell = dsdpv1::regs::kInit;
    for (const std::uint8_t byte : init) {
      chip.poke(cell++, byte);
      crc = static_cast<std::uint16_t>(crc ^ byte);
      for (int i = 0; i < 8; ++i) crc = static_cast<std::uint16_t>((crc & 1) != 0 ? crc >> 1 ^ 0xA001 : crc >> 1);
    }
    chip.poke(dsdpv1::regs::kInitCrc, static_cast<std::uint8_t>(crc >> 8));
    chip.poke(dsdpv1::regs::kInitCrc + 1, static_cast<std::uint8_t>(crc & 0xFF));
    chip.poke(dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Init);
  }

  static Tick send(dsdpv1::systemc::TlmModule& chip, Tick start, const std::vector<std::uint8_t>& telegram) {
    for (const std::uint8_t byte : telegram) {
      chip.bus_in->write({to_time(start), to_time(kBit), byte, true, true});
      start += 11 * kBit;
    }
    return start;
  }
};

std::unique_ptr<World> world;

/// The edges of PBRXD in [from, to), as offsets from `from`.
std::vector<std::pair<Tick, int>> edges(Tick from, Tick to) {
  std::vector<std::pair<Tick, int>> found;
  for (const Change& c : only(world->changes, Pin::kPbrxd))
    if (c.at >= from && c.at < to) found.emplace_back(c.at - from, c.level);
  return found;
}

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>("world");
  sc_core::sc_start(400, sc_core::SC_US);
}

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(Bus, ACharacterMovesPbrxdAtTheExactTicks) {
  // 10h: start, 0000 1000 LSB first, parity 1, stop
  EXPECT_THAT(edges(kSearch, kSearch + 11 * kBit),
              ElementsAre(Pair(0, 0), Pair(5 * kBit, 1), Pair(6 * kBit, 0), Pair(9 * kBit, 1)));
}

TEST(Bus, ParityAndFramingErrorsAreOnTheLine) {
  EXPECT_THAT(edges(kBroken, kBroken + 20 * kBit),
              ElementsAre(Pair(0, 0), Pair(9 * kBit, 1), Pair(10 * kBit, 0), Pair(11 * kBit, 1)));
}

TEST(Bus, TheBitTimeIsTheSenders) {
  const auto found = edges(kSlow, kSlow + 11 * kBit);
  ASSERT_EQ(found.size(), 10U);
  EXPECT_EQ(found.back().first, 10 * 1003);  // the stop bit
}

TEST(Bus, AnOverlappingCharacterDestroysTheRestAndIsReported) {
  EXPECT_THAT(edges(kOverlap, kOverlap + 20 * kBit),
              ElementsAre(Pair(0, 0), Pair(6 * kBit, 1), Pair(14 * kBit, 0), Pair(15 * kBit, 1)));
  EXPECT_THAT(reports_of("/dsdpv1/bus", "world.chip"),
              testing::Contains(HasSubstr("begins before the previous one has ended")));
}

TEST(Bus, CharactersInThePastOrWithoutBitTimeAreNotSentAndReported) {
  EXPECT_THAT(reports_of("/dsdpv1/bus", "world.chip"), testing::Contains(HasSubstr("begins in the past")));
  EXPECT_THAT(reports_of("/dsdpv1/bus", "world.chip"), testing::Contains(HasSubstr("has no bit time")));
  EXPECT_THAT(edges(kPast, kPast + 20 * kBit), ElementsAre(Pair(0, 0), Pair(777, 1))) << "only what the raw line did";
}

TEST(Bus, TheAnswerComesAsCharactersEachAtItsEnd) {
  std::vector<int> data;
  for (std::size_t i = 0; i < world->heard.size(); ++i) {
    const BusCharacter& c = world->heard[i];
    data.push_back(c.data);
    EXPECT_TRUE(c.parity_ok && c.stop_ok);
    EXPECT_EQ(c.bit, to_time(kBit));
    EXPECT_EQ(world->heard_at[i], to_time(dsdpv1::systemc::to_tick(c.start) + 11 * kBit));
  }
  EXPECT_THAT(data, ElementsAre(0x10, kMaster, kAddress, 0x00, 0x0B, 0x16));
}

TEST(Bus, TheAnswerHasThePhaseOfTheClockAlsoWhenNobodyHearsAPin) {
  ASSERT_EQ(world->phased.heard.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const BusCharacter& c = world->phased.heard[i];
    EXPECT_EQ(c.data, world->heard.at(i).data);
    EXPECT_EQ(dsdpv1::systemc::to_tick(c.start) % profibus::kTicksPerCycle, kPhase);
    EXPECT_EQ(world->phased.heard_at[i], to_time(dsdpv1::systemc::to_tick(c.start) + 11 * kBit));
  }
}

TEST(Bus, ACharacterOfAnotherRateIsNoneOfTheRunBeforeIt) {
  EXPECT_TRUE(world->phased.found_a_rate());
  EXPECT_FALSE(world->two_rates.found_a_rate());
}

TEST(Bus, TheAnswerBeginsAtMinTsdr) {
  ASSERT_FALSE(world->heard.empty());
  const Tick tsdr = dsdpv1::systemc::to_tick(world->heard.front().start) - world->request_end;
  EXPECT_GE(tsdr, 11 * kBit);
  EXPECT_LE(tsdr, 12 * kBit);
}

TEST(Bus, PbrtsFramesTheAnswer) {
  ASSERT_EQ(world->rts_at.size(), 2U);
  ASSERT_EQ(world->heard.size(), 6U);
  EXPECT_EQ(world->rts_at[0], to_time(dsdpv1::systemc::to_tick(world->heard.front().start) - 4 * 250));
  EXPECT_EQ(world->rts_at[1], to_time(dsdpv1::systemc::to_tick(world->heard.back().start) + 11 * kBit + 4 * 250));
}

}  // namespace
}  // namespace dsdpv1
