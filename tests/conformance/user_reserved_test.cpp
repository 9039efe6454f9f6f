// Reserved bits of the bytes that both sides write (tables 6, 8 to 11): the chip gives them no meaning and leaves them
// as they are. B011.6 and B011.7 are not among them (D16).
#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr std::uint8_t kB00C = 0xFC, kB00E = 0xF8, kB00F = 0xFC, kB010 = 0x38, kB011 = 0x3C;

class UserReservedBits : public Dpv1Test {
 protected:
  void set_all() {
    bench.acquire();
    bench.write(regs::kUserStatus1, kB00C);
    bench.write(regs::kChipCommand1, kB00E);
    bench.write(regs::kChipCommand2, kB00F);
    bench.write(regs::kUserCommand1, kB010);
    bench.write(regs::kUserCommand2, kB011);
    bench.chip_accesses(3);
  }
  Bytes all() {
    return {bench.peek(regs::kUserStatus1), bench.peek(regs::kChipCommand1), bench.peek(regs::kChipCommand2),
            bench.peek(regs::kUserCommand1), bench.peek(regs::kUserCommand2)};
  }
  /// The user's flag together with the reserved bits, then three accesses of the chip.
  void give_flag(std::uint8_t flag) {
    bench.write(regs::kUserCommand1, static_cast<std::uint8_t>(kB010 | flag));
    bench.chip_accesses(3);
  }
};

TEST_F(UserReservedBits, AloneDoNothing) {
  start();
  set_all();
  const std::size_t events = bench.chip.events().size();
  bench.chip_accesses(5);
  EXPECT_EQ(all(), (Bytes{kB00C, kB00E, kB00F, kB010, kB011}));
  EXPECT_EQ(bench.chip.events().size(), events);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(UserReservedBits, StayWhenBlocksCrossTheDpram) {
  start();
  set_all();
  bench.acquire();
  bench.write_block(regs::kInput, {2, 3, 4}, regs::kInputCrc);
  give_flag(regs::kUserCommand1Input);
  EXPECT_EQ(bench.data_exchange({1, 2}).answer().data, (Bytes{3, 4}));
  bench.chip_accesses(3);
  EXPECT_EQ(all(), (Bytes{kB00C, kB00E | regs::kChipCommand1Output, kB00F, kB010, kB011}));
}

TEST_F(UserReservedBits, StayWhenAnAcyclicRequestIsAnswered) {
  start();
  set_all();
  ASSERT_TRUE(is_sc(c1(read_request(1, 2, 1))));
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kChipCommand2), kB00F | kC1Area.flag);
  EXPECT_EQ(fetch(kC1Area), read_request(1, 2, 1));
  give(kC1Area, pdu_of(0x5E, 1, 2, 1, {9}));
  EXPECT_EQ(text(c1({})), testing::PrintToString(pdu_of(0x5E, 1, 2, 1, {9})));
  EXPECT_EQ(all(), (Bytes{kB00C, kB00E, kB00F, kB010, kB011}));
}

TEST_F(UserReservedBits, AreNoPartOfAVerdict) {
  Init init;
  init.prm_mode = init.cfg_mode = 2;
  bench.to_wait_prm(init);
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  set_all();
  bench.acquire();
  give_flag(regs::kUserCommand1PrmVerdict);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg) << "B00C.0 is 0: right";
  ASSERT_TRUE(is_sc(bench.check_cfg()));
  bench.chip_accesses(3);
  bench.acquire();
  give_flag(regs::kUserCommand1CfgVerdict);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch) << "B00C.1 is 0: right";
  EXPECT_EQ(bench.peek(regs::kUserStatus1), kB00C);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), kB010);
}

}  // namespace
}  // namespace dsdpv1::conformance
