#pragma once
// Where the host's bytes come from and go to: a file descriptor that is never waited for, with somebody at its other end or not.
#include <poll.h>

#include <cstddef>
#include <functional>
#include <string>

#include "bus/bytes.hpp"
#include "tb/input/descriptor.hpp"

namespace tb::serve {

class HostPort {
 public:
  /// Output that a host has not read is kept up to this size.
  static constexpr std::size_t kMostKept = 1U << 20;

  virtual ~HostPort() = default;
  HostPort(const HostPort&) = delete;
  HostPort& operator=(const HostPort&) = delete;

  /// "pseudo-terminal /dev/pts/3", for messages.
  virtual std::string name() const = 0;
  /// A UART gives the characters their times, on both ways; else bytes have none.
  virtual bool timed() const { return false; }

  /// What has come since the last call. Also looks after comings and goings of the peer.
  bus::Bytes receive();
  /// Hands over to the peer, at once or as soon as it takes more; without a peer nobody hears it.
  void send(const bus::Bytes& bytes);
  /// For poll(2): what to wait for; the descriptor is -1 while there is no peer.
  virtual pollfd watched() const;

  /// One line for the user about comings, goings and losses.
  std::function<void(const std::string&)> say = [](const std::string&) {};

 protected:
  HostPort() = default;
  /// Accepts, reopens, and whatever else is due.
  virtual void look() = 0;
  /// The peer has gone, `why` in words; the port waits for the next one.
  virtual void lost(const std::string& why) = 0;
  /// The first bytes of a peer have come.
  virtual void first_bytes() {}
  /// Called around a write that goes out on a wire.
  virtual void before_write() {}
  virtual void after_write() {}

  bool has_peer() const { return peer_ >= 0; }
  int peer() const { return peer_; }
  void set_peer(int fd);

 private:
  void flush();
  void forget_peer(const std::string& why);

  int peer_ = -1;
  bool heard_ = false, told_of_loss_ = false;
  bus::Bytes kept_;  ///< not yet taken by the peer
};

}  // namespace tb::serve
