#include "tb/dsdpv1/user_cpu/arm/unicorn.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace arm {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Unicorn, ThatIsNotThereIsNamed) {
  EXPECT_THAT([] { Unicorn("libunicorn.so.none"); },
              ThrowsMessage<std::runtime_error>(
                  testing::AllOf(HasSubstr("(Debian: libunicorn2)"), HasSubstr("libunicorn.so.none"))));
}

TEST(Unicorn, WithoutAFunctionNamesIt) {
  EXPECT_THAT([] { Unicorn("libm.so.6"); }, ThrowsMessage<std::runtime_error>(HasSubstr("uc_open")));
}

TEST(Unicorn, OfTheHeaderIsLoadedOnce) {
  EXPECT_EQ(&unicorn(), &unicorn());
  EXPECT_STREQ(unicorn().strerror(UC_ERR_OK), "OK (UC_ERR_OK)");
}

}  // namespace
}  // namespace arm
