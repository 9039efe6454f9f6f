#pragma once
// Serial line settings with any baud rate (Linux termios2), in a separate file because its header conflicts with
// <termios.h>.
namespace dsdpv1::tb::serve {

/// Raw, 8 data bits, even parity, 1 stop bit, modem lines ignored, `bits_per_second`; characters with errors come
/// marked (MarkedBytes). Returns false, with errno, if the device refuses.
bool set_8e1(int fd, int bits_per_second);
/// True if the device has taken set_8e1 as it was asked, as far as it says, within 2 % of the rate.
bool is_8e1(int fd, int bits_per_second);
/// Raw: bytes pass through unchanged; other settings are kept. Returns false, with errno, on failure.
bool set_raw(int fd);
/// The present speed, for a pseudo-terminal that of its slave; 0 if unknown.
int speed_of(int fd);
/// Sets the lowest latency that the driver offers (USB adapters: 1 ms instead of 16). Has no effect on other drivers.
void ask_for_low_latency(int fd);
/// Lets the driver switch RTS while it sends. Returns false if it cannot, or has taken something else.
bool let_driver_switch_rts(int fd);
/// Sets RTS. Returns false, with errno, on failure.
bool set_rts(int fd, bool level);
/// Reserves the device exclusively from now on. Returns false if it is already reserved.
bool take_alone(int fd);
/// Discards received bytes that were not read. Does nothing if that is impossible.
void discard_input(int fd);
/// Waits until the last stop bit was sent. Returns false, with errno, on failure.
bool drain(int fd);

}  // namespace dsdpv1::tb::serve
