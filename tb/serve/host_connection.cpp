#include "tb/serve/host_connection.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace dsdpv1::tb::serve {

namespace {

bool for_later(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

bool left_to_read(int fd) {
  int count = 0;
  return ::ioctl(fd, FIONREAD, &count) == 0 && count != 0;
}

}  // namespace

/// The events that poll always reports, including the end of a connection.
bool hung_up(int fd) {
  pollfd other{fd, POLLRDHUP, 0};
  return ::poll(&other, 1, 0) > 0;
}

void HostConnection::set_peer(int fd) {
  peer_ = fd;
  last_bytes_ = std::chrono::steady_clock::now();
  heard_ = last_read_ = told_of_loss_ = false;
  kept_.clear();
  marked_.clear();
}

std::chrono::steady_clock::time_point HostConnection::silent_since() const {
  return left_to_read(peer_) ? std::chrono::steady_clock::now() : last_bytes_;
}

void HostConnection::drop_peer() {
  set_peer(-1);
  on_gone();
}

void HostConnection::forget_peer(const std::string& why) {
  set_peer(-1);
  lost(why);
  on_gone();
}

bus::Bytes HostConnection::receive(std::size_t most) {
  look();
  const bool gone = has_peer() && hung_up(peer_);
  if (!gone) last_read_ = false;
  if (gone && (most == 0 || std::exchange(last_read_, true))) forget_peer("");
  bus::Bytes bytes = read(most);
  if (!bytes.empty()) {
    last_bytes_ = std::chrono::steady_clock::now();
    if (!std::exchange(heard_, true)) first_bytes();
  }
  wrong_.clear();
  if (marks()) take_marks(bytes);
  if (!gone) flush();
  if (!has_peer()) {
    bytes.clear();
    wrong_.clear();
  }
  return bytes;
}

void HostConnection::take_marks(bus::Bytes& bytes) {
  std::size_t count = 0;
  for (const std::uint8_t read : bytes) {
    const std::optional<MarkedBytes::Byte> byte = marked_.take(read);
    if (!byte) continue;
    if (byte->wrong) wrong_.push_back(count);
    bytes[count++] = byte->value;
  }
  bytes.resize(count);
}

bus::Bytes HostConnection::read(std::size_t most) {
  bus::Bytes bytes(most);
  std::size_t got = 0;
  while (has_peer() && got < most) {
    const ssize_t count = ::read(peer_, bytes.data() + got, most - got);
    if (count < 0 && for_later(errno)) break;
    if (count <= 0 && got != 0) break;  // first return the bytes that it left
    // A pseudo-terminal reports the close of its other end as EIO.
    if (count <= 0) forget_peer(count == 0 || errno == EIO || errno == ECONNRESET ? "" : std::strerror(errno));
    got += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  bytes.resize(has_peer() ? got : 0);
  return bytes;
}

void HostConnection::check_peer() {
  if (has_peer() && hung_up(peer_) && (last_read_ || !left_to_read(peer_))) forget_peer("");
}

void HostConnection::send(const bus::Bytes& bytes) {
  if (!has_peer() || bytes.empty() || told_of_loss_) return;
  if (kept_.size() + bytes.size() > kMostKept) {
    told_of_loss_ = true;
    return say(fmt::format("{}: the host does not read: what it is sent is thrown away from now on", name()));
  }
  kept_.push(bytes);
  flush();
}

void HostConnection::flush() {
  if (!has_peer() || kept_.empty()) return;
  before_write();
  std::size_t written = 0;
  while (written < kept_.size()) {
    const ssize_t count = ::write(peer_, kept_.data() + written, kept_.size() - written);
    if (count < 0 && !for_later(errno))
      return forget_peer(errno == EIO || errno == EPIPE || errno == ECONNRESET ? "" : std::strerror(errno));
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  kept_.drop(written);
  after_write();
}

pollfd HostConnection::watched(bool reading) const {
  return {peer_, static_cast<short>((reading ? POLLIN : 0) | (kept_.empty() ? 0 : POLLOUT)), 0};
}

}  // namespace dsdpv1::tb::serve
