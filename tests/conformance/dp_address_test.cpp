// Set_Slave_Address: when it is served, refused, ignored, and how long it lives (S5, S25).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

class Address : public testing::Test {
 protected:
  static Bytes request(int address, int no_add_chg = 0, int ident = 0x0CC9) {
    return {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(ident >> 8),
            static_cast<std::uint8_t>(ident & 0xFF), static_cast<std::uint8_t>(no_add_chg)};
  }
  bool answers_at(int address) {
    return bench.requester.send(bench.timeline, bus::make_telegram(static_cast<std::uint8_t>(address), 2, kFdlStatus))
        .answered();
  }

  SlaveBench bench{quick_search()};
};

TEST_F(Address, IsChangedAndAnsweredFromTheOldOne) {
  bench.to_wait_prm();
  const Exchange exchange = ask(bench, 55, request(42));
  EXPECT_TRUE(is_sc(exchange));
  EXPECT_EQ(bench.count(Reason::kAddressChanged), 1);
  EXPECT_FALSE(answers_at(5));
  EXPECT_TRUE(answers_at(42));
  EXPECT_EQ(bench.chip.status().address, 42);
  bench.address = 42;
  EXPECT_EQ(diag(bench).size(), 6U);
  EXPECT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  EXPECT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  EXPECT_TRUE(is_data(ask(bench, kNoSap, {1, 2})));
}

TEST_F(Address, MayBeAnyFromZeroTo125) {
  bench.to_wait_prm();
  for (int address = 0; address <= 125; ++address) {
    ASSERT_TRUE(is_sc(ask(bench, 55, request(address)))) << address;
    ASSERT_TRUE(answers_at(address)) << address;
    bench.address = static_cast<std::uint8_t>(address);
  }
}

TEST_F(Address, Above125IsIgnoredWithAReason) {
  bench.to_wait_prm();
  int refused = 0;
  for (const int address : {126, 127, 128, 133, 255}) {
    EXPECT_TRUE(is_sc(ask(bench, 55, request(address)))) << address;
    EXPECT_EQ(bench.count(Reason::kAddressRefused), ++refused);
    EXPECT_TRUE(answers_at(5));
  }
}

// S33: the delivery address.
TEST_F(Address, Of126IsNoAddressToBeParameterisedAt) {
  Init init;
  init.address = 126;
  bench.power_on();
  bench.enable_dpv1(true);
  ASSERT_TRUE(bench.initialise(init));
  bench.find_baud(0);
  Prm other;
  other.ident = 1;
  Prm unlock, min_tsdr;
  unlock.status = 0x40;
  min_tsdr.status = 0x00;
  int refused = 0;
  for (const Bytes& bytes : {Prm{}.bytes(), other.bytes(), unlock.bytes(), min_tsdr.bytes(), Bytes{0x80}}) {
    EXPECT_TRUE(is_rs(ask(bench, 61, bytes)));
    EXPECT_EQ(bench.count(Reason::kPrmNoAddress), ++refused);
  }
  EXPECT_EQ(bench.last(Reason::kPrmNoAddress).a, 2);
  EXPECT_EQ(bench.last(Reason::kPrmNoAddress).b, 1) << "B024.0";
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(diag(bench), (Bytes{0x02, 0x05, 0, 255, 0x0C, 0xC9})) << "no fault";
  EXPECT_TRUE(is_data(ask(bench, 59)));
  EXPECT_TRUE(is_rs(ask(bench, 57))) << "S13";
  EXPECT_TRUE(bench.fdl_status().answered());
  const Bytes initiate = {0x57, 0, 0, 0, 0, 100, 1, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(is_data(send_fc(bench, kSrdFirst, 0x31, 0x32, initiate, 1))) << "C2 (V7)";
  EXPECT_TRUE(is_sc(ask(bench, 55, request(42))));
  bench.address = 42;
  EXPECT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg) << "at once";
}

TEST_F(Address, Of126WithoutAddressChangeWaitsForANewInitialisation) {
  Init init;
  init.address = 126;
  init.command = 0x0E;
  bench.to_wait_prm(init);
  EXPECT_TRUE(is_rs(ask(bench, 61, Prm{}.bytes())));
  EXPECT_EQ(bench.last(Reason::kPrmNoAddress).b, 0);
  EXPECT_TRUE(is_rs(ask(bench, 55, request(42))));
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
}

TEST_F(Address, WithAWrongIdentIsIgnoredWithAReason) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(ask(bench, 55, request(42, 0xFF, 0x0DC9))));
  EXPECT_TRUE(is_sc(ask(bench, 55, request(42, 0xFF, 0x0CC8))));
  EXPECT_EQ(bench.count(Reason::kAddressRefused), 2);
  EXPECT_TRUE(answers_at(5));
  EXPECT_TRUE(is_sc(ask(bench, 55, request(42)))) << "No_Add_Chg of a refused one does not lock";
  EXPECT_TRUE(answers_at(42));
}

TEST_F(Address, ShorterThanFourBytesIsIgnoredWithAReason) {
  bench.to_wait_prm();
  for (std::size_t length = 0; length < 4; ++length) {
    Bytes bytes = request(42);
    bytes.resize(length);
    EXPECT_TRUE(is_sc(ask(bench, 55, bytes))) << length;
    EXPECT_EQ(bench.count(Reason::kAddressRefused), static_cast<int>(length) + 1);
    EXPECT_TRUE(answers_at(5));
  }
}

TEST_F(Address, LongerThanFourBytesIsAnsweredRr) {
  bench.to_wait_prm();
  for (const std::size_t length : {5U, 6U, 244U}) {
    Bytes bytes = request(42);
    bytes.resize(length, 0);
    EXPECT_TRUE(is_rr(ask(bench, 55, bytes))) << length;
    EXPECT_TRUE(answers_at(5));
  }
  EXPECT_EQ(bench.count(Reason::kAddressTooLong), 3);
}

TEST_F(Address, IsRefusedWhenTheInitialisationDoesNotSupportIt) {
  Init init;
  init.command = 0x0E;
  bench.to_wait_prm(init);
  EXPECT_TRUE(is_rs(ask(bench, 55, request(42))));
  EXPECT_TRUE(is_rs(ask(bench, 55, Bytes(5, 0))));
  EXPECT_EQ(bench.count(Reason::kAddressDisabled), 2);
  EXPECT_TRUE(answers_at(5));
}

TEST_F(Address, IsLockedByNoAddChg) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(ask(bench, 55, request(42, 0xFF))));
  bench.address = 42;
  EXPECT_TRUE(is_rs(ask(bench, 55, request(43))));
  EXPECT_EQ(bench.count(Reason::kAddressDisabled), 1);
  EXPECT_TRUE(answers_at(42));
}

TEST_F(Address, IsNotLockedByAZeroNoAddChg) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(ask(bench, 55, request(42, 0))));
  bench.address = 42;
  EXPECT_TRUE(is_sc(ask(bench, 55, request(43, 0))));
  EXPECT_TRUE(answers_at(43));
}

// S5: any value but 00, and the user has no cell that tells him the new address.
TEST_F(Address, IsLockedByEveryNoAddChgButZero) {
  bench.to_wait_prm();
  bench.chip_accesses(2);
  for (const int no_add_chg : {0x01, 0x7F, 0x80, 0xFE, 0xFF}) {
    const std::size_t interrupts = bench.changes(Pin::kIntr0).size();
    EXPECT_TRUE(is_sc(ask(bench, 55, request(42, no_add_chg)))) << no_add_chg;
    bench.address = 42;
    EXPECT_TRUE(is_rs(ask(bench, 55, request(43)))) << no_add_chg;
    EXPECT_EQ(bench.last(Reason::kAddressDisabled).a, 1);
    EXPECT_EQ(bench.last(Reason::kAddressDisabled).b, 1);
    bench.chip_accesses(3);
    EXPECT_EQ(bench.peek(0x021), 5) << "the user's own";
    EXPECT_EQ(bench.peek(0x00E, 2), (Bytes{0, 0}));
    EXPECT_EQ(bench.changes(Pin::kIntr0).size(), interrupts);
    ASSERT_TRUE(bench.initialise());  // ends the lock
    bench.find_baud(0);
  }
}

TEST_F(Address, IsServedOnlyInWaitPrm) {
  bench.to_data_exch();
  EXPECT_TRUE(is_rs(ask(bench, 55, request(42))));
  ask(bench, 61, Prm{}.bytes());
  EXPECT_TRUE(is_rs(ask(bench, 55, request(42))));
  EXPECT_TRUE(answers_at(5));
}

TEST_F(Address, LivesThroughLeavingDataExchange) {
  bench.to_wait_prm();
  ask(bench, 55, request(42));
  bench.address = 42;
  ask(bench, 61, Prm{}.bytes());
  ask(bench, 62, {0x11, 0x21});
  Prm unlock;
  unlock.status = 0x40;
  ask(bench, 61, unlock.bytes());
  EXPECT_TRUE(answers_at(42));
}

TEST_F(Address, LivesUntilANewInitialisation) {
  bench.to_wait_prm();
  ask(bench, 55, request(42, 0xFF));
  Init init;
  init.address = 7;
  ASSERT_TRUE(bench.initialise(init));
  bench.find_baud(0);
  EXPECT_FALSE(answers_at(42));
  EXPECT_TRUE(answers_at(7));
  EXPECT_TRUE(is_sc(ask(bench, 55, request(8)))) << "the lock falls too";
  EXPECT_TRUE(answers_at(8));
}

TEST_F(Address, LivesUntilReset) {
  bench.to_wait_prm();
  ask(bench, 55, request(42, 0xFF));
  bench.chip.set(bench.now(), Pin::kReset, 0);
  bench.power_on();
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_TRUE(answers_at(5));
  EXPECT_FALSE(answers_at(42));
  EXPECT_TRUE(is_sc(ask(bench, 55, request(8))));
}

TEST_F(Address, OldOneIsSilentForTheRepeatedRequestToo) {
  bench.to_wait_prm();
  EXPECT_TRUE(is_sc(send_fc(bench, 0x6D, 55, 62, request(42))));
  EXPECT_TRUE(send_fc(bench, 0x7D, 55, 62, request(42)).silent()) << "nobody is at the old address";
  EXPECT_TRUE(answers_at(42));
}

}  // namespace
}  // namespace dsdpv1::conformance
