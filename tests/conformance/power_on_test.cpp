#include <gtest/gtest.h>

#include "tests/conformance/slave_bench.hpp"

namespace dsdpv1::conformance {
namespace {

TEST(PowerOn, ReachesDataExchangeAt12M) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({0x12, 0x34});
  const bus::Exchange exchange = bench.data_exchange({0xAB, 0xCD});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().data, (Bytes{0x12, 0x34}));
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0xAB, 0xCD}));
}

class PowerOnAtBaud : public testing::TestWithParam<int> {};

TEST_P(PowerOnAtBaud, ReachesDataExchangeAfterTheSearch) {
  SlaveBench bench;
  bench.to_data_exch({}, {}, GetParam());
  EXPECT_EQ(bench.chip.status().baud_index.code(), GetParam());
  EXPECT_TRUE(bench.data_exchange({1, 2}).answered());
}

INSTANTIATE_TEST_SUITE_P(AllRates, PowerOnAtBaud, testing::Range(0, bus::kBaudCount),
                         [](const auto& at) { return "Code" + std::to_string(at.param); });

}  // namespace
}  // namespace dsdpv1::conformance
