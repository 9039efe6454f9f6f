// A TCP port: each byte of the connection is a character of the segment. One host uses it; others wait for their turn.
#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <utility>

#include "io/socket/tcp_listener.hpp"
#include "tb/serve/ports.hpp"

namespace dsdpv1::tb::serve {
namespace {

using Clock = std::chrono::steady_clock;

/// A connected host.
struct Host {
  std::string address;
  Descriptor connection;
  Clock::time_point came = Clock::now();
};

/// Resets the connection, so that the peer sees a fault, not an end, and the system keeps nothing of it.
void reset_at_close(int connection) {
  const linger at_once{1, 0};
  ::setsockopt(connection, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
}

class TcpPort : public HostConnection {
 public:
  TcpPort(const std::string& bind, int port, std::chrono::seconds turn)
      : listener_("dsdpv1-sim serve", bind, port, {kBacklog, true}), turn_(turn) {}

  std::string name() const override { return "TCP port " + listener_.address(); }
  pollfd watched(bool reading) const override {
    return has_peer() ? HostConnection::watched(reading) : pollfd{listener_.descriptor(), POLLIN, 0};
  }

 protected:
  void look() override {
    forget_gone();
    accept_all();
    if (has_peer() && its_turn_is_over()) end_turn();
    if (!has_peer() && !waiting_.empty()) take_next();
  }

  void lost(const std::string& why) override {
    host_.reset();
    say(fmt::format("{}: the host hung up{}; the next one may connect", name(), why.empty() ? "" : " (" + why + ")"));
  }

 private:
  static constexpr std::size_t kMostWaiting = 16;  ///< hosts
  static constexpr int kBacklog = 128;             ///< arrivals within one poll, even a late one
  static constexpr int kMostAtOnce = 64;           ///< limits the effect of a storm on the simulation

  void accept_all() {
    for (int i = 0; i < kMostAtOnce; ++i) {
      const auto [descriptor, from] = listener_.accept();
      if (descriptor < 0) return;
      arrived(descriptor, from);
    }
  }

  void arrived(int descriptor, const std::string& from) {
    Descriptor connection(descriptor);
    check_peer();  // so that a host that reconnects need not wait
    if (waiting_.size() >= kMostWaiting) forget_gone();
    if (!has_peer() && waiting_.empty()) {
      begin(std::move(connection));
      say(fmt::format("{}: {} has connected", name(), from));
    } else if (waiting_.size() < kMostWaiting) {
      waiting_.push_back(Host{from, std::move(connection)});
      say(fmt::format("{}: {} waits, {} of {}: another host has the port", name(), from, waiting_.size(),
                      kMostWaiting));
    } else {
      reset_at_close(connection.get());
      say(fmt::format("{}: {} is refused: {} hosts wait already", name(), from, kMostWaiting));
    }
  }

  void forget_gone() {
    for (auto host = waiting_.begin(); host != waiting_.end();) {
      if (!hung_up(host->connection.get())) {
        ++host;
        continue;
      }
      say(fmt::format("{}: {} hung up while it waited", name(), host->address));
      host = waiting_.erase(host);
    }
  }

  /// True if the host has been silent for `turn_` while another waited: it may be dead or abandoned.
  bool its_turn_is_over() const {
    return turn_.count() != 0 && !waiting_.empty() &&
           Clock::now() - std::max(silent_since(), waiting_.front().came) >= turn_;
  }

  void end_turn() {
    reset_at_close(host_.get());
    host_.reset();
    say(fmt::format("{}: the host has sent nothing for {} s while others waited: its turn is over", name(),
                    turn_.count()));
    drop_peer();
  }

  void take_next() {
    Host next = std::move(waiting_.front());
    waiting_.pop_front();
    begin(std::move(next.connection));
    say(fmt::format("{}: {} has waited and has its turn", name(), next.address));
  }

  void begin(Descriptor connection) {
    host_ = std::move(connection);
    set_peer(host_.get());
  }

  TcpListener listener_;
  std::chrono::seconds turn_;
  Descriptor host_;
  std::deque<Host> waiting_;  ///< in the order of their arrival
};

}  // namespace

std::unique_ptr<HostConnection> open_tcp(const std::string& bind, int port, std::chrono::seconds turn) {
  return std::make_unique<TcpPort>(bind, port, turn);
}

}  // namespace dsdpv1::tb::serve
