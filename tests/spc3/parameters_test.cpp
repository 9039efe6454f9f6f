// The parameters of docs/spc3.md: each of their values has a test that fails if the chip has another value.
#include <sys/wait.h>

#include <array>
#include <cstdlib>
#include <map>
#include <set>

#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

spc3::Config with(std::uint32_t spc3::Config::*parameter, std::uint32_t value) {
  spc3::Config config;
  config.*parameter = value;
  return config;
}

// --- values that no other test has -----------------------------------------------------------------------------------

TEST(Parameters, TheTypeOfAVpc3) {
  for (const std::uint32_t type : {0xBU, 0xCU, 0xEU}) {
    Bench bench(Variant::kVpc3, with(&spc3::Config::type, type));
    bench.power_on();
    EXPECT_EQ(bench.load(regs::kStatus + 1) >> 4, static_cast<int>(type));
  }
}

TEST(Parameters, TheAddressOfStartStays) {
  Bench bench;
  bench.to_wait_prm();
  bench.store(regs::kOrgAddress, 9);
  EXPECT_EQ(kind_of(bench.ask(60)), "DL") << "at the address of START (A5)";
}

TEST(Parameters, TheInactiveTimeMayBeTwoMilliseconds) {
  Bench bench(Variant::kApc3, with(&spc3::Config::eoi_1ms, 96'000));
  bench.power_on();
  bench.store(regs::kMode0 + 1, regs::kMode0EoiTimeBase >> 8);
  bench.store(regs::kImr, 0);
  bench.store(regs::kIrr, 0x02);
  bench.run_cycles(2);
  bench.set_mode1(regs::kMode1Eoi);
  bench.run_cycles(96'000);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 1);
  bench.run_cycles(1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 0) << "A13";
}

TEST(Parameters, ReservedBitsOfAVpc3MayBeIgnored) {
  Bench bench(Variant::kVpc3, with(&spc3::Config::prm_reserved, 1));
  bench.to_wait_prm();
  bench.set_prm({0x08}, 0x81);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg) << "A21";
}

TEST(Parameters, DataExBeginsByTheNameWithInputsOrWithCfgOk) {
  for (const Variant variant : {Variant::kApc3, Variant::kVpc3})
    for (std::uint32_t rule = 0; rule < 3; ++rule) {
      Bench bench(variant, with(&spc3::Config::data_ex, rule));
      bench.to_wait_cfg();
      bench.check_cfg();
      bench.load(regs::kCfgOk);
      bench.run_cycles(2);
      const bool at_once = rule == 2 || (rule == 0 && variant == Variant::kVpc3);
      EXPECT_EQ(bench.state(), at_once ? DpState::kDataExch : DpState::kWaitCfg) << rule;
      bench.give_inputs({1, 2, 3});
      bench.run_cycles(2);
      EXPECT_EQ(bench.state(), DpState::kDataExch) << "A24";
    }
}

TEST(Parameters, TheCombiDefaultOfMinTsdr) {
  Bench bench(Variant::kApc3, with(&spc3::Config::tsdr_combi, 100));
  Organisation given;
  given.modes |= regs::kMode0Combi;
  bench.to_wait_prm(given);
  EXPECT_NEAR(bench.ask(60).tsdr_bits(), 100, 1) << "A33";
}

TEST(Parameters, AnAnswerMayWaitLongerForXcts) {
  for (const std::uint32_t wait : {100U, 11U, 0U}) {
    Bench bench(Variant::kApc3, with(&spc3::Config::cts_wait, wait));
    bench.to_data_ex();
    bench.twins.set(bench.now(), Pin::kXCts, 1);
    const bus::Exchange sent =
        bench.requester.send(bench.timeline, bus::make_telegram(5, 2, 0x6D, {1, 2}), {.wants_answer = false});
    bench.run_until(sent.request_end + 60 * bench.requester.bit());
    EXPECT_EQ(bench.count(spc3::Reason::kNotClear), wait < 60) << "A35";
    bench.twins.set(bench.now(), Pin::kXCts, 0);
    bench.run_cycles(20);
    EXPECT_EQ(bench.twins.chip().level(Pin::kRts), wait < 60 ? 0 : 1);
    bench.run_ms(1);
  }
}

TEST(Parameters, EventAndInterruptMayComeLater) {
  spc3::Config config = with(&spc3::Config::event_delay, 60);
  config.int_delay = 40;
  Bench bench(Variant::kApc3, config);
  bench.to_data_ex();
  bench.run_cycles(300);
  bench.acknowledge(0xFFFF);
  bench.set_mode1(regs::kMode1Eoi);
  bench.run_cycles(100);
  const bus::Exchange sent =
      bench.requester.send(bench.timeline, bus::make_telegram(5, 2, 0x6D, {1, 2}), {.wants_answer = false});
  const Cycle decided = sent.request_end / profibus::kTicksPerCycle + 3 + 4 + 1;
  bench.run_until((decided + 59) * profibus::kTicksPerCycle);
  EXPECT_EQ(bench.irr(), 0);
  bench.run_cycles(1);
  EXPECT_TRUE(bench.raised(regs::kEventDxOut)) << "A40";
  bench.run_cycles(39);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 1);
  bench.run_cycles(1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXInt), 0);
  bench.run_ms(1);
}

// --- the table -------------------------------------------------------------------------------------------------------

struct Row {
  const char* parameter;
  std::uint32_t value, other;  ///< the test has `value`, and fails with `other`
  const char* test;
};
constexpr Row kRows[] = {
    {"type", 12, 11, "Spc3Registers.AfterResetTheyAreAsThePageSays"},
    {"type", 11, 14, "Parameters.TheTypeOfAVpc3"},
    {"type", 14, 11, "Parameters.TheTypeOfAVpc3"},
    {"violation", 0, 1, "Violation.TheUsersAccessGoes400Lower"},
    {"violation", 1, 0, "Violation.MayOnlySetItsBit"},
    {"address_cells", 0, 1, "Parameters.TheAddressOfStartStays"},
    {"address_cells", 1, 0, "Judging.AddressCellsMayBeLive"},
    {"ram_seed", 0, 7, "Ram.AtPowerOnIsZeroOrFromASeed"},
    {"ram_seed", 7, 0, "Ram.AtPowerOnIsZeroOrFromASeed"},
    {"eoi_1ms", 48'000, 96'000, "Interrupts.EoiWithAnEventLeftIsInactiveForItsTime"},
    {"eoi_1ms", 96'000, 48'000, "Parameters.TheInactiveTimeMayBeTwoMilliseconds"},
    {"prm7", 0, 1, "Judging.SevenBytesAreTheChipsOwnMatter"},
    {"prm7", 1, 0, "Judging.SevenBytesMayGoToTheUser"},
    {"prm_reserved", 0, 1, "Judging.Vpc3RefusesReservedBitsOfParameters"},
    {"prm_reserved", 1, 0, "Parameters.ReservedBitsOfAVpc3MayBeIgnored"},
    {"prm_taken", 0, 1, "States.DataExchangeWaitsForTheAnswerToTheParametersToo"},
    {"prm_taken", 1, 0, "States.ParametersMayWaitForTheirVerdict"},
    {"ssa_cells", 0, 1, "Judging.AnAddressIsTakenInsideAndGoesToTheUser"},
    {"ssa_cells", 1, 0, "Judging.AddressCellsMayBeWrittenByTheChip"},
    {"data_ex", 0, 1, "Parameters.DataExBeginsByTheNameWithInputsOrWithCfgOk"},
    {"data_ex", 0, 2, "States.ParametersInDataExchangeLeadBackToWaitCfg"},
    {"data_ex", 1, 0, "Parameters.DataExBeginsByTheNameWithInputsOrWithCfgOk"},
    {"data_ex", 2, 0, "Parameters.DataExBeginsByTheNameWithInputsOrWithCfgOk"},
    {"fresh_56", 0, 1, "Data.ARepeatedReadOfOutputsIsComposedAgain"},
    {"fresh_56", 1, 0, "Data.ARepeatedReadOfInputsMayBeComposedAgain"},
    {"baud_control", 0, 1, "Spc3Watchdog.BaudControlSearchesAgainAndLeavesTheState"},
    {"baud_control", 1, 0, "Spc3Watchdog.BaudControlMayBeLinearOrOff"},
    {"tsdr_combi", 60, 100, "MinTsdr.IsTheCombiDefault"},
    {"tsdr_combi", 100, 60, "Parameters.TheCombiDefaultOfMinTsdr"},
    {"tsdr_at_search", 0, 1, "MinTsdr.ReturnsToTheDefaultWhenTheRateIsLost"},
    {"tsdr_at_search", 1, 0, "MinTsdr.ReturnsToTheDefaultWhenTheRateIsLost"},
    {"cts_wait", 11, 100, "Parameters.AnAnswerMayWaitLongerForXcts"},
    {"cts_wait", 100, 11, "Parameters.AnAnswerMayWaitLongerForXcts"},
    {"diag_bytes", 0, 1, "Spc3Diagnosis.BeforeTheFirstItHasTheSixBytes"},
    {"diag_bytes", 1, 0, "Spc3Diagnosis.TheRamMayStayAsTheUserWroteIt"},
    {"diag_flag_by", 0, 1, "Spc3Diagnosis.ANewOneMakesDataAnswersHighUntilTheHolderHasReadIt"},
    {"diag_flag_by", 1, 0, "Spc3Diagnosis.AnyMasterMayEndTheFlag"},
    {"event_delay", 32, 33, "Names/EachName.TheEventComesAfterItsDelay/apc3"},
    {"event_delay", 60, 59, "Parameters.EventAndInterruptMayComeLater"},
    {"int_delay", 1, 2, "Interrupts.TheLatchFollowsIrAndOnlyEoiEndsIt"},
    {"int_delay", 40, 39, "Parameters.EventAndInterruptMayComeLater"},
    {"ready", 6, 7, "BusTest.AReadAnswersAtReadyAndAWriteActsAtItsEnd"},
    {"ready", 9, 8, "BusTimes.AreParametersThatDoubleWith24MHz"},
    {"ready_release", 1, 2, "BusTest.AReadAnswersAtReadyAndAWriteActsAtItsEnd"},
    {"ready_release", 3, 2, "BusTimes.AreParametersThatDoubleWith24MHz"},
    {"ready_rule", 0, 1, "BusTest.AnAccessBeforeReadyIsReportedAndServed"},
    {"ready_rule", 1, 0, "StrictBus.GivesNothingBeforeReady"},
    {"strobe", 1, 2, "MotorolaSync.AnswersAClockAfterTheStrobeIsSeen"},
    {"strobe", 3, 2, "Synchronous.HasNoReadyAndAReadActsAfterStrobe"},
    {"clock", 48, 24, "Names/EachName.TheEventComesAfterItsDelay/spc3"},
    {"clock", 24, 48, "States.DelaysOfAnSpc3With24MhzAreTwiceAsLong"},
    {"spi_mode", 0, 1, "Modes/EachSpiMode.IsThatOfTheParameter/0"},
    {"spi_mode", 1, 0, "Modes/EachSpiMode.IsThatOfTheParameter/1"},
    {"spi_mode", 2, 3, "Modes/EachSpiMode.IsThatOfTheParameter/2"},
    {"spi_mode", 3, 2, "Modes/EachSpiMode.IsThatOfTheParameter/3"},
    {"spi_fetch", 0, 1, "Vpc3Spi.AReadActsWithItsFirstBit"},
    {"spi_fetch", 1, 0, "SpiAhead.MayActWithTheLastBitBefore"},
    {"empty_data", 0, 1, "Data.EmptyDataAreClearWithSpecClear"},
    {"empty_data", 1, 0, "Data.EmptyDataMayNeedFailSafeInTheParameters"},
};

/// The result of a test of this program in which all chips have this value.
bool passes(const Row& row, std::uint32_t value) {
  const std::string command = "GTEST_TOTAL_SHARDS=1 SPC3_FORCED=" + std::string(row.parameter) + "=" +
                              std::to_string(value) + " '" + testing::internal::GetArgvs()[0] +
                              "' --gtest_output= --gtest_filter=" + row.test + " >/dev/null 2>&1";
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c,concurrency-mt-unsafe)
  EXPECT_TRUE(WIFEXITED(status)) << command;
  return WEXITSTATUS(status) == 0;
}

TEST(Parameters, OfEachValueATestFailsWithAnother) {
  for (const Row& row : kRows)
    EXPECT_FALSE(passes(row, row.other)) << row.parameter << " = " << row.value << ": " << row.test;
}

// The others are those of every slave, which tests/conformance has.
TEST(Parameters, OfEachTheTableHasTwoValues) {
  std::map<std::string, std::set<std::uint32_t>> values;
#define SPC3_PARAMETER(name, ...) values[#name];
#include "model/spc3/parameters.inc"
  for (const char* each : {"rts_lead", "rts_trail", "search_window_ms", "search_window_bits", "fcb_rule"})
    EXPECT_EQ(values.erase(each), 1U) << each;
  for (const Row& row : kRows) values.at(row.parameter).insert(row.value);
  const spc3::Config initial;
#define SPC3_PARAMETER(name, ...) \
  if (values.count(#name) != 0) EXPECT_EQ(values[#name].count(initial.name), 1U) << #name;
#include "model/spc3/parameters.inc"
  for (const auto& [name, tested] : values) EXPECT_GE(tested.size(), 2U) << name;
}

}  // namespace
}  // namespace dsdpv1::spc3_test
