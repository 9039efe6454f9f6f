#pragma once
// The connection to the host's byte stream: a file descriptor that never blocks, with or without a peer.
#include <poll.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include "bus/bytes.hpp"
#include "io/input/descriptor.hpp"
#include "tb/serve/byte_queue.hpp"
#include "tb/serve/framing.hpp"

namespace dsdpv1::tb::serve {

/// The peer has gone, although bytes may be left to read.
bool hung_up(int fd);

class HostConnection {
 public:
  /// Limit of kept output that a host has not read.
  static constexpr std::size_t kMostKept = 1U << 20;

  virtual ~HostConnection() = default;
  HostConnection(const HostConnection&) = delete;
  HostConnection& operator=(const HostConnection&) = delete;

  /// "pseudo-terminal /dev/pts/3", for messages.
  virtual std::string name() const = 0;
  /// A UART gives the characters their times, in both directions; otherwise bytes have no times.
  virtual bool timed() const { return false; }

  /// Reads at most `most` received bytes: the rest stays in the system, and finally with the peer. Also handles the
  /// peer's arrival and departure; after a departure only bytes that can be read at once are returned.
  bus::Bytes receive(std::size_t most);
  /// The places in what receive() returned last of bytes with wrong parity or stop bit, if the driver tells them.
  const std::vector<std::size_t>& wrong() const { return wrong_; }
  /// Sends to the peer, at once or as soon as it accepts more; dropped without a peer.
  void send(const bus::Bytes& bytes);
  /// For poll(2): the events to wait for, bytes of the peer only while `reading`; the descriptor is -1 without a peer.
  virtual pollfd watched(bool reading) const;

  /// Prints one line for the user about connections and losses.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  /// Called when the peer has gone: drop data meant for it, and an incomplete telegram.
  std::function<void()> on_gone = [] {};

 protected:
  HostConnection() = default;
  /// Accepts, reopens, and other due work.
  virtual void look() = 0;
  /// The peer has gone, `why` as text; the port waits for the next one.
  virtual void lost(const std::string& why) = 0;
  /// The first bytes of a peer have arrived.
  virtual void first_bytes() {}
  /// The driver marks errors: FF and 00 have another meaning (MarkedBytes).
  virtual bool marks() const { return false; }
  /// Called around a write to a wire.
  virtual void before_write() {}
  virtual void after_write() {}

  bool has_peer() const { return peer_ >= 0; }
  int peer() const { return peer_; }
  void set_peer(int fd);
  /// The begin of the peer's silence: its last bytes, its connection, or now while there is something to read.
  std::chrono::steady_clock::time_point silent_since() const;
  /// Disconnects the peer.
  void drop_peer();
  /// Drops a peer that has hung up and left no bytes; called even while it is not being read.
  void check_peer();

 private:
  bus::Bytes read(std::size_t most);
  void take_marks(bus::Bytes& bytes);
  void flush();
  void forget_peer(const std::string& why);

  int peer_ = -1;
  std::chrono::steady_clock::time_point last_bytes_;
  bool heard_ = false, told_of_loss_ = false;
  bool last_read_ = false;  ///< it has gone and its last bytes were read
  ByteQueue kept_;          ///< not yet accepted by the peer
  MarkedBytes marked_;
  std::vector<std::size_t> wrong_;
};

}  // namespace dsdpv1::tb::serve
