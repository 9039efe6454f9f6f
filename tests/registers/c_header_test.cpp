#include <gtest/gtest.h>

#include "registers/dsdpv1_regs.hpp"

extern "C" {
unsigned c_user_command_1_init(void);
unsigned c_init_crc(void);
unsigned c_dpram_size(void);
unsigned c_baud_searching(void);
}

namespace dsdpv1::regs {
namespace {

TEST(RegisterHeaders, CAndCppAgree) {
  EXPECT_EQ(c_user_command_1_init(), kUserCommand1Init);
  EXPECT_EQ(c_init_crc(), kInitCrc);
  EXPECT_EQ(c_dpram_size(), kDpramSize);
  EXPECT_EQ(c_baud_searching(), kBaudSearching);
}

}  // namespace
}  // namespace dsdpv1::regs
