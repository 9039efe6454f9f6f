// The settings of a serial port, at a driver that is asked in place of the system's.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <gtest/gtest.h>
#include <linux/serial.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <optional>

#include "tb/serve/termios2.hpp"

namespace {

constexpr int kPort = 1 << 20;  ///< no descriptor of the system has this number

/// A driver that keeps what it is given, with its own mind.
struct Driver {
  termios2 settings{};
  serial_rs485 rs485{};
  bool takes_rs485 = true, says_rs485 = true, keeps_rts_on_send = true;

  int set_rs485(const serial_rs485& wanted) {
    if (!takes_rs485) return -1;
    rs485 = wanted;
    if (!keeps_rts_on_send) rs485.flags &= ~static_cast<__u32>(SER_RS485_RTS_ON_SEND);
    return 0;
  }
};
Driver* driver = nullptr;

int asked(unsigned long request, void* argument) {
  switch (request) {
    case TCGETS2: *static_cast<termios2*>(argument) = driver->settings; return 0;
    case TCSETS2: driver->settings = *static_cast<termios2*>(argument); return 0;
    case TIOCSRS485: return driver->set_rs485(*static_cast<serial_rs485*>(argument));
    case TIOCGRS485:
      if (driver->says_rs485) *static_cast<serial_rs485*>(argument) = driver->rs485;
      return driver->says_rs485 ? 0 : -1;
    default: return -1;
  }
}

}  // namespace

/// For the whole program instead of the C library's; other descriptors go to the system.
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list list;
  va_start(list, request);
  void* const argument = va_arg(list, void*);
  va_end(list);
  return fd == kPort ? asked(request, argument) : static_cast<int>(::syscall(SYS_ioctl, fd, request, argument));
}

namespace dsdpv1 {
namespace {

using namespace tb::serve;

class SerialSettings : public testing::Test {
 protected:
  SerialSettings() { driver = &driver_; }
  Driver driver_;
};

TEST_F(SerialSettings, AreReadBack) {
  ASSERT_TRUE(set_8e1(kPort, 187500));
  EXPECT_TRUE(is_8e1(kPort, 187500));
  EXPECT_EQ(driver_.settings.c_iflag & (INPCK | PARMRK | IGNPAR | ISTRIP), static_cast<tcflag_t>(INPCK | PARMRK));
  EXPECT_TRUE(is_8e1(kPort, 190000)) << "within 2 %";
  EXPECT_FALSE(is_8e1(kPort, 192000));
  for (const int changed : {PARENB, PARODD, CSTOPB, CS8 ^ CS7}) {
    driver_.settings.c_cflag ^= static_cast<tcflag_t>(changed);
    EXPECT_FALSE(is_8e1(kPort, 187500)) << changed;
    driver_.settings.c_cflag ^= static_cast<tcflag_t>(changed);
  }
}

TEST_F(SerialSettings, ADriverSwitchesRtsOnlyIfItHasTakenTheMode) {
  EXPECT_TRUE(let_driver_switch_rts(kPort));
  driver_.says_rs485 = false;
  EXPECT_TRUE(let_driver_switch_rts(kPort)) << "it does not say";
  driver_.says_rs485 = true;
  driver_.keeps_rts_on_send = false;
  EXPECT_FALSE(let_driver_switch_rts(kPort));
  EXPECT_EQ(driver_.rs485.flags, 0U) << "it is switched off again";
  driver_.takes_rs485 = false;
  EXPECT_FALSE(let_driver_switch_rts(kPort));
}

}  // namespace
}  // namespace dsdpv1
