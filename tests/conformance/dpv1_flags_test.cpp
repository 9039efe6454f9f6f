// The flags of acyclic data: B011.0 and B011.1 of the user's answers (4.1.4, note under table 11), and their precedence
// over a request that comes meanwhile (H4, R9).
#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::conformance {
namespace {

/// 0: C1, 1: C2.
class AcyclicFlags : public Dpv1Test, public testing::WithParamInterface<int> {
 protected:
  const Area& area() const { return GetParam() == 0 ? kC1Area : kC2Area; }
  void connect_both() {
    start();
    if (GetParam() != 0) ASSERT_EQ(connect(), kFirstChannel);
  }
  Exchange telegram(const Bytes& pdu) { return GetParam() == 0 ? c1(pdu) : c2(kFirstChannel, pdu); }
  void to_user(const Bytes& request) {
    ASSERT_TRUE(is_sc(telegram(request)));
    bench.chip_accesses(3);
    ASSERT_EQ(fetch(area()), request);
  }
  /// In a hold that goes on.
  void write_answer(const Bytes& pdu, std::uint8_t flags, std::uint16_t crc_error = 0) {
    bench.acquire();
    bench.write_block(area().base, pdu, area().crc, crc_error);
    bench.write(0x011, flags);
  }
};

TEST_P(AcyclicFlags, OfAnAnswerStandsUntilTheChipHasReadIt) {
  connect_both();
  to_user(read_request(1, 2, 3));
  for (const bool wrong : {true, false}) {  // H5: also of a block that is refused
    write_answer(pdu_of(0x5E, 1, 2, 1, {0x77}), area().flag, wrong ? 0x0001 : 0x0000);
    bench.run_cycles(500);
    EXPECT_EQ(bench.peek(0x011), area().flag) << "the user holds the DPRAM";
    bench.release();
    bench.chip_accesses(1);
    EXPECT_EQ(bench.peek(0x011), 0) << "read in this access";
    EXPECT_EQ(bench.peek(0x00B), wrong ? area().crc_error : 0);
  }
  EXPECT_EQ(text(telegram({})), testing::PrintToString(pdu_of(0x5E, 1, 2, 1, {0x77})));
}

TEST_P(AcyclicFlags, WithoutItAnAnswerIsNotRead) {
  connect_both();
  to_user(read_request(1, 2, 3));
  write_answer(pdu_of(0x5E, 1, 2, 1, {0x77}), 0);
  bench.release();
  bench.chip_accesses(3);
  EXPECT_TRUE(is_sc(telegram({}))) << "nothing to send";
  bench.poke(0x011, area().flag);
  bench.chip_accesses(3);
  EXPECT_EQ(text(telegram({})), testing::PrintToString(pdu_of(0x5E, 1, 2, 1, {0x77})));
}

// R9: the answer that waits is taken first; the request is kept, and written in the same access.
TEST_P(AcyclicFlags, ARequestThatComesWhileAnAnswerWaitsIsWrittenAfterIt) {
  connect_both();
  write_answer(pdu_of(0x5E, 9, 9, 1, {0x99}), area().flag);
  const Bytes request = read_request(1, 2, 3);
  ASSERT_TRUE(is_sc(telegram(request)));
  EXPECT_EQ(bench.peek(0x00F), 0);
  bench.release();
  bench.chip_accesses(1);
  EXPECT_EQ(bench.peek(0x011), 0) << "the answer is taken";
  EXPECT_EQ(bench.count(Reason::kAcyclicNoRequest), 1) << "and was for no request of the user's";
  EXPECT_EQ(bench.peek(0x00F), area().flag) << "the request is not lost";
  EXPECT_EQ(fetch(area()), request);
}

INSTANTIATE_TEST_SUITE_P(Of, AcyclicFlags, testing::Values(0, 1),
                         [](const auto& at) { return at.param == 0 ? "C1" : "C2"; });

}  // namespace
}  // namespace dsdpv1::conformance
