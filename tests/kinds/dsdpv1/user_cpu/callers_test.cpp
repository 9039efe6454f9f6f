// The place of a host process is the nearest one of the firmware among the functions that led to its port.
#include "kinds/dsdpv1/user_cpu/callers.hpp"

#include <gtest/gtest.h>

namespace dsdpv1::user_cpu {
namespace {

/// Addresses up to 0x1FF are in the driver's files, from 0x200 in the ports', from 0x300 in firmware; 0x900 in none.
Place place_of(std::uint32_t address) {
  const auto in = [&](const char* file) { return Place{file, static_cast<int>(address & 0xFFU), "f", address}; };
  if (address < 0x200) return in("dsdpv1_io.c");
  if (address < 0x300) return in("dsdpv1_bench.c");
  return address < 0x900 ? in("device.c") : Place{"", 0, "", address};
}

std::uint32_t nearest(const std::vector<std::uint32_t>& addresses) {
  Callers callers;
  return callers.place(callers.number(addresses), place_of).pc;
}

TEST(Callers, FirmwareThatCalledTheDriverIsNamed) {
  EXPECT_EQ(nearest({0x301}), 0x300U);
  EXPECT_EQ(nearest({0x101, 0x111, 0x311, 0x321}), 0x310U);
}

TEST(Callers, HandlerThatIsNotAmongThemIsNotTakenForTheFunctionThatItInterrupted) {
  EXPECT_EQ(nearest({0x101, 0x111, 0x201, 0x311}), 0x100U);
}

TEST(Callers, CallersWithoutALineAreNamedWhenNoneHasOne) {
  EXPECT_EQ(nearest({0x901, 0x301}), 0x300U);
  EXPECT_EQ(nearest({0x901, 0x101}), 0x100U);
  EXPECT_EQ(nearest({0x901, 0x911}), 0x900U);
}

TEST(Callers, SameAddressesHaveTheSameNumber) {
  Callers callers;
  const std::uint32_t one = callers.number({0x301});
  EXPECT_NE(callers.number({0x301, 0x311}), one);
  EXPECT_EQ(callers.number({0x301}), one);
}

}  // namespace
}  // namespace dsdpv1::user_cpu
