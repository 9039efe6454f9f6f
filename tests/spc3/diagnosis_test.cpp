// Slave_Diag and New_Diag (docs/spc3.md, "Diagnosis"; A18, A19, A39, A51).
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

constexpr std::uint8_t kExtDiag = 1, kStatDiag = 2, kOverflow = 4;

/// Fills the user's buffer, and New_Diag.
int give(Bench& bench, std::uint8_t flags, const Bytes& user) {
  const unsigned number = (bench.load(regs::kDiagSm) & 3U) == 1 ? 1 : 2;
  Bytes bytes = {flags, 0x11, 0x22, 0x33, 0x44, 0x55};
  bytes.insert(bytes.end(), user.begin(), user.end());
  bench.store(static_cast<Address>(regs::kOrgDiagLength + number - 1), static_cast<std::uint8_t>(bytes.size()));
  bench.fill(static_cast<Address>(regs::kOrgDiagPointer + number - 1), bytes);
  return bench.load(regs::kNewDiag);
}

TEST(Spc3Diagnosis, BeforeTheFirstItHasTheSixBytes) {
  Bench bench;
  bench.to_wait_prm();
  EXPECT_EQ(bench.load(regs::kDiagSm), 0x09) << "A18";
  EXPECT_EQ(bench.diag(), (Bytes{0x02, 0x05, 0x00, 0xFF, 0x0C, 0xC9}));
  EXPECT_EQ(bench.buffer(regs::kOrgDiagPointer + 1, 6), (Bytes{0x02, 0x05, 0x00, 0xFF, 0x0C, 0xC9}))
      << "in RAM, too (A39)";
}

TEST(Spc3Diagnosis, ANewOneMakesDataAnswersHighUntilTheHolderHasReadIt) {
  Bench bench;
  bench.to_data_ex();
  EXPECT_EQ(give(bench, kExtDiag, {0x42, 0x43}), 2);
  EXPECT_EQ(bench.load(regs::kDiagSm), 0x06);
  EXPECT_TRUE(bench.raised(regs::kEventDiagChanged));
  EXPECT_EQ(bench.load(regs::kStatus) & 4, 4) << "Diag_Flag";
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "DH");
  EXPECT_EQ(bench.diag(9), (Bytes{0x08, 0x04, 0x00, 0x02, 0x0C, 0xC9, 0x42, 0x43}));
  EXPECT_EQ(bench.load(regs::kStatus) & 4, 4) << "another master (A51)";
  bench.diag();
  EXPECT_EQ(bench.load(regs::kStatus) & 4, 0);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "DL");
  EXPECT_EQ(bench.diag()[0], 0x08) << "Ext_Diag is kept from New_Diag, though byte 0 is another now";
}

TEST(Spc3Diagnosis, StatDiagKeepsTheFlag) {
  Bench bench;
  bench.to_data_ex();
  give(bench, kStatDiag | kOverflow, {});
  const Bytes diag = bench.diag();
  EXPECT_EQ(diag[1], 0x06) << "Stat_Diag";
  EXPECT_EQ(diag[2], 0x80) << "Ext_Diag_Overflow";
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "DH");
  give(bench, 0, {});
  bench.diag();
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "DL");
}

TEST(Spc3Diagnosis, AnyMasterMayEndTheFlag) {
  spc3::Config config;
  config.diag_flag_by = 1;
  Bench bench(Variant::kApc3, config);
  bench.to_data_ex();
  give(bench, 0, {});
  bench.diag(9);
  EXPECT_EQ(bench.load(regs::kStatus) & 4, 0);
}

TEST(Spc3Diagnosis, TheRamMayStayAsTheUserWroteIt) {
  spc3::Config config;
  config.diag_bytes = 1;
  Bench bench(Variant::kApc3, config);
  bench.to_data_ex();
  give(bench, kExtDiag, {0x42});
  EXPECT_EQ(bench.diag()[0], 0x08);
  EXPECT_EQ(bench.buffer(regs::kOrgDiagPointer, 7), (Bytes{kExtDiag, 0x11, 0x22, 0x33, 0x44, 0x55, 0x42}));
}

TEST(Spc3Diagnosis, NewDiagWhileItIsSentIsRemembered) {
  Bench bench;
  bench.to_data_ex();
  give(bench, 0, {1});
  bench.acknowledge(0xFFFF);
  struct User : bus::Agent {
    Bench& bench;
    int turn = 0;
    explicit User(Bench& of) : bench(of) {}
    Tick next() const override { return turn == 2 ? bus::kNever : at[turn]; }
    void run(Tick) override {
      EXPECT_EQ(bench.load(regs::kDiagSm), turn == 0 ? 0x07 : 0x0B) << "the chip sends buffer 1";
      EXPECT_EQ(bench.load(regs::kNewDiag), 0);
      EXPECT_EQ(bench.load(regs::kDiagSm), 0x0B) << "no buffer is the user's";
      EXPECT_EQ(bench.irr() & regs::kEventDiagChanged, 0);
      ++turn;
    }
    Tick at[2] = {};
  } user(bench);
  const Tick begin = bench.now() + 40 * bench.requester.bit();
  const Tick request = 11 * 11 * bench.requester.bit(), answer = begin + request + 20 * bench.requester.bit();
  user.at[0] = answer;
  user.at[1] = answer + 30 * bench.requester.bit();
  bench.timeline.add(user);
  const auto telegram = bus::make_telegram(5, 2, 0x6D, {}, 60, 62);
  EXPECT_EQ(kind_of(bench.requester.send(bench.timeline, telegram, {.at = begin})), "DL");
  EXPECT_EQ(user.turn, 2);
  bench.run_cycles(8);
  EXPECT_EQ(bench.load(regs::kDiagSm), 0x09) << "exchanged when RTS has fallen";
  EXPECT_TRUE(bench.raised(regs::kEventDiagChanged));
  EXPECT_EQ(bench.load(regs::kStatus) & 4, 4) << "the remembered one is new";
}

TEST(Spc3Diagnosis, LengthsBelowSixCountAsSix) {
  Bench bench;
  bench.to_wait_prm();
  bench.store(regs::kOrgDiagLength + 1, 0);
  EXPECT_EQ(bench.diag().size(), 6U) << "A4";
  bench.store(regs::kOrgDiagPointer + 1, 0);
  EXPECT_EQ(kind_of(bench.ask(60)), "RR");
}

}  // namespace
}  // namespace dsdpv1::spc3_test
