#include "tb/serve/host_port.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace tb::serve {

namespace {
bool for_later(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }
}  // namespace

void HostPort::set_peer(int fd) {
  peer_ = fd;
  heard_ = told_of_loss_ = false;
  kept_.clear();
}

void HostPort::forget_peer(const std::string& why) {
  set_peer(-1);
  lost(why);
}

bus::Bytes HostPort::receive() {
  look();
  bus::Bytes bytes;
  std::array<std::uint8_t, 4096> buffer{};
  while (has_peer()) {
    const ssize_t count = ::read(peer_, buffer.data(), buffer.size());
    if (count > 0) {
      bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + count);
    } else if (count < 0 && for_later(errno)) {
      break;
    } else {
      // EIO is how a pseudo-terminal says that its other end was closed.
      forget_peer(count == 0 || errno == EIO || errno == ECONNRESET ? "" : std::strerror(errno));
    }
  }
  if (!bytes.empty() && !std::exchange(heard_, true) && has_peer()) first_bytes();
  flush();
  return bytes;
}

void HostPort::send(const bus::Bytes& bytes) {
  if (!has_peer() || bytes.empty()) return;
  if (kept_.size() + bytes.size() > kMostKept) {
    if (!std::exchange(told_of_loss_, true))
      say(fmt::format("{}: the host does not read: what it is sent is thrown away from now on", name()));
    return;
  }
  kept_.insert(kept_.end(), bytes.begin(), bytes.end());
  flush();
}

void HostPort::flush() {
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
  kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(written));
  after_write();
}

pollfd HostPort::watched() const { return {peer_, static_cast<short>(kept_.empty() ? POLLIN : POLLIN | POLLOUT), 0}; }

}  // namespace tb::serve
