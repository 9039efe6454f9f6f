// A DP slave on a made-up store, without DPV1: its decisions from the store's answers alone, and the calls that a
// telegram costs.
#include "model/profibus/slave_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "model/profibus/dp_slave.hpp"
#include "tests/core/event_recorder.hpp"

namespace dsdpv1::profibus {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kStation = 5, kHolder = 1, kOther = 2;
constexpr std::uint16_t kIdentNumber = 0x1234;

/// Answers as the test has set it, and keeps the arguments of its calls.
class MadeUp final : public SlaveStore {
 public:
  Take prm = Take::kAccepted, cfg = Take::kAccepted, ssa = Take::kAccepted;
  IoLengths lengths = {2, 3};
  bool high = false, leaves = false, room = true, buffers = true;
  Bytes inputs = {0xA1, 0xA2}, outputs = {1, 2, 3}, stored_cfg = {0x11, 0x22}, user_diag;
  StoredDiagnosis shown;

  int calls = 0;
  bool fail_safe = false, exchanging = false, right = false, to_holder = false;
  Bytes got;
  Control controlled;
  std::vector<DpState> states;
  std::vector<bool> left_by_watchdog;
  std::array<std::uint8_t, 6> standard{};

 private:
  View view(const Bytes& bytes) const {
    return {bytes.data(), buffers ? static_cast<int>(bytes.size()) : View::kNoBuffer};
  }
  void take(const Request& request) {
    ++calls;
    got.assign(request.data, request.data + request.size);
  }
  Exchanged exchange(Cycle /*now*/, const Request& request, bool may_clear) override {
    take(request);
    fail_safe = may_clear;
    return {request.size == lengths.output, lengths.output, high, view(inputs), leaves};
  }
  bool has_room(Cycle /*now*/, const Request& /*request*/) override { return room; }
  void left(Cycle /*now*/, bool by_watchdog) override { left_by_watchdog.push_back(by_watchdog); }
  Take parameters(Cycle /*now*/, const Request& request) override {
    take(request);
    return prm;
  }
  Take configuration(Cycle /*now*/, const Request& request, bool in_exchange) override {
    take(request);
    exchanging = in_exchange;
    return cfg;
  }
  IoLengths configured() override { return lengths; }
  Take address(Cycle /*now*/, const Request& request, bool is_right) override {
    take(request);
    right = is_right;
    return ssa;
  }
  void control(Cycle /*now*/, const Control& control) override {
    ++calls;
    controlled = control;
  }
  View read_inputs(Cycle /*now*/) override {
    ++calls;
    return view(inputs);
  }
  View read_outputs(Cycle /*now*/) override {
    ++calls;
    return view(outputs);
  }
  View read_cfg(Cycle /*now*/, bool in_exchange) override {
    ++calls;
    exchanging = in_exchange;
    return view(stored_cfg);
  }
  StoredDiagnosis diagnosis(Cycle /*now*/, bool by_holder) override {
    ++calls;
    to_holder = by_holder;
    shown.user = view(user_diag);
    shown.standard = standard.data();
    return shown;
  }
  void entered(Cycle /*now*/, DpState from, DpState to) override {
    if (states.empty()) states.push_back(from);
    EXPECT_EQ(states.back(), from);
    states.push_back(to);
  }
  void baud(Cycle /*now*/, BaudIndex /*index*/) override {}
};

class SlaveStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    SlaveConfig config;
    config.address = kStation;
    config.ident = kIdentNumber;
    config.address_change = config.sync_supported = config.freeze_supported = config.fail_safe_supported = true;
    watchdog.rate_found(1);
    slave.start(1, config);
  }

  Reply send(int dsap, const Bytes& data, std::uint8_t sa = kHolder, std::uint8_t code = fc::kSrdHigh) {
    Request request;
    request.da = kStation;
    request.sa = sa;
    request.code = code;
    request.dsap = dsap;
    request.data = data.data();
    request.size = static_cast<int>(data.size());
    return slave.handle(++now, request);
  }
  /// Lock_Req, Sync_Req and Freeze_Req; `user` begins with the Spec_User_Prm_Byte.
  Reply set_prm(const Bytes& user = {0}, std::uint8_t min_tsdr = 0) {
    Bytes data = {0xB0, 0, 0, min_tsdr, kIdentNumber >> 8, kIdentNumber & 0xFF, 0x01};
    data.insert(data.end(), user.begin(), user.end());
    return send(sap::kSetPrm, data);
  }
  Reply check_cfg() { return send(sap::kCheckCfg, {0x11, 0x22}); }
  void to_exchange() {
    set_prm();
    check_cfg();
    ASSERT_EQ(slave.state(), DpState::kDataExch);
  }
  /// Station status 1, or 2.
  unsigned status(int number) {
    const Reply reply = send(sap::kSlaveDiag, {}, kOther);
    return reply.size < 6 ? 0x100 : reply.data[number - 1];
  }
  static void expect(const Reply& reply, Reply::Kind kind, std::uint8_t code = 0) {
    EXPECT_EQ(reply.kind, kind);
    EXPECT_EQ(reply.code, code);
  }
  static void expect_sc(const Reply& reply) { expect(reply, Reply::Kind::kShort); }
  static void expect_rr(const Reply& reply) { expect(reply, Reply::Kind::kSd1, fc::kRr); }
  static void expect_rs(const Reply& reply) { expect(reply, Reply::Kind::kSd1, fc::kRs); }

  static constexpr unsigned kNotReady = 0x02, kCfgFault = 0x04, kPrmFault = 0x40;             // status 1
  static constexpr unsigned kPrmReq = 0x01, kAlwaysOne = 0x04, kFreeze = 0x10, kSync = 0x20;  // status 2

  core_test::EventRecorder recorder;
  Watchdog watchdog{600 * kCyclesPerMs};
  MadeUp store;
  SlaveRules rules;
  DpSlave slave{recorder.log, watchdog, store, nullptr, rules};
  Cycle now = 1;
};

TEST_F(SlaveStoreTest, ATelegramIsOneCall) {
  const auto calls = [this](const auto& telegram) {
    store.calls = 0;
    telegram();
    return store.calls;
  };
  EXPECT_EQ(calls([&] { send(sap::kSetSlaveAddress, {kStation, kIdentNumber >> 8, kIdentNumber & 0xFF, 0}); }), 1);
  EXPECT_EQ(calls([&] { set_prm(); }), 1);
  EXPECT_EQ(calls([&] { check_cfg(); }), 1);
  EXPECT_EQ(calls([&] { send(kNoSap, {1, 2, 3}); }), 1);
  EXPECT_EQ(calls([&] { send(sap::kGlobalControl, {0x2A, 0}, kHolder, fc::kSdnHigh); }), 1);
  for (const int dsap : {sap::kReadInputs, sap::kReadOutputs, sap::kGetCfg, sap::kSlaveDiag})
    EXPECT_EQ(calls([&] { send(dsap, {}); }), 1) << dsap;
  EXPECT_EQ(calls([&] { send(kNoSap, {1, 2, 3}, kOther); }), 0) << "refused without the store";
}

TEST_F(SlaveStoreTest, RefusedParametersArePrmFault) {
  to_exchange();
  store.prm = Take::kRefused;
  expect_sc(set_prm());
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
  EXPECT_EQ(slave.master(), kNoMaster);
  EXPECT_EQ(status(1), kPrmFault | kNotReady);
  EXPECT_EQ(status(2), kAlwaysOne | kPrmReq);
}

TEST_F(SlaveStoreTest, BlocksWithoutRoomAreRrAndChangeNothing) {
  store.ssa = store.prm = Take::kNoRoom;
  expect_rr(send(sap::kSetSlaveAddress, {77, kIdentNumber >> 8, kIdentNumber & 0xFF, 0}));
  EXPECT_EQ(slave.address(), kStation);
  expect_rr(set_prm());
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
  store.prm = Take::kAccepted;
  to_exchange();
  store.prm = store.cfg = Take::kNoRoom;
  expect_rr(set_prm());
  expect_rr(check_cfg());
  EXPECT_EQ(slave.state(), DpState::kDataExch);
  EXPECT_EQ(slave.master(), kHolder);
  EXPECT_EQ(status(1), 0U);
}

TEST_F(SlaveStoreTest, RoomForParametersIsAskedBeforeTheyAreJudged) {
  to_exchange();
  store.room = false;
  expect_rr(send(sap::kSetPrm, {0xB0}));
  EXPECT_EQ(slave.state(), DpState::kDataExch);
  EXPECT_EQ(status(1), 0U);
}

TEST_F(SlaveStoreTest, WithoutABufferTheAnswerIsRr) {
  to_exchange();
  store.buffers = false;
  for (const int dsap : {kNoSap, sap::kReadInputs, sap::kReadOutputs, sap::kGetCfg, sap::kSlaveDiag})
    expect_rr(send(dsap, dsap == kNoSap ? Bytes{1, 2, 3} : Bytes{}));
  EXPECT_EQ(slave.state(), DpState::kDataExch);
}

TEST_F(SlaveStoreTest, TheStoreIsToldOfEachMasterThatIsGivenUp) {
  send(sap::kSetPrm, {0x40, 0, 0, 0, kIdentNumber >> 8, kIdentNumber & 0xFF, 0});
  EXPECT_EQ(store.left_by_watchdog, std::vector<bool>{false}) << "also in WAIT_PRM";
  to_exchange();
  slave.watchdog_expired(++now);
  EXPECT_EQ(store.left_by_watchdog, (std::vector<bool>{false, true}));
  to_exchange();
  slave.leave_master(++now);
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
  EXPECT_EQ(slave.master(), kNoMaster);
  EXPECT_EQ(store.left_by_watchdog, (std::vector<bool>{false, true, false}));
}

TEST_F(SlaveStoreTest, AStoreMayGiveUpTheMasterAfterItsAnswer) {
  to_exchange();
  store.leaves = true;
  expect(send(kNoSap, {7, 8, 9}), Reply::Kind::kData, fc::kDl);
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
}

TEST_F(SlaveStoreTest, WithoutDpv1StatusByte7IsNotChecked) {
  rules.dpv1_status = false;
  expect_sc(set_prm({0xFF, 0, 0}));
  EXPECT_EQ(slave.state(), DpState::kWaitCfg);
  EXPECT_EQ(status(1), kNotReady);
  check_cfg();
  send(kNoSap, {});
  EXPECT_TRUE(store.fail_safe) << "the store may use it";
}

TEST_F(SlaveStoreTest, ParametersInForceMayBeRefused) {
  set_prm();
  slave.refuse_prm(++now);
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
  EXPECT_EQ(status(1), kPrmFault | kNotReady);
}

TEST_F(SlaveStoreTest, WithoutSapsOnlyTheFdlStatusIsAnswered) {
  rules.has_saps = false;
  expect(send(kNoSap, {}, kHolder, fc::kFdlStatus), Reply::Kind::kSd1, fc::kOk);
  expect(send(sap::kSlaveDiag, {}), Reply::Kind::kNothing);
  expect(set_prm(), Reply::Kind::kNothing);
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
}

TEST_F(SlaveStoreTest, ReservedBitsOfAControlAreARule) {
  to_exchange();
  const Bytes control = {0xC3, 0};
  send(sap::kGlobalControl, control, kHolder, fc::kSdnHigh);
  EXPECT_EQ(store.controlled.command, 0);
  rules.control_reserved = 0;
  send(sap::kGlobalControl, control, kHolder, fc::kSdnHigh);
  EXPECT_EQ(store.controlled.command, 0xC3);
}

TEST_F(SlaveStoreTest, AnAddressMayCarryMoreBytesThanFour) {
  Bytes data = {77, kIdentNumber >> 8, kIdentNumber & 0xFF, 0};
  data.resize(244, 0xCC);
  expect_sc(send(sap::kSetSlaveAddress, data));
  EXPECT_EQ(store.got, data);
  EXPECT_TRUE(store.right);
  EXPECT_EQ(slave.address(), 77);
  data[1] ^= 1U;
  expect_sc(send(sap::kSetSlaveAddress, data));
  EXPECT_FALSE(store.right) << "another ident number";
  EXPECT_EQ(slave.address(), 77);
}

// The bytes of the second wait in the store until its user has given up the first; only then it is the slave's turn.
TEST_F(SlaveStoreTest, AVerdictIsOnTheLatestParameters) {
  store.prm = Take::kAwaited;
  expect_sc(set_prm({0, 1}, 20));
  expect_sc(set_prm({0, 2}, 30));
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
  EXPECT_EQ(status(2), kAlwaysOne) << "no Prm_Req while the user judges";
  EXPECT_EQ(slave.min_tsdr(), kMinTsdr) << "nothing is in force";
  slave.prm_verdict(++now, true);
  EXPECT_EQ(slave.state(), DpState::kWaitCfg);
  EXPECT_EQ(slave.min_tsdr(), 30);
  slave.prm_verdict(++now, false);
  EXPECT_EQ(recorder.count(Reason::kVerdictUnexpected), 1) << "a late answer to the first";
  EXPECT_EQ(slave.state(), DpState::kWaitCfg);
}

TEST_F(SlaveStoreTest, NewParametersDropAConfigurationThatIsJudged) {
  set_prm();
  store.cfg = Take::kAwaited;
  for (const auto& [take, state] :
       {std::pair(Take::kAccepted, DpState::kWaitCfg), {Take::kAwaited, DpState::kWaitPrm}}) {
    expect_sc(check_cfg());
    store.prm = take;
    set_prm();
    recorder.events.clear();
    slave.cfg_verdict(++now, true);
    EXPECT_EQ(recorder.count(Reason::kVerdictUnexpected), 1);
    EXPECT_EQ(slave.state(), state);
  }
}

// A store may keep back the user's verdict, such as until there are inputs.
TEST_F(SlaveStoreTest, ALateVerdictOnTheConfigurationBeginsTheExchange) {
  set_prm();
  store.cfg = Take::kAwaited;
  check_cfg();
  store.lengths = {0, 1};
  expect_rs(send(kNoSap, {1, 2, 3}));
  slave.cfg_verdict(now += kCyclesPerMs, true);
  EXPECT_EQ(slave.state(), DpState::kDataExch);
  ASSERT_EQ(recorder.count(Reason::kCfgAccepted), 1);
  store.inputs.clear();
  expect_sc(send(kNoSap, {1}));
}

TEST_F(SlaveStoreTest, AConfigurationDuringTheExchangeMayAwaitItsVerdict) {
  to_exchange();
  store.cfg = Take::kAwaited;
  expect_sc(check_cfg());
  EXPECT_TRUE(store.exchanging);
  EXPECT_EQ(slave.state(), DpState::kDataExch);
  slave.cfg_verdict(++now, true);
  expect(send(kNoSap, {1, 2, 3}), Reply::Kind::kData, fc::kDl);
  check_cfg();
  slave.cfg_verdict(++now, false);
  EXPECT_EQ(slave.state(), DpState::kWaitPrm);
  EXPECT_EQ(status(1), kCfgFault | kNotReady);
}

TEST_F(SlaveStoreTest, AnAcceptedConfigurationDuringTheExchangeChangesNothing) {
  to_exchange();
  recorder.events.clear();
  expect_sc(check_cfg());
  EXPECT_TRUE(recorder.events.empty());
  EXPECT_EQ(slave.state(), DpState::kDataExch);
}

TEST_F(SlaveStoreTest, RefusedConfigurationIsCfgFaultAlsoDuringTheExchange) {
  for (const bool exchanging : {false, true}) {
    store.cfg = Take::kAccepted;
    exchanging ? to_exchange() : void(set_prm());
    store.cfg = Take::kRefused;
    expect_sc(check_cfg());
    EXPECT_EQ(store.exchanging, exchanging);
    EXPECT_EQ(slave.state(), DpState::kWaitPrm);
    EXPECT_EQ(status(1), kCfgFault | kNotReady);
  }
}

TEST_F(SlaveStoreTest, OutputsOfAnotherLengthEndTheExchange) {
  to_exchange();
  expect_rr(send(kNoSap, {1, 2}));
  ASSERT_EQ(recorder.count(Reason::kOutputLength), 1);
  EXPECT_EQ(recorder.events.back().reason, Reason::kDpState);
  EXPECT_EQ(status(1), kCfgFault | kNotReady);
  EXPECT_EQ(store.states, (std::vector<DpState>{DpState::kOffline, DpState::kWaitPrm, DpState::kWaitCfg,
                                                DpState::kDataExch, DpState::kWaitPrm}));
}

TEST_F(SlaveStoreTest, TheAnswerHasTheStoresInputsAndPriority) {
  to_exchange();
  const Reply low = send(kNoSap, {7, 8, 9});
  expect(low, Reply::Kind::kData, fc::kDl);
  EXPECT_EQ(Bytes(low.data, low.data + low.size), store.inputs);
  EXPECT_EQ(store.got, (Bytes{7, 8, 9}));
  EXPECT_FALSE(store.fail_safe);
  store.high = true;
  expect(send(kNoSap, {7, 8, 9}), Reply::Kind::kData, fc::kDh);
  store.inputs.clear();
  expect(send(kNoSap, {7, 8, 9}), Reply::Kind::kSd1, fc::kDh);
  set_prm({0x40});  // Fail_Safe
  check_cfg();
  send(kNoSap, {7, 8, 9});
  EXPECT_TRUE(store.fail_safe);
}

TEST_F(SlaveStoreTest, GlobalControlReachesTheStoreAsItIsCarriedOut) {
  to_exchange();
  const auto control = [this](unsigned command, unsigned group = 0) {
    store.controlled = Control();
    send(sap::kGlobalControl, {static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(group)}, kHolder,
         fc::kSdnHigh);
    return store.controlled;
  };
  const Control sync = control(0x20);
  EXPECT_EQ(sync.outputs, Gate::kCloses);
  EXPECT_EQ(sync.command, 0x20);
  EXPECT_FALSE(sync.clears);
  EXPECT_EQ(control(0x30).outputs, Gate::kOpens) << "Unsync goes before Sync";
  EXPECT_EQ(control(0x08).inputs, Gate::kCloses);
  EXPECT_EQ(control(0x0C).inputs, Gate::kOpens);
  EXPECT_EQ(control(0x28).outputs, Gate::kCloses);
  const Control clear = control(0x02, 0x01);
  EXPECT_TRUE(clear.clears);
  EXPECT_EQ(clear.outputs, Gate::kStays);
  EXPECT_EQ(clear.inputs, Gate::kStays);
  EXPECT_EQ(clear.master, kHolder);
  EXPECT_EQ(control(0x02, 0x02).command, 0) << "another group";
}

TEST_F(SlaveStoreTest, ReadServicesHaveTheStoresBytes) {
  const auto read = [this](int dsap) {
    const Reply reply = send(dsap, {}, kOther);
    return Bytes(reply.data, reply.data + reply.size);
  };
  EXPECT_EQ(read(sap::kGetCfg), store.stored_cfg);
  EXPECT_FALSE(store.exchanging);
  to_exchange();
  EXPECT_EQ(read(sap::kGetCfg), store.stored_cfg);
  EXPECT_TRUE(store.exchanging);
  EXPECT_EQ(read(sap::kReadInputs), store.inputs);
  EXPECT_EQ(read(sap::kReadOutputs), store.outputs);
  store.outputs.clear();
  expect_sc(send(sap::kReadOutputs, {}));
}

TEST_F(SlaveStoreTest, DiagnosisIsTheSlavesSixBytesAndTheStores) {
  to_exchange();
  store.user_diag = {2, 0xEE};
  store.shown.ext_diag = store.shown.sync = true;
  const Reply reply = send(sap::kSlaveDiag, {});
  ASSERT_EQ(reply.size, 8);
  EXPECT_EQ(Bytes(reply.data, reply.data + 8),
            (Bytes{0x08, kAlwaysOne | kSync, 0, kHolder, kIdentNumber >> 8, kIdentNumber & 0xFF, 2, 0xEE}));
  EXPECT_TRUE(store.to_holder);
  EXPECT_TRUE(std::equal(store.standard.begin(), store.standard.end(), reply.data));
  store.shown = {};
  store.shown.overflow = true;
  EXPECT_EQ(send(sap::kSlaveDiag, {}).data[2], 0x80);
  store.shown = {};
  store.shown.stat_diag = store.shown.freeze = true;
  EXPECT_EQ(status(2), kAlwaysOne | kFreeze | 0x02);
  EXPECT_FALSE(store.to_holder);
}

TEST_F(SlaveStoreTest, WithoutDpv1ItsSapsAreRsAndNoTimerRuns) {
  for (const bool exchanging : {false, true}) {
    if (exchanging) to_exchange();
    for (const int dsap : {51, 49, 48, 47}) expect_rs(send(dsap, {}));
  }
  expect(send(48, {dpv1::kAbort, 0, 0}, kHolder, fc::kSdnHigh), Reply::Kind::kNothing);
  EXPECT_EQ(slave.next_timer(), kNever);
  slave.eval_timers(++now);
  EXPECT_EQ(slave.state(), DpState::kDataExch);
}

}  // namespace
}  // namespace dsdpv1::profibus
