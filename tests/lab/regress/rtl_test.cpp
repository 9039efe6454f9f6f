// Regressions with the reference RTL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using testing::HasSubstr;

class RegressRtl : public testing::Test {
 protected:
  RegressRtl() {
    std::ofstream(folder_.file("s.yaml"))
        << "name: small\nbaud: 12M\nend: 600us\n"
           "slaves: [{name: demo, address: 5, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}]\n"
           "expect: [{slave: demo, event: INITIALISED}]\n";
  }
  Called regress(const std::string& arguments) const { return call("regress s.yaml " + arguments, folder_.path()); }

  app_test::Folder folder_;
};

TEST_F(RegressRtl, ImpossibleCombinationsAreLeftOutAndCounted) {
  const Called called = regress("--engine skip,lockstep --view pins,tlm --quiet");
  EXPECT_EQ(called.status, 0);
  EXPECT_THAT(called.err, HasSubstr("3 of 3 runs passed; 1 combinations that cannot be are left out; "));
  EXPECT_EQ(called.out, "");
}

TEST_F(RegressRtl, SeedIsThatOfTheRtl) {
  const Called called = regress("--engine skip,rtl --seed 2..3");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("\npassed\ts.yaml\tskip\tpins\t\t"));
  EXPECT_THAT(called.out, HasSubstr("\npassed\ts.yaml\trtl\tpins\t2\t"));
  EXPECT_THAT(called.out, HasSubstr("\npassed\ts.yaml\trtl\tpins\t3\t"));
}

}  // namespace
}  // namespace dsdpv1
