#include "tb/serve/termios2.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <linux/serial.h>
#include <linux/tty_flags.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#ifndef TIOCM_RTS
#define TIOCM_RTS 0x004
#endif

namespace dsdpv1::tb::serve {
namespace {

using Flags = tcflag_t;

void make_raw(termios2& settings) {
  settings.c_iflag &=
      ~static_cast<Flags>(IGNBRK | BRKINT | PARMRK | INPCK | ISTRIP | INLCR | IGNCR | ICRNL | IXON | IXOFF);
  settings.c_oflag &= ~static_cast<Flags>(OPOST);
  settings.c_lflag &= ~static_cast<Flags>(ECHO | ECHONL | ICANON | ISIG | IEXTEN);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
}

/// It has no parity and takes none.
bool is_pseudo_terminal(int fd) {
  constexpr unsigned kFirst = 136, kLast = 143;  // major numbers of the slaves (Linux, devices.txt)
  struct stat found {};
  return fstat(fd, &found) == 0 && major(found.st_rdev) >= kFirst && major(found.st_rdev) <= kLast;
}

}  // namespace

bool set_8e1(int fd, int bits_per_second) {
  termios2 settings{};
  if (ioctl(fd, TCGETS2, &settings) != 0) return false;
  make_raw(settings);
  settings.c_iflag &= ~static_cast<Flags>(IGNPAR);
  settings.c_iflag |= static_cast<Flags>(INPCK | PARMRK);
  settings.c_cflag &= ~static_cast<Flags>(CSIZE | CSTOPB | PARODD | CMSPAR | CRTSCTS | CBAUD | (CBAUD << IBSHIFT));
  settings.c_cflag |= static_cast<Flags>(CS8 | PARENB | CLOCAL | CREAD | BOTHER | (BOTHER << IBSHIFT));
  settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(bits_per_second);
  return ioctl(fd, TCSETS2, &settings) == 0;
}

bool is_8e1(int fd, int bits_per_second) {
  termios2 settings{};
  if (ioctl(fd, TCGETS2, &settings) != 0) return false;
  const auto speed = static_cast<int>(settings.c_ospeed);
  const Flags parity = is_pseudo_terminal(fd) ? 0 : PARENB;
  return (settings.c_cflag & static_cast<Flags>(CSIZE | CSTOPB | PARODD | PARENB)) == (CS8 | parity) &&
         speed * 50 >= bits_per_second * 49 && speed * 50 <= bits_per_second * 51;
}

bool set_raw(int fd) {
  termios2 settings{};
  if (ioctl(fd, TCGETS2, &settings) != 0) return false;
  make_raw(settings);
  return ioctl(fd, TCSETS2, &settings) == 0;
}

int speed_of(int fd) {
  termios2 settings{};
  return ioctl(fd, TCGETS2, &settings) == 0 ? static_cast<int>(settings.c_ospeed) : 0;
}

void ask_for_low_latency(int fd) {
  serial_struct settings{};
  if (ioctl(fd, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= static_cast<int>(ASYNC_LOW_LATENCY);
  ioctl(fd, TIOCSSERIAL, &settings);
}

bool let_driver_switch_rts(int fd) {
  serial_rs485 settings{};
  settings.flags = SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND;
  constexpr auto kWanted = SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND;
  if (ioctl(fd, TIOCSRS485, &settings) != 0) return false;
  serial_rs485 taken{};
  if (ioctl(fd, TIOCGRS485, &taken) != 0) return true;  // it does not say
  if ((taken.flags & (kWanted | SER_RS485_RTS_AFTER_SEND)) == kWanted) return true;
  settings.flags = 0;
  ioctl(fd, TIOCSRS485, &settings);
  return false;
}

bool set_rts(int fd, bool level) {
  int lines = TIOCM_RTS;
  return ioctl(fd, level ? TIOCMBIS : TIOCMBIC, &lines) == 0;
}

bool take_alone(int fd) { return flock(fd, LOCK_EX | LOCK_NB) == 0 && ioctl(fd, TIOCEXCL) == 0; }

void discard_input(int fd) { ioctl(fd, TCFLSH, TCIFLUSH); }

bool drain(int fd) { return ioctl(fd, TCSBRK, 1) == 0; }

}  // namespace dsdpv1::tb::serve
