#pragma once
// The connection with gdb: one at a time, over TCP, on this machine only.
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "board/gdb/gdb_packet.hpp"
#include "io/input/descriptor.hpp"
#include "io/socket/tcp_listener.hpp"

namespace dsdpv1::arm {

class GdbLink {
 public:
  /// Listens at 127.0.0.1; port 0 is any free one. Throws tb::InputError when the port cannot be had.
  GdbLink(int port, std::function<void(const std::string&)> say)
      : listener_("--gdb", "127.0.0.1", port), say_(std::move(say)) {}

  int port() const { return listener_.port(); }
  bool connected() const { return static_cast<bool>(gdb_); }

  /// Takes in what has come, connections too; waits up to `milliseconds` (real time) for something, or for a signal. A
  /// second gdb is turned away, with one line for as long as the first one is there.
  void look(int milliseconds);
  /// The next packet, or Ctrl-C. Acknowledges, asks for repetition and repeats as the protocol wants.
  std::optional<GdbInput> next();
  void send(std::string_view payload);
  /// From now on neither side acknowledges (QStartNoAckMode).
  void stop_acknowledging() { acknowledge_ = false; }
  void close();

 private:
  void accept();
  void receive();
  void write(std::string_view bytes);

  tb::TcpListener listener_;
  std::function<void(const std::string&)> say_;
  tb::Descriptor gdb_;
  GdbReader reader_;
  std::string last_;  ///< as it was sent, for repetition
  bool acknowledge_ = true, told_ = false;
};

}  // namespace dsdpv1::arm
