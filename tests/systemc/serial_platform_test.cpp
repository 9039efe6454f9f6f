// User CPUs with the C driver on the SPI and the UART socket of a DSDPV1-RSU, at 1 fs and at 1 ps: from power-on to
// data exchange, all at the same ticks.
#include <gtest/gtest.h>

#include "tests/systemc/own_process.hpp"
#include "tests/systemc/platform.hpp"

namespace dsdpv1 {
namespace {

template <class Cpu>
std::string told_at(double femtoseconds) {
  return in_a_process_of_its_own([=] {
    sc_core::sc_set_time_resolution(femtoseconds, sc_core::SC_FS);
    platform::SerialPlatform<Cpu> platform;
    sc_core::sc_start(platform::to_time(platform::kSerialSlower * platform::kEnd));
    return platform.told();
  });
}

template <class Cpu>
class SerialPlatform : public testing::Test {};
using Cpus = testing::Types<systemc::SpiDriverCpu, systemc::UartDriverCpu>;
TYPED_TEST_SUITE(SerialPlatform, Cpus);

TYPED_TEST(SerialPlatform, TheDriverExchangesDataAtTheSameTicksAtBothResolutions) {
  const std::string fine = told_at<TypeParam>(1);
  for (const char* said :
       {"ready: success", "initialised: success", "parameters, 2 bytes", "configuration, 2 bytes", "outputs 11\n"})
    EXPECT_NE(fine.find(said), std::string::npos) << said;
  EXPECT_EQ(fine.find("exchange: "), std::string::npos) << "an error of the driver";
  for (const char* refused : {"TELEGRAM_", "SPI_WRITE", "SPI_NO_CLAIM", "UART_"})
    EXPECT_EQ(fine.find(refused), std::string::npos) << fine.substr(fine.find(refused), 40);
  EXPECT_EQ(first_difference(told_at<TypeParam>(1000), fine), "");
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
