#pragma once
// Where the host's bytes come from and go to: a file descriptor that is never waited for, with somebody at its other
// end or not.
#include <poll.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include "bus/bytes.hpp"
#include "io/input/descriptor.hpp"
#include "tb/serve/byte_queue.hpp"

namespace dsdpv1::tb::serve {

/// The other end has gone, whatever it has left to be read.
bool hung_up(int fd);

class HostConnection {
 public:
  /// Output that a host has not read is kept up to this size.
  static constexpr std::size_t kMostKept = 1U << 20;

  virtual ~HostConnection() = default;
  HostConnection(const HostConnection&) = delete;
  HostConnection& operator=(const HostConnection&) = delete;

  /// "pseudo-terminal /dev/pts/3", for messages.
  virtual std::string name() const = 0;
  /// A UART gives the characters their times, on both ways; else bytes have none.
  virtual bool timed() const { return false; }

  /// What has come, at most `most` bytes: the rest waits where it is, with the peer in the end. Also looks after
  /// comings and goings of the peer; of one that has gone, what can be read at once is the last.
  bus::Bytes receive(std::size_t most);
  /// Hands over to the peer, at once or as soon as it takes more; without a peer nobody hears it.
  void send(const bus::Bytes& bytes);
  /// For poll(2): what to wait for, bytes of the peer only while `reading`; the descriptor is -1 while there is no
  /// peer.
  virtual pollfd watched(bool reading) const;

  /// One line for the user about comings, goings and losses.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  /// The peer has gone: what was meant for it is for nobody, and so is half a telegram.
  std::function<void()> on_gone = [] {};

 protected:
  HostConnection() = default;
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
  /// Since when nothing has come of the peer: its last bytes, its beginning, or now while there is something to read.
  std::chrono::steady_clock::time_point silent_since() const;
  /// The port is done with the peer.
  void drop_peer();
  /// Lets the peer go when it has hung up and left nothing; that shows also when it is not read from now.
  void check_peer();

 private:
  bus::Bytes read(std::size_t most);
  void flush();
  void forget_peer(const std::string& why);

  int peer_ = -1;
  std::chrono::steady_clock::time_point last_bytes_;
  bool heard_ = false, told_of_loss_ = false;
  bool last_read_ = false;  ///< it has gone and what it left was read
  ByteQueue kept_;          ///< not yet taken by the peer
};

}  // namespace dsdpv1::tb::serve
