// S1, S22: the causes of leaving DATA_EXCH and of BR's fall, in synthetic captures.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/kinds/dsdpv1/claims/made_capture.hpp"

namespace dsdpv1::calibrate_test {
namespace {

const Bytes kOutputs = {1, 2};

/// A station that found its rate, with BR, READY and PBF.
class WatchedStation : public MadeCapture {
 public:
  WatchedStation() : MadeCapture(k1M5, {wire::kBr, wire::kPbf, wire::kLReq}) { find_rate(); }
  /// Set_Prm, Chk_Cfg and a data exchange; PBF falls.
  void start_up(std::uint8_t wd) {
    exchange(set_prm(kLock | (wd != 0 ? kWdOn : 0), wd), bus::make_sc());
    exchange(srd(bus::sap::kChkCfg, {0x11, 0x21}), bus::make_sc());
    set(wire::kPbf, false);
    exchange(data_exchange(kOutputs), data_answer({3, 4}));
  }
  /// So long after a decision.
  void fall_of_br(Tick decision, double ms) { at(wire::kBr, decision, ms, false); }
  void end_exchange(Tick decision, double ms) { at(wire::kPbf, decision, ms, true); }
  /// A request and its answer; the time of its decision.
  Tick decided(const Telegram& asked, const Telegram& answered) {
    request(asked);
    const Tick end = now();
    answer(answered);
    return end + static_cast<Tick>(bit()) + 7 * bus::kTicksPerCycle / 2;
  }

 private:
  void at(Wire wire, Tick decision, double ms, bool level) {
    const Tick when = decision + static_cast<Tick>(ms * bus::kTicksPerMs);
    set_at(wire, when, level);
    if (when > now()) wait_ms(static_cast<double>(when - now()) / bus::kTicksPerMs);
  }
};

void expect_600(const calibrate::Result& result) {
  EXPECT_EQ(contradicted(result), "");
  EXPECT_EQ(parameter(result, "baud_control_ms").value, 600) << parameter(result, "baud_control_ms").words;
}

TEST(CalibrateWatchdog, BrFallsAfterTheWatchdogsEndAndItsTime) {
  WatchedStation station;
  station.start_up(4);
  const Tick last = station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.end_exchange(last, 40);
  station.fall_of_br(last, 640);
  const calibrate::Result result = station.judge();
  expect_600(result);
  EXPECT_EQ(claim(result, "S1", "ends DATA_EXCH").verdict, Verdict::kConfirmed);
}

TEST(CalibrateWatchdog, UnlockEndsIt) {
  WatchedStation station;
  station.start_up(4);
  const Tick last = station.decided(set_prm(kUnlock), bus::make_sc());
  station.end_exchange(last, 0.001);
  station.fall_of_br(last, 600);
  expect_600(station.judge());
}

TEST(CalibrateWatchdog, ASetPrmThatIsTooShortEndsIt) {
  WatchedStation station;
  station.start_up(4);
  const Tick last = station.decided(srd(bus::sap::kSetPrm, {kLock, 4, 1}), bus::make_sc());
  station.end_exchange(last, 0.001);
  station.fall_of_br(last, 600);
  expect_600(station.judge());
}

TEST(CalibrateWatchdog, ASetPrmThatIsRefusedEndsItAsTheDiagnosisShows) {
  WatchedStation station;
  station.start_up(4);
  const Tick prm = station.decided(srd(bus::sap::kSetPrm, {kLock | kWdOn, 9, 1, 0, 0xBA, 0xD0, 0}), bus::make_sc());
  station.end_exchange(prm, 0.001);
  const Tick last = station.decided(srd(bus::sap::kSlaveDiag), diagnosis(0x42, 0x01));
  station.fall_of_br(last, 600);
  expect_600(station.judge());
}

TEST(CalibrateWatchdog, PrmReqCountsInADiagnosisFromMemoryToo) {
  MadeCapture capture(k1M5, {wire::kBr, wire::kLReq});
  capture.begins_high(wire::kBr);
  Telegram asked = srd(bus::sap::kSlaveDiag);
  asked.fc |= bus::fc::kFcv;
  capture.request(asked);  // before the capture there may have been the same
  const Tick end = capture.now();
  capture.decide();
  const Tick decision = capture.now();
  capture.wait_cycles(static_cast<double>(end - decision) / static_cast<double>(bus::kTicksPerCycle));
  capture.answer(diagnosis(0x02, 0x01));
  capture.set_at(wire::kBr, decision + 600 * bus::kTicksPerMs, false);
  capture.wait_ms(601);
  expect_600(capture.judge());
}

TEST(CalibrateWatchdog, ASetPrmOfAnotherMasterThatIsRefusedChangesNothing) {
  WatchedStation station;
  station.start_up(4);
  const Tick last = station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.exchange(set_prm(kLock | kWdOn, 99, 0, kOther), status(bus::fc::kRs, kOther));
  station.end_exchange(last, 40);
  station.fall_of_br(last, 640);
  const calibrate::Result result = station.judge();
  expect_600(result);
  EXPECT_EQ(claim(result, "S1", "ends DATA_EXCH").verdict, Verdict::kConfirmed);
}

TEST(CalibrateWatchdog, ARequestAfterItsEndStartsTheTimeOfBrAnew) {
  WatchedStation station;
  station.start_up(4);
  const Tick last = station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.end_exchange(last, 40);
  station.wait_ms(10);
  const Tick late = station.decided(fdl_status(), status(0));  // of who held it
  station.fall_of_br(late, 600);
  expect_600(station.judge());
}

TEST(CalibrateWatchdog, OnlyTheHolderKeepsDataExchangeAlive) {
  WatchedStation station;
  station.start_up(4);
  const Tick last = station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.wait_ms(30);
  station.decided(fdl_status(kOther), status(0, kOther));
  station.end_exchange(last, 40);
  const Tick other = station.decided(fdl_status(kOther), status(0, kOther));
  station.fall_of_br(other, 600);
  const calibrate::Result result = station.judge();
  expect_600(result);
  EXPECT_EQ(claim(result, "S1", "ends DATA_EXCH").verdict, Verdict::kConfirmed);
}

TEST(CalibrateWatchdog, AnotherMasterThatKeepsItAliveIsContradicted) {
  WatchedStation station;
  station.start_up(4);
  station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.wait_ms(30);
  const Tick other = station.decided(fdl_status(kOther), status(0, kOther));
  station.end_exchange(other, 40);
  EXPECT_EQ(claim(station.judge(), "S1", "ends DATA_EXCH").verdict, Verdict::kContradicted);
}

/// The watchdog is 20 ms, then modified by `change`; PBF rises so many ms after the last telegram.
calibrate::Result coarse_watchdog(const std::function<void(MadeCapture&)>& change, double ms) {
  MadeCapture capture(k12M, {wire::kBr, wire::kPbf});
  capture.begins_high(wire::kBr);
  const auto start = [&] {
    capture.exchange(srd(bus::sap::kChkCfg, {0x11, 0x21}), bus::make_sc());
    capture.set(wire::kPbf, false);
    capture.exchange(data_exchange(kOutputs), data_answer({3, 4}));
  };
  capture.exchange(set_prm(kLock | kWdOn, 2), bus::make_sc());
  start();
  change(capture);
  capture.set(wire::kPbf, true);
  start();
  capture.request(data_exchange(kOutputs));
  const Tick end = capture.now();
  capture.decide();
  const Tick decision = capture.now();
  capture.wait_cycles(static_cast<double>(end - decision) / static_cast<double>(bus::kTicksPerCycle));
  capture.answer(data_answer({3, 4}));
  capture.set_at(wire::kPbf, decision + static_cast<Tick>(ms * bus::kTicksPerMs), true);
  capture.wait_ms(ms);
  return capture.judge_sampled(24e6);
}

TEST(CalibrateWatchdog, OfASetPrmThatWasNotReadNothingIsSaid) {
  const auto unread = [](MadeCapture& capture) {
    capture.request_unread(set_prm(kLock | kWdOn, 4));
    capture.answer(bus::make_sc());
  };
  EXPECT_EQ(contradicted(coarse_watchdog(unread, 40)), "");
}

TEST(CalibrateWatchdog, OfASetPrmAfterARequestThatWasNotReadItCounts) {
  const auto after_unread = [](MadeCapture& capture) {
    capture.request_unread(srd(bus::sap::kSlaveDiag));
    capture.answer(diagnosis(0, 0));
    Telegram prm = set_prm(kLock | kWdOn, 4);
    prm.fc |= bus::fc::kFcv;
    capture.exchange(prm, bus::make_sc());
  };
  const calibrate::Result right = coarse_watchdog(after_unread, 40);
  EXPECT_EQ(contradicted(right), "");
  EXPECT_EQ(claim(right, "S1", "ends DATA_EXCH").verdict, Verdict::kConfirmed);
  EXPECT_EQ(claim(coarse_watchdog(after_unread, 30), "S1", "ends DATA_EXCH").verdict, Verdict::kContradicted);
}

TEST(CalibrateWatchdog, WithoutATelegramToTheStationBrFallsAfterItsRise) {
  WatchedStation station;
  const Tick rise = station.now();
  station.wait_ms(300);
  station.request(fdl_status(kMaster, kStation + 1));
  station.fall_of_br(rise, 600);
  expect_600(station.judge());
}

TEST(CalibrateWatchdog, OfWhatRanBeforeTheCaptureNothingIsSaid) {
  MadeCapture capture(k1M5, {wire::kBr});
  capture.begins_high(wire::kBr);
  capture.exchange(data_exchange(kOutputs), data_answer({3, 4}));
  capture.wait_ms(640);
  capture.set(wire::kBr, false);
  EXPECT_EQ(parameter(capture.judge(), "baud_control_ms").verdict, Verdict::kNotShown);
}

// --- what never ends ------------------------------------------------------------------------------------------------

TEST(CalibrateWatchdog, AWatchdogThatNeverEndsIsContradicted) {
  for (const bool again : {false, true}) {
    WatchedStation station;
    station.start_up(2);
    station.wait_ms(19);
    station.exchange(data_exchange(kOutputs), data_answer({3, 4}));
    EXPECT_EQ(contradicted(station.judge()), "");
    station.wait_ms(21);
    if (again) station.exchange(data_exchange(kOutputs), data_answer({3, 4}));
    EXPECT_EQ(claim(station.judge(), "S1", "ends DATA_EXCH").verdict, Verdict::kContradicted) << again;
  }
}

/// BR stays high over so much silence.
calibrate::Result silent(double ms) {
  WatchedStation station;
  station.start_up(0);
  station.wait_ms(ms);
  station.exchange(data_exchange(kOutputs), data_answer({3, 4}));
  return station.judge();
}

TEST(CalibrateWatchdog, ABrThatNeverFallsIsContradicted) {
  EXPECT_EQ(parameter(silent(599), "baud_control_ms").verdict, Verdict::kNotShown);
  const calibrate::Result never = silent(5000.2);
  EXPECT_EQ(parameter(never, "baud_control_ms").verdict, Verdict::kContradicted);
  EXPECT_EQ(parameter(never, "baud_control_ms").words, "at least 5001");
  EXPECT_EQ(parameter(never, "baud_control_ms").chosen, 5001);
}

TEST(CalibrateWatchdog, ABrThatFallsSometimesIsContradicted) {
  WatchedStation station;
  station.start_up(0);
  station.wait_ms(700);
  const Tick last = station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.fall_of_br(last, 600);
  EXPECT_EQ(claim(station.judge(), "S1", "BR falls").verdict, Verdict::kContradicted);
}

TEST(CalibrateWatchdog, WithoutPbtxdNothingIsSaidOfBr) {
  MadeCapture capture(k1M5, {wire::kBr});
  capture.hide(wire::kPbtxd);
  capture.find_rate();
  for (int i = 0; i < 8; ++i) {
    capture.request(data_exchange(kOutputs));
    capture.wait_ms(100);
  }
  EXPECT_EQ(parameter(capture.judge(), "baud_control_ms").verdict, Verdict::kNotShown);
}

// --- a reset that the capture does not show otherwise ----------------------------------------------------------------

/// PBF rises and BR falls in a reset 30 ms after the last telegram, of a station whose watchdog is 40 ms.
calibrate::Result reset_after_30_ms(const std::vector<Wire>& pins, bool start_up) {
  const auto has = [&](Wire wire) { return std::find(pins.begin(), pins.end(), wire) != pins.end(); };
  MadeCapture capture(k1M5, pins);
  for (const Wire wire : {wire::kBr, wire::kReady})
    if (has(wire)) capture.begins_high(wire);
  capture.exchange(set_prm(kLock | kWdOn, 4), bus::make_sc());
  capture.exchange(srd(bus::sap::kChkCfg, {0x11, 0x21}), bus::make_sc());
  capture.set(wire::kPbf, false);
  capture.exchange(data_exchange(kOutputs), data_answer({3, 4}));
  capture.wait_ms(30);
  if (has(wire::kLReq)) capture.pulse(wire::kLReq, 7 * bus::kTicksPerCycle);
  capture.wait_cycles(20);
  capture.set(wire::kPbf, true);
  for (const Wire wire : {wire::kBr, wire::kReady})
    if (has(wire)) capture.set(wire, false);
  capture.wait_ms(5);
  if (has(wire::kLReq)) capture.pulse(wire::kLReq, (start_up ? 2054 : 7) * bus::kTicksPerCycle);
  capture.wait_ms(1);
  return capture.judge();
}

TEST(CalibrateWatchdog, AResetMayShowInReadyOrInAStartUpAlone) {
  for (const std::vector<Wire>& pins :
       {std::vector<Wire>{wire::kPbf, wire::kLReq}, {wire::kPbf, wire::kBr, wire::kLReq}}) {
    EXPECT_EQ(contradicted(reset_after_30_ms(pins, true)), "") << pins.size();
    EXPECT_NE(contradicted(reset_after_30_ms(pins, false)), "") << pins.size();
  }
  EXPECT_EQ(contradicted(reset_after_30_ms({wire::kPbf, wire::kReady, wire::kLReq}, false)), "");
}

/// BR falls so long after the last telegram, in an access of so many cycles; PBF is not in the capture.
calibrate::Result after(double ms, double access) {
  WatchedStation station;
  station.start_up(0);
  const Tick last = station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.wait_ms(100);
  station.pulse(wire::kLReq, 7 * bus::kTicksPerCycle);
  station.fall_of_br(last, ms);
  station.set_at(wire::kLReq, station.now() - 5 * bus::kTicksPerCycle, true);
  station.set_at(wire::kLReq, station.now() + static_cast<Tick>((access - 5) * bus::kTicksPerCycle), false);
  station.wait_ms(1);
  station.hide(wire::kPbf);
  return station.judge();
}

TEST(CalibrateWatchdog, AFallOfBrThatIsNoWholeNumberOfMsIsContradicted) {
  const calibrate::Result result = after(600.4, 7);
  EXPECT_EQ(claim(result, "S1", "BR falls").verdict, Verdict::kContradicted);
  EXPECT_NE(contradicted(result).find("600.400 ms"), std::string::npos) << contradicted(result);
}

TEST(CalibrateWatchdog, AnInitialisationAWholeNumberOfMsAfterTheLastTelegramIsNoMeasure) {
  const calibrate::Result result = after(112, 60);
  EXPECT_EQ(contradicted(result), "");
  EXPECT_EQ(parameter(result, "baud_control_ms").verdict, Verdict::kNotShown);
  EXPECT_NE(parameter(result, "baud_control_ms").words.find("new initialisation"), std::string::npos);
}

/// A new initialisation 12 ms after the last telegram, then a fall 600 ms after it.
calibrate::Result initialised_and_silent(const std::vector<Wire>& pins) {
  MadeCapture capture(k1M5, pins);
  capture.find_rate();
  for (const double ms : {12.0, 600.0}) {
    capture.request(fdl_status());
    const Tick end = capture.now();
    capture.answer(status(0));
    const Tick fall = end + static_cast<Tick>(capture.bit() + 3.5 * bus::kTicksPerCycle + ms * bus::kTicksPerMs);
    if (pins.size() > 1) {
      capture.set_at(wire::kLReq, fall - 5 * bus::kTicksPerCycle, true);
      capture.set_at(wire::kLReq, fall + (ms > 100 ? 2 : 50) * bus::kTicksPerCycle, false);
    }
    capture.set_at(wire::kBr, fall, false);
    capture.wait_ms(ms + 1);
    if (ms < 100) capture.find_rate();
  }
  return capture.judge();
}

TEST(CalibrateWatchdog, AnInitialisationIsNotTakenForTheEndOfBaudControl) {
  expect_600(initialised_and_silent({wire::kBr, wire::kLReq}));
  expect_600(initialised_and_silent({wire::kBr}));
}

/// BR falls so long after the last telegram to a station in DATA_EXCH. PBF is not in the capture, rises with BR or
/// stays low.
enum class Pbf : std::uint8_t { kHidden, kRises, kStays };
calibrate::ParameterResult single_fall(double ms, Pbf pbf) {
  WatchedStation station;
  station.start_up(0);
  const Tick last = station.decided(data_exchange(kOutputs), data_answer({3, 4}));
  station.fall_of_br(last, ms);
  if (pbf == Pbf::kRises) station.end_exchange(last, ms);
  if (pbf == Pbf::kHidden) station.hide(wire::kPbf);
  station.hide(wire::kLReq);
  const calibrate::Result result = station.judge();
  EXPECT_EQ(contradicted(result), "") << ms;
  return parameter(result, "baud_control_ms");
}

TEST(CalibrateWatchdog, OneFallOfBrThatMayBeAnInitialisationIsOnlyALowerBound) {
  EXPECT_EQ(single_fall(12, Pbf::kHidden).verdict, Verdict::kNotContradicted);
  EXPECT_EQ(single_fall(12, Pbf::kHidden).words, "at least 12");
  EXPECT_EQ(single_fall(700, Pbf::kHidden).verdict, Verdict::kContradicted);
  EXPECT_EQ(single_fall(600, Pbf::kHidden).value, 600);
}

TEST(CalibrateWatchdog, PbfTellsAnInitialisationFromTheEndOfBaudControl) {
  EXPECT_EQ(single_fall(12, Pbf::kRises).verdict, Verdict::kNotShown);
  EXPECT_NE(single_fall(12, Pbf::kRises).words.find("new initialisation"), std::string::npos);
  EXPECT_EQ(single_fall(12, Pbf::kStays).verdict, Verdict::kContradicted);
  EXPECT_EQ(single_fall(12, Pbf::kStays).value, 12);
}

TEST(CalibrateWatchdog, AFallOfBrInALongAccessMayBeAnInitialisation) {
  const calibrate::Result result = after(600.4, 40);
  EXPECT_EQ(claim(result, "S1", "BR falls").verdict, Verdict::kNotShown);
  EXPECT_NE(parameter(result, "baud_control_ms").words.find("no whole number of ms"), std::string::npos);
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
