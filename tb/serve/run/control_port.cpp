#include "tb/serve/run/control_port.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace dsdpv1::tb::serve {
namespace {

bool answer(int connection, const std::string& text) {
  const std::string line = text + "\n";
  return ::send(connection, line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size());
}

/// Answers that, and is false. The rest of the line is read: a connection closed before would take the answer along.
bool too_long(int connection) {
  std::array<char, 4096> rest{};
  for (int i = 0; i < 16 && ::read(connection, rest.data(), rest.size()) > 0; ++i) {
  }
  answer(connection, fmt::format("a line of more than {} bytes, expected at most so many", ControlPort::kMostLine));
  return false;
}

}  // namespace

void ControlPort::look(const std::function<std::string(const std::string&)>& carry_out) {
  while (peers_.size() < kMostPeers) {
    Descriptor connection(listener_.accept().descriptor);
    if (!connection) break;
    peers_.push_back({std::move(connection)});
  }
  const auto gone = [&carry_out](Peer& peer) { return !serve(peer, carry_out); };
  peers_.erase(std::remove_if(peers_.begin(), peers_.end(), gone), peers_.end());
}

/// Reads once, so that no peer delays simulated time. False: the peer has gone.
bool ControlPort::serve(Peer& peer, const std::function<std::string(const std::string&)>& carry_out) {
  std::array<char, 4096> read{};
  const ssize_t count = ::read(peer.connection.get(), read.data(), read.size());
  if (count < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
  if (count == 0) return false;
  peer.unread.append(read.data(), static_cast<std::size_t>(count));
  for (std::size_t end = peer.unread.find('\n'); end != std::string::npos; end = peer.unread.find('\n')) {
    const std::string line = peer.unread.substr(0, end);
    peer.unread.erase(0, end + 1);
    if (line.size() > kMostLine) return too_long(peer.connection.get());
    if (!answer(peer.connection.get(), carry_out(line))) return false;
  }
  return peer.unread.size() <= kMostLine || too_long(peer.connection.get());
}

}  // namespace dsdpv1::tb::serve
