#include <gtest/gtest.h>

#include "registers/dsdpv1_regs.hpp"
#include "registers/spc3_regs.hpp"

extern "C" {
unsigned c_user_command_1_init(void);
unsigned c_init_crc(void);
unsigned c_dpram_size(void);
unsigned c_baud_searching(void);
unsigned c_spc3_imr(void);
unsigned c_spc3_imr_reset(void);
unsigned c_spc3_new_prm(void);
}

namespace dsdpv1::regs {
namespace {

TEST(RegisterHeaders, CAndCppAgree) {
  EXPECT_EQ(c_user_command_1_init(), kUserCommand1Init);
  EXPECT_EQ(c_init_crc(), kInitCrc);
  EXPECT_EQ(c_dpram_size(), kDpramSize);
  EXPECT_EQ(c_baud_searching(), kBaudSearching);
}

TEST(RegisterHeaders, CAndCppAgreeOnTheSpc3Family) {
  EXPECT_EQ(c_spc3_imr(), spc3::regs::kImr);
  EXPECT_EQ(c_spc3_imr_reset(), spc3::regs::kImrReset);
  EXPECT_EQ(c_spc3_new_prm(), spc3::regs::kEventNewPrm);
}

}  // namespace
}  // namespace dsdpv1::regs
