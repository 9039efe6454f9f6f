#pragma once
// A TCP port at 127.0.0.1 for commands while serve runs: each line is answered with one line.
#include <functional>
#include <string>
#include <vector>

#include "io/socket/tcp_listener.hpp"

namespace dsdpv1::tb::serve {

class ControlPort {
 public:
  static constexpr std::size_t kMostLine = 64 * 1024;  ///< bytes, without the line end
  static constexpr std::size_t kMostPeers = 16;        ///< further ones wait in the system

  /// `port` 0: any free one. Throws InputError if it cannot be had.
  explicit ControlPort(int port) : listener_("dsdpv1-sim serve: --control", "127.0.0.1", port) {}
  /// "127.0.0.1:5021"
  const std::string& address() const { return listener_.address(); }
  /// Accepts, reads and answers what is there, without waiting: `carry_out` makes the answer to a line, without a line
  /// end. A peer that sends a longer line, or does not read its answers, gets an error and is disconnected.
  void look(const std::function<std::string(const std::string& line)>& carry_out);

 private:
  struct Peer {
    Descriptor connection;
    std::string unread = {};  ///< an incomplete line
  };
  static bool serve(Peer& peer, const std::function<std::string(const std::string&)>& carry_out);

  TcpListener listener_;
  std::vector<Peer> peers_;
};

}  // namespace dsdpv1::tb::serve
