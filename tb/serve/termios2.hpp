#pragma once
// Serial line settings with any baud rate (Linux termios2), apart because its header does not go together with
// <termios.h>.
namespace dsdpv1::tb::serve {

/// Raw, 8 data bits, even parity, 1 stop bit, modem lines ignored, `bits_per_second`. False, with errno, when the
/// device refuses.
bool set_8e1(int fd, int bits_per_second);
/// Raw: bytes pass through unchanged; nothing else is touched. False, with errno, when that fails.
bool set_raw(int fd);
/// The speed that is set, for a pseudo-terminal that of its slave; 0 when it cannot be told.
int speed_of(int fd);
/// The least latency that the driver offers (USB adapters: 1 ms instead of 16). Drivers that cannot are left as they
/// are.
void ask_for_low_latency(int fd);
/// The driver switches RTS itself while it sends. False when it cannot.
bool let_driver_switch_rts(int fd);
/// RTS by hand. False, with errno, when that fails.
bool set_rts(int fd, bool level);
/// Nobody else may open the device from now on. False when somebody has it already.
bool take_alone(int fd);
/// Throws away what has come and was not read. Nothing happens when that cannot be done.
void discard_input(int fd);
/// Waits until the last stop bit has left. False, with errno, when that fails.
bool drain(int fd);

}  // namespace dsdpv1::tb::serve
