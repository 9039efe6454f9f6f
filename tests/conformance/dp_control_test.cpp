// Global_Control: all commands from all states of sync and freeze against a model of the buffers of figure 8; groups
// (S4, S18, S24, S27).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr int kClear = 0x02, kUnfreeze = 0x04, kFreeze = 0x08, kUnsync = 0x10, kSync = 0x20, kReserved = 0xC1;

/// The buffers of figure 8 as S4, S24 and S27 describe them.
struct Buffers {
  Bytes out1 = {0, 0}, out2 = {0, 0}, in1 = {0, 0}, in2 = {0, 0};
  bool sync = false, freeze = false;

  void outputs(const Bytes& bytes) {
    out1 = bytes;
    if (!sync) out2 = bytes;
  }
  void inputs(const Bytes& bytes) {
    in1 = bytes;
    if (!freeze) in2 = bytes;
  }
  void command(int command) {
    if ((command & kReserved) != 0) return;
    if ((command & kClear) != 0) out1 = out2 = {0, 0};
    if ((command & (kSync | kUnsync)) != 0) {
      out2 = out1;
      sync = (command & kUnsync) == 0;
    }
    if ((command & (kFreeze | kUnfreeze)) != 0) {
      in2 = in1;
      freeze = (command & kUnfreeze) == 0;
    }
  }
};

class GlobalControl : public testing::Test {
 protected:
  static Prm prm(int status = 0xB0, int group = 0) {
    Prm prm;
    prm.status = static_cast<std::uint8_t>(status);
    prm.group = static_cast<std::uint8_t>(group);
    return prm;
  }
  void start(const Prm& parameters) { bench.to_data_exch({}, parameters); }
  void control(int command, int group = 0, std::uint8_t master = 2) {
    tell(bench, bus::kBroadcast, 58, {static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(group)}, master);
    model.command(command);
  }
  Bytes fresh() {
    ++next_;
    return {static_cast<std::uint8_t>(next_ >> 8), static_cast<std::uint8_t>(next_ & 0xFF)};
  }
  void exchange() {
    const Bytes outputs = fresh();
    model.outputs(outputs);
    EXPECT_EQ(ask(bench, kNoSap, outputs).answer().data, model.in2);
  }
  void give() {
    const Bytes inputs = fresh();
    model.inputs(inputs);
    bench.give_inputs(inputs);
  }
  void expect_model(const std::string& what) {
    SCOPED_TRACE(what);
    EXPECT_EQ(ask(bench, 56).answer().data, model.in2) << "Read_Inputs";
    EXPECT_EQ(ask(bench, 57).answer().data, model.out2) << "Read_Outputs";
    settle(bench);
    EXPECT_EQ(output_area(bench), model.out2) << "the user";
    EXPECT_EQ(diag(bench).at(1), 0x04 | (model.freeze ? 0x10 : 0) | (model.sync ? 0x20 : 0));
  }

  SlaveBench bench{quick_search()};
  Buffers model;
  int next_ = 0x0100;
};

/// All 256 command bytes in one of the four states.
class EveryCommand : public GlobalControl, public testing::WithParamInterface<int> {};

TEST_P(EveryCommand, MovesTheBuffersAsFigureEightShows) {
  start(prm());
  const bool sync = (GetParam() & 1) != 0, freeze = (GetParam() & 2) != 0;
  for (int command = 0; command < 256; ++command) {
    control((sync ? kSync : kUnsync) | (freeze ? kFreeze : kUnfreeze));
    give();
    exchange();
    expect_model("before " + std::to_string(command));
    control(command);
    expect_model("command " + std::to_string(command));
    give();
    exchange();
    expect_model("data behind command " + std::to_string(command));
    ASSERT_FALSE(HasFailure()) << "command " << command;
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  settle(bench);
  EXPECT_EQ(offline_count(bench), 0);
}

INSTANTIATE_TEST_SUITE_P(States, EveryCommand, testing::Range(0, 4), [](const auto& at) {
  return std::string((at.param & 1) != 0 ? "Sync" : "Unsync") + ((at.param & 2) != 0 ? "Freeze" : "Unfreeze");
});

TEST_F(GlobalControl, SyncHandsTheOutputsToTheUserOnceACommand) {
  start(prm());
  exchange();
  settle(bench);
  bench.fetch_outputs();
  control(kSync);
  settle(bench);
  bench.fetch_outputs();
  exchange();
  exchange();
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), std::nullopt) << "held back in sync";
  control(kSync);
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), model.out1);
  exchange();
  control(kUnsync);
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), model.out1);
  exchange();
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), model.out1);
}

TEST_F(GlobalControl, OutputsOfASyncThatTheUserKeepsWaitingAreThoseOfTheCommand) {
  start(prm());
  control(kSync);
  settle(bench);
  exchange();
  bench.acquire();
  control(kSync);
  const auto commanded = model.out1;
  exchange();
  bench.release();
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), commanded);
}

TEST_F(GlobalControl, UnsyncWithoutSyncTellsTheUserNothing) {
  start(prm());
  bench.data_exchange({1, 2});
  bench.chip_accesses();
  ASSERT_TRUE(bench.fetch_outputs());
  control(0x10);
  bench.chip_accesses(3);
  EXPECT_EQ(bench.fetch_outputs(), std::nullopt);
}

TEST_F(GlobalControl, ClearTellsTheUserAndLeavesTheStateAndTheCountAlone) {
  start(prm());
  exchange();
  settle(bench);
  bench.fetch_outputs();
  control(kClear);
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0}));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(offline_count(bench), 0);
  EXPECT_EQ(bench.chip.status().master, 2);
}

TEST_F(GlobalControl, WithReservedBitsIsIgnoredWithAReason) {
  start(prm());
  exchange();
  for (const int command : {0x01, 0x40, 0x80, 0xC1, 0x22 | 0x01, 0xFF}) {
    const int before = bench.count(Reason::kGcIgnored);
    control(command);
    EXPECT_EQ(bench.count(Reason::kGcIgnored), before + 1) << command;
  }
  expect_model("all ignored");
}

TEST_F(GlobalControl, OfAnotherLengthIsIgnoredWithAReason) {
  start(prm());
  exchange();
  for (const Bytes& bytes : {Bytes{}, {kClear}, {kClear, 0, 0}, {kSync, 0, 0, 0}})
    tell(bench, bus::kBroadcast, 58, bytes);
  EXPECT_EQ(bench.count(Reason::kGcIgnored), 4);
  expect_model("all ignored");
}

TEST_F(GlobalControl, WithoutTheRequestInSetPrmSyncAndFreezeAreIgnoredTheRestIsExecuted) {
  for (const int status : {0x80, 0xA0, 0x90, 0xB0}) {
    const bool sync = (status & 0x20) != 0, freeze = (status & 0x10) != 0;
    SlaveBench one(quick_search());
    one.to_data_exch({}, prm(status));
    ask(one, kNoSap, {1, 2});
    tell(one, bus::kBroadcast, 58, {kSync | kFreeze | kClear, 0});
    EXPECT_EQ(diag(one).at(1), 0x04 | (freeze ? 0x10 : 0) | (sync ? 0x20 : 0)) << status;
    EXPECT_EQ(one.count(Reason::kGcSync), sync ? 0 : 1);
    EXPECT_EQ(one.count(Reason::kGcFreeze), freeze ? 0 : 1);
    EXPECT_EQ(ask(one, 57).answer().data, (Bytes{0, 0})) << "Clear_Data";
  }
}

// S31: there is no bit of B024 for SAP 58 as a whole.
TEST_F(GlobalControl, WithB024ZeroClearsAndNeitherSyncsNorFreezes) {
  Init init;
  init.command = 0x00;
  bench.to_data_exch(init, prm(0x80));
  give();
  ask(bench, kNoSap, {1, 2});
  tell(bench, bus::kBroadcast, 58, {kSync | kFreeze | kClear, 0});
  EXPECT_EQ(bench.count(Reason::kGlobalControl), 1);
  EXPECT_EQ(bench.count(Reason::kGcSync), 1);
  EXPECT_EQ(bench.count(Reason::kGcFreeze), 1);
  EXPECT_EQ(bench.count(Reason::kGcIgnored), 0);
  EXPECT_EQ(diag(bench).at(1) & 0x30, 0) << "neither frozen nor synced";
  EXPECT_EQ(diag(bench).at(0), 0x10) << "Not_Supported (S24)";
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{0, 0})) << "Clear_Data";
  tell(bench, bus::kBroadcast, 58, {kUnsync | kUnfreeze, 0});
  EXPECT_EQ(bench.count(Reason::kGlobalControl), 2);
  give();
  EXPECT_EQ(ask(bench, kNoSap, {3, 4}).answer().data, model.in1) << "inputs go on";
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{3, 4})) << "outputs go on";
}

// S24: the diagnosis reports functions that B024 does not support, until the next good Set_Prm.
TEST_F(GlobalControl, SyncOrFreezeThatIsNotSupportedSetsNotSupported) {
  struct Case {
    int b024, command, group;
    bool not_supported;
  };
  const Case cases[] = {
      {0x00, kSync, 0, true},
      {0x00, kFreeze, 0, true},
      {0x02, kSync, 0, true},
      {0x04, kFreeze, 0, true},
      {0x04, kSync, 0, false},
      {0x02, kFreeze, 0, false},
      {0x00, kSync | kUnsync, 0, false},
      {0x00, kFreeze | kUnfreeze, 0, false},
      {0x00, kUnsync | kUnfreeze, 0, false},
      {0x00, kClear, 0, false},
      {0x00, kSync | 0x01, 0, false},
      {0x00, kSync, 0x04, false},
      {0x00, kSync | kFreeze | kUnfreeze, 0, true},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(testing::Message() << std::hex << one.b024 << " " << one.command << " " << one.group);
    SlaveBench slave(quick_search());
    Init init;
    init.command = static_cast<std::uint8_t>(one.b024);
    slave.to_data_exch(init, prm(0x80, 0x02));
    tell(slave, bus::kBroadcast, 58, {static_cast<std::uint8_t>(one.command), static_cast<std::uint8_t>(one.group)});
    EXPECT_EQ(diag(slave).at(0), one.not_supported ? 0x10 : 0x00);
    EXPECT_EQ(slave.dp_state(), DpState::kDataExch) << "it goes on";
    ASSERT_TRUE(is_sc(ask(slave, 61, prm(0x80).bytes())));
    EXPECT_EQ(diag(slave).at(0) & 0x10, 0);
  }
}

TEST_F(GlobalControl, NotSupportedIsNotSetByAnotherMastersCommandOrWithoutDataExchange) {
  Init init;
  init.command = 0x00;
  bench.to_wait_cfg(init, prm(0x80));
  tell(bench, bus::kBroadcast, 58, {kSync | kFreeze, 0});
  ASSERT_TRUE(is_sc(bench.check_cfg()));
  tell(bench, bus::kBroadcast, 58, {kSync | kFreeze, 0}, 3);
  EXPECT_EQ(bench.count(Reason::kGcIgnored), 2);
  EXPECT_EQ(diag(bench).at(0), 0x00);
}

TEST_F(GlobalControl, IsForTheGroupsOfSetPrmAndForAllWithZero) {
  for (const int own : {0x00, 0x01, 0x80, 0x5A, 0xFF}) {
    SlaveBench one(quick_search());
    one.to_data_exch({}, prm(0xB0, own));
    for (const int selected : {0x00, 0x01, 0x02, 0x80, 0xA5, 0xFF}) {
      ask(one, kNoSap, {1, 2});
      const int before = one.count(Reason::kGlobalControl), others = one.count(Reason::kGcOtherGroup);
      tell(one, bus::kBroadcast, 58, {kClear, static_cast<std::uint8_t>(selected)});
      const bool meant = selected == 0 || (own & selected) != 0;
      EXPECT_EQ(one.count(Reason::kGlobalControl) - before, meant ? 1 : 0) << own << " " << selected;
      EXPECT_EQ(one.count(Reason::kGcOtherGroup) - others, meant ? 0 : 1) << own << " " << selected;
      EXPECT_EQ(ask(one, 57).answer().data, meant ? (Bytes{0, 0}) : (Bytes{1, 2})) << own << " " << selected;
    }
  }
}

TEST_F(GlobalControl, ToTheStationAloneIsExecutedToo) {
  start(prm());
  exchange();
  tell(bench, 5, 58, {kSync, 0});
  model.command(kSync);
  expect_model("sync");
}

TEST_F(GlobalControl, ToAnotherStationIsNotExecuted) {
  start(prm());
  exchange();
  tell(bench, 6, 58, {kSync | kClear, 0});
  expect_model("nothing");
}

TEST_F(GlobalControl, FromAnotherMasterIsIgnored) {
  start(prm());
  exchange();
  tell(bench, bus::kBroadcast, 58, {kSync | kFreeze | kClear, 0}, 3);
  EXPECT_EQ(bench.count(Reason::kGcIgnored), 1);
  expect_model("nothing");
}

TEST_F(GlobalControl, SyncAndFreezeEndWithDataExchange) {
  start(prm());
  control(kSync | kFreeze);
  ask(bench, 61, prm().bytes());
  EXPECT_EQ(diag(bench).at(1), 0x04);
  ask(bench, 62, {0x11, 0x21});
  EXPECT_EQ(diag(bench).at(1), 0x04);
  model = Buffers{};
  give();
  exchange();
  expect_model("unsync, unfreeze");
}

TEST_F(GlobalControl, OutputsHeldInSyncAreClearedWhenDataExchangeEnds) {
  start(prm());
  exchange();
  control(kSync);
  exchange();
  ask(bench, 61, prm().bytes());
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{0, 0}));
}

TEST_F(GlobalControl, FailSafeClearInSyncReachesTheUser) {
  Prm parameters = prm();
  parameters.user = {0x40};
  start(parameters);
  exchange();
  control(kSync);
  ask(bench, kNoSap, {});  // "an empty one is Clear" (S19)
  settle(bench);
  EXPECT_EQ(output_area(bench), (Bytes{0, 0}));
}

TEST_F(GlobalControl, FrozenInputsAreWhatTheMasterSees) {
  start(prm());
  give();
  control(kFreeze);
  const Bytes frozen = model.in2;
  give();
  give();
  EXPECT_EQ(ask(bench, kNoSap, {1, 1}).answer().data, frozen);
  EXPECT_EQ(ask(bench, 56).answer().data, frozen);
  control(kFreeze);
  EXPECT_EQ(ask(bench, kNoSap, {1, 1}).answer().data, model.in1);
}

}  // namespace
}  // namespace dsdpv1::conformance
