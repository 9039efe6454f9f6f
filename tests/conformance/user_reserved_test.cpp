// Reserved bits of the bytes that both sides write (tables 6, 8 to 11): the chip gives them no meaning and leaves them
// as they are. B011.6 and B011.7 are not among them (D16).
#include <initializer_list>
#include <utility>

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
  /// Blocks that the chip must not read: each has a wrong CRC, which B00B would show.
  void spoil(std::initializer_list<regs::Address> crcs) {
    for (const regs::Address crc : crcs) bench.poke(crc, static_cast<std::uint8_t>(~bench.peek(crc)));
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
  spoil({regs::kInitCrc, regs::kDiagCrc, regs::kC1Crc, regs::kC2Crc});
  bench.acquire();
  bench.write_block(regs::kInput, {2, 3, 4}, regs::kInputCrc);
  give_flag(regs::kUserCommand1Input);
  EXPECT_EQ(bench.data_exchange({1, 2}).answer().data, (Bytes{3, 4}));
  bench.chip_accesses(3);
  EXPECT_EQ(all(), (Bytes{kB00C, kB00E | regs::kChipCommand1Output, kB00F, kB010, kB011}));
  spoil({regs::kInputCrc});
  bench.acquire();
  bench.write_block(regs::kDiag, {0, 0}, regs::kDiagCrc);
  give_flag(regs::kUserCommand1Diag);
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0);
}

TEST_F(UserReservedBits, StayWhenAnAcyclicRequestIsAnswered) {
  start();
  set_all();
  spoil({regs::kC2Crc});
  ASSERT_TRUE(is_sc(c1(read_request(1, 2, 1))));
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kChipCommand2), kB00F | kC1Area.flag);
  EXPECT_EQ(fetch(kC1Area), read_request(1, 2, 1));
  give(kC1Area, pdu_of(0x5E, 1, 2, 1, {9}));
  EXPECT_EQ(text(c1({})), testing::PrintToString(pdu_of(0x5E, 1, 2, 1, {9})));
  EXPECT_EQ(all(), (Bytes{kB00C, kB00E, kB00F, kB010, kB011}));
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0);
}

TEST_F(UserReservedBits, AreNoPartOfAVerdict) {
  Init init;
  init.prm_mode = init.cfg_mode = 2;
  bench.to_wait_prm(init);
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kChipCommand1), 0x02) << "the chip sets none itself";
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

// P13: neither side uses them, and nothing clears them after the start-up.
TEST(UserReservedCells, StayAsTheUserHasLeftThem) {
  constexpr std::pair<std::uint16_t, int> kReserved[] = {{0x007, 1}, {0x014, 12}, {0x0F9, 0x37},
                                                         {0x5CD, 3}, {0x6C6, 10}, {0x7C6, 0x3A}};
  SlaveBench bench(quick_search());
  bench.run_cycles(10);
  bench.chip.set(bench.now(), Pin::kReset, 1);
  bench.run_cycles(3000);  // the start-up access is over, B004 is still 0
  ASSERT_EQ(bench.peek(regs::kValidFlag), 0);
  for (const auto& [first, count] : kReserved)
    for (int i = 0; i < count; ++i) bench.poke(static_cast<std::uint16_t>(first + i), 0xA5);
  bench.to_data_exch();
  bench.give_inputs({3, 4});
  bench.data_exchange({1, 2});
  bench.chip_accesses(3);
  for (const auto& [first, count] : kReserved)
    EXPECT_EQ(bench.peek(first, count), Bytes(static_cast<std::size_t>(count), 0xA5)) << first;
}

}  // namespace
}  // namespace dsdpv1::conformance
