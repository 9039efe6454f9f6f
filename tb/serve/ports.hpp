#pragma once
// The three kinds of ports. Each function throws InputError in one line if the port cannot be opened.
#include <chrono>
#include <memory>
#include <string>

#include "tb/serve/framing.hpp"
#include "tb/serve/host_connection.hpp"

namespace dsdpv1::tb::serve {

/// A pseudo-terminal; `link` is a symbolic link to it, removed at the end; empty: none. Warns if the host sets another
/// speed than `bits_per_second`; 0: any is right.
std::unique_ptr<HostConnection> open_pty(const std::string& link, int bits_per_second);

/// A TCP port at the numeric address `bind`, one host at a time: others are accepted and wait for their turn in order
/// of arrival without being read. At most 16 wait; further connections are reset. So is that of a host that has sent
/// nothing for `turn` while others waited; 0 s: it keeps the port.
std::unique_ptr<HostConnection> open_tcp(const std::string& bind, int port, std::chrono::seconds turn);

struct SerialOptions {
  std::string device;
  int bits_per_second = 19200;
  bool rts = false;  ///< RTS switches the RS-485 driver; else the adapter does it automatically
};
std::unique_ptr<HostConnection> open_serial(const SerialOptions& options);

}  // namespace dsdpv1::tb::serve
