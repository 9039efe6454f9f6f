#pragma once
// A TCP port that others connect to. No call here blocks.
#include <string>

#include "io/input/descriptor.hpp"

namespace dsdpv1::tb {

struct TcpOptions {
  int backlog = 4;  ///< connections that the system keeps until they are accepted
  /// The system buffers some 90 KB to 1 MB of unread data instead of 4 MB. So the other side blocks sooner, and if it
  /// is killed, its end, which follows all of its data, is seen sooner.
  bool little_buffered = false;
};

class TcpListener {
 public:
  /// Listens at the numeric IPv4 address `bind`; port 0 is any free one. Throws InputError, which begins with `who`,
  /// when that fails.
  TcpListener(const std::string& who, const std::string& bind, int port, const TcpOptions& options = {});

  /// The port in use.
  int port() const { return port_; }
  /// "127.0.0.1:2331"
  const std::string& address() const { return address_; }
  /// For poll(2).
  int descriptor() const { return listener_.get(); }

  struct Connection {
    int descriptor;    ///< the caller closes it; -1: no connection
    std::string from;  ///< address of the other side, as address()
  };
  /// The next connection: not blocking, bytes go out at once (TCP_NODELAY).
  Connection accept();

 private:
  Descriptor listener_;
  int port_;
  std::string address_;
};

}  // namespace dsdpv1::tb
