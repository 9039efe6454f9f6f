// Every DPV0 service in every state, from the holding master and from another one (S5, S12, S13, S14, S20).
#include <gtest/gtest.h>

#include <functional>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

enum class Situation { kOffline, kSearching, kWaitPrm, kWaitCfg, kDataExch };
constexpr Situation kSituations[] = {Situation::kOffline, Situation::kSearching, Situation::kWaitPrm,
                                     Situation::kWaitCfg, Situation::kDataExch};

void bring(SlaveBench& bench, Situation situation) {
  bench.power_on();
  if (situation == Situation::kOffline) return;
  ASSERT_TRUE(bench.initialise());
  bench.run_cycles(33 * 4);
  if (situation == Situation::kSearching) return;
  bench.find_baud(0);
  if (situation == Situation::kWaitPrm) return;
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  if (situation == Situation::kWaitCfg) return;
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  bench.give_inputs({0x12, 0x34});
  ASSERT_TRUE(is_data(ask(bench, kNoSap, {0x56, 0x78})));
}

constexpr std::uint8_t kHolder = 2, kOther = 3;

/// The required answer to a service, for holder and other master, in WAIT_PRM (no holder), WAIT_CFG and DATA_EXCH.
struct Row {
  const char* name;
  int dsap;
  Bytes request;
  const char* wait_prm;
  const char* wait_cfg[2];
  const char* data_exch[2];
};

const Row kRows[] = {
    {"Data_Exchange", kNoSap, {1, 2}, "RS", {"RS", "RS"}, {"DL", "RS"}},
    {"Set_Slave_Address", 55, {9, 0x0C, 0xC9, 0}, "SC", {"RS", "RS"}, {"RS", "RS"}},
    {"Read_Inputs", 56, {}, "RS", {"RS", "RS"}, {"DL", "DL"}},
    {"Read_Outputs", 57, {}, "RS", {"RS", "RS"}, {"DL", "DL"}},
    {"Get_Cfg", 59, {}, "DL", {"DL", "DL"}, {"DL", "DL"}},
    {"Slave_Diag", 60, {}, "DL", {"DL", "DL"}, {"DL", "DL"}},
    {"Set_Prm", 61, {0x80, 0, 0, 11, 0x0C, 0xC9, 0}, "SC", {"SC", "RS"}, {"SC", "RS"}},
    {"Check_Cfg", 62, {0x11, 0x21}, "RS", {"SC", "RS"}, {"SC", "RS"}},
};

const char* expected(const Row& row, Situation situation, bool other) {
  switch (situation) {
    case Situation::kWaitPrm: return row.wait_prm;
    case Situation::kWaitCfg: return row.wait_cfg[other ? 1 : 0];
    case Situation::kDataExch: return row.data_exch[other ? 1 : 0];
    default: return "silent";
  }
}

TEST(Services, AreAnsweredInEveryStateAsTheRulingsDemand) {
  for (const Row& row : kRows) {
    for (const Situation situation : kSituations) {
      for (const bool other : {false, true}) {
        SlaveBench bench(quick_search());
        bring(bench, situation);
        const DpState before = bench.dp_state();
        const Exchange exchange = ask(bench, row.dsap, row.request, other ? kOther : kHolder);
        SCOPED_TRACE(std::string(row.name) + " in state " + std::to_string(static_cast<int>(situation)) +
                     (other ? " from another master" : " from the holder"));
        EXPECT_EQ(kind_of(exchange), expected(row, situation, other));
        if (is_rs(exchange) || exchange.silent()) {
          EXPECT_EQ(bench.dp_state(), before);
          EXPECT_EQ(bench.chip.status().data_exchanges, situation == Situation::kDataExch ? 1U : 0U);
        }
      }
    }
  }
}

// S13: an SRD that only reads carries no data.
TEST(Services, DataBytesToTheReadingSapsAreAnsweredRrOnceTheStateAllowsTheService) {
  for (const Situation situation : {Situation::kWaitPrm, Situation::kWaitCfg, Situation::kDataExch}) {
    for (const int sap : {56, 57, 59, 60}) {
      for (const Bytes& data : {Bytes{0}, Bytes(244, 0x5A)}) {
        SlaveBench bench(quick_search());
        bring(bench, situation);
        const bool served = sap > 57 || situation == Situation::kDataExch;
        const DpState before = bench.dp_state();
        const std::size_t events = bench.chip.events().size();
        const Exchange exchange = ask(bench, sap, data, kOther);
        EXPECT_EQ(kind_of(exchange), served ? "RR" : "RS") << sap;
        EXPECT_EQ(bench.count(Reason::kSapData), served ? 1 : 0);
        EXPECT_EQ(bench.chip.events().size(), events + 1);
        EXPECT_EQ(bench.dp_state(), before);
        if (!served) continue;
        EXPECT_EQ(bench.last(Reason::kSapData).a, sap);
        EXPECT_EQ(bench.last(Reason::kSapData).b, data.size());
        EXPECT_EQ(bench.last(Reason::kSapData).c, kOther);
      }
    }
  }
}

TEST(Services, RefusedSlaveDiagDoesNotCountAsRead) {
  SlaveBench bench(quick_search());
  bring(bench, Situation::kDataExch);
  bench.give_diag(0x81, {1});
  EXPECT_EQ(kind_of(ask(bench, 60, {0})), "RR");
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {1, 2})), "DH");
}

/// RS, and the refusal names SAP, state and master.
void expect_no_outputs(SlaveBench& bench, int state, std::uint8_t master) {
  EXPECT_EQ(kind_of(ask(bench, 57, {}, master)), "RS");
  EXPECT_EQ(bench.last(Reason::kSapState).a, 57);
  EXPECT_EQ(bench.last(Reason::kSapState).b, state);
  EXPECT_EQ(bench.last(Reason::kSapState).c, master);
}

TEST(Services, ReadOutputsIsRefusedOutsideOfDataExchange) {
  SlaveBench bench(quick_search());
  bring(bench, Situation::kWaitPrm);
  expect_no_outputs(bench, 1, kHolder);
  expect_no_outputs(bench, 1, 9);
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  expect_no_outputs(bench, 2, kHolder);
  expect_no_outputs(bench, 2, 9);
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  EXPECT_EQ(ask(bench, 57).answer().data, (Bytes{0, 0})) << "before the first data exchange";
  ASSERT_TRUE(is_data(ask(bench, kNoSap, {0x56, 0x78})));
  EXPECT_EQ(ask(bench, 57).answer().data, (Bytes{0x56, 0x78}));
  EXPECT_EQ(ask(bench, 57, {}, 9).answer().data, (Bytes{0x56, 0x78}));
  tell(bench, bus::kBroadcast, 58, {0x02, 0});
  EXPECT_EQ(ask(bench, 57).answer().data, (Bytes{0, 0})) << "Clear_Data";
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  expect_no_outputs(bench, 2, kHolder);
}

TEST(Services, ReadOutputsWithoutAnyIsScInDataExchangeAndRsBefore) {
  Init init;
  init.cfg = {0x11};
  SlaveBench bench(quick_search());
  bench.to_wait_cfg(init);
  EXPECT_EQ(kind_of(ask(bench, 57)), "RS");
  ASSERT_TRUE(is_sc(ask(bench, 62, init.cfg)));
  EXPECT_EQ(kind_of(ask(bench, 57)), "SC");
}

TEST(Services, RefusalsByStateNameSapStateAndMaster) {
  SlaveBench bench(quick_search());
  bring(bench, Situation::kWaitCfg);
  ask(bench, 56);
  EXPECT_EQ(bench.last(Reason::kSapState).a, 56);
  EXPECT_EQ(bench.last(Reason::kSapState).b, 2);
  EXPECT_EQ(bench.last(Reason::kSapState).c, kHolder);
  ask(bench, 61, Prm{}.bytes(), kOther);
  EXPECT_EQ(bench.last(Reason::kSapMaster).a, 61);
  EXPECT_EQ(bench.last(Reason::kSapMaster).b, kOther);
  EXPECT_EQ(bench.last(Reason::kSapMaster).c, kHolder);
}

TEST(Services, EveryRefusalHasExactlyOneReason) {
  for (const Row& row : kRows) {
    for (const Situation situation : {Situation::kWaitPrm, Situation::kWaitCfg, Situation::kDataExch}) {
      for (const bool other : {false, true}) {
        if (std::string(expected(row, situation, other)) != "RS") continue;
        SlaveBench bench(quick_search());
        bring(bench, situation);
        const std::size_t before = bench.chip.events().size();
        ask(bench, row.dsap, row.request, other ? kOther : kHolder);
        ASSERT_EQ(bench.chip.events().size(), before + 1) << row.name << " in " << static_cast<int>(situation);
        EXPECT_EQ(severity(bench.chip.events().back().reason), profibus::Severity::kRefusal);
      }
    }
  }
}

TEST(Services, FdlStatusIsAnsweredWheneverTheRateIsFound) {
  for (const Situation situation : kSituations) {
    SlaveBench bench(quick_search());
    bring(bench, situation);
    const bool answers = situation != Situation::kOffline && situation != Situation::kSearching;
    EXPECT_EQ(bench.fdl_status().answered(), answers) << static_cast<int>(situation);
  }
}

TEST(Services, GlobalControlIsExecutedInDataExchangeForTheHolderOnly) {
  for (const Situation situation : kSituations) {
    for (const bool other : {false, true}) {
      SlaveBench bench(quick_search());
      bring(bench, situation);
      settle(bench);
      const Bytes outputs = output_area(bench);
      tell(bench, bus::kBroadcast, 58, {0x02, 0}, other ? kOther : kHolder);  // Clear_Data
      settle(bench);
      SCOPED_TRACE(std::to_string(static_cast<int>(situation)) + (other ? " other" : " holder"));
      const bool executed = situation == Situation::kDataExch && !other;
      EXPECT_EQ(bench.count(Reason::kGlobalControl), executed ? 1 : 0);
      if (executed)
        EXPECT_EQ(output_area(bench), (Bytes{0, 0}));
      else
        EXPECT_EQ(output_area(bench), outputs);
      const bool explained =
          situation == Situation::kWaitPrm || situation == Situation::kWaitCfg || situation == Situation::kDataExch;
      EXPECT_EQ(bench.count(Reason::kGcIgnored), explained && !executed ? 1 : 0);
    }
  }
}

TEST(Services, StateAndMasterAreLookedAtBeforeTheLength) {
  const Bytes long_cfg(201, 0), long_address(5, 0);
  for (const Situation situation : {Situation::kWaitPrm, Situation::kWaitCfg, Situation::kDataExch}) {
    SlaveBench bench(quick_search());
    bring(bench, situation);
    const DpState before = bench.dp_state();
    EXPECT_EQ(kind_of(ask(bench, 62, long_cfg, kOther)), "RS");
    EXPECT_EQ(kind_of(ask(bench, 62, long_cfg, kHolder)), situation == Situation::kWaitPrm ? "RS" : "RR");
    EXPECT_EQ(kind_of(ask(bench, 55, long_address)), situation == Situation::kWaitPrm ? "RR" : "RS");
    EXPECT_EQ(kind_of(ask(bench, kNoSap, {1, 2, 3}, kOther)), "RS");
    EXPECT_EQ(kind_of(ask(bench, 61, {1}, kOther)), situation == Situation::kWaitPrm ? "SC" : "RS");
    EXPECT_EQ(bench.dp_state(), before);
  }
}

TEST(Services, StatesFollowTheirOrder) {
  SlaveBench bench(quick_search());
  EXPECT_EQ(bench.dp_state(), DpState::kOffline);
  bench.power_on();
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 1) << "before the initialisation";
  bench.to_wait_prm();
  settle(bench);
  EXPECT_EQ(bench.peek(0x012) & 0x0C, 0x04);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 1);
  bench.set_prm({});
  settle(bench);
  EXPECT_EQ(bench.peek(0x012) & 0x0C, 0x08);
  EXPECT_EQ(bench.chip.status().master, 2);
  bench.check_cfg();
  settle(bench);
  EXPECT_EQ(bench.peek(0x012) & 0x0C, 0x0C);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 0);
}

// --- Get_Cfg (6.2.9)

TEST(GetCfg, ShowsTheInitialConfigurationOutsideOfDataExchange) {
  Init init;
  init.cfg = {0x11, 0x21, 0x30};
  SlaveBench bench(quick_search());
  bench.to_wait_prm(init);
  EXPECT_EQ(ask(bench, 59).answer().data, init.cfg);
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  EXPECT_EQ(ask(bench, 59).answer().data, init.cfg);
}

TEST(GetCfg, ShowsTheConfigurationInUseInDataExchange) {
  SlaveBench bench(quick_search());
  bench.to_wait_cfg();
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x13, 0x20})));
  ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(ask(bench, 59).answer().data, (Bytes{0x13, 0x20}));
  EXPECT_EQ(ask(bench, 59, {}, 3).answer().data, (Bytes{0x13, 0x20}));
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  EXPECT_EQ(ask(bench, 59).answer().data, (Bytes{0x11, 0x21})) << "WAIT_CFG again";
}

TEST(GetCfg, TakesTwoHundredBytes) {
  Init init;
  init.cfg = Bytes(200, 0x00);
  init.cfg[0] = 0x10;
  init.cfg[199] = 0x20;
  SlaveBench bench(quick_search());
  bench.to_data_exch(init);
  EXPECT_EQ(ask(bench, 59).answer().data, init.cfg);
}

}  // namespace
}  // namespace dsdpv1::conformance
