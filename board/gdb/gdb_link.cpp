#include "board/gdb/gdb_link.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>

namespace dsdpv1::arm {
namespace {

/// gdb reads at once; one that does not read for so long (real time) counts as gone.
constexpr int kLongestWriteMs = 5000;

bool for_later(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

void GdbLink::look(int milliseconds) {
  std::array<pollfd, 2> wanted{{{listener_.descriptor(), POLLIN, 0}, {gdb_.get(), POLLIN, 0}}};
  if (::poll(wanted.data(), wanted.size(), milliseconds) <= 0) return;
  // A newcomer waits while there is something from the present gdb: it may be that it has gone.
  if (wanted[1].revents != 0)
    receive();
  else
    accept();
}

void GdbLink::accept() {
  const auto [descriptor, from] = listener_.accept();
  tb::Descriptor newcomer(descriptor);
  if (!newcomer) return;
  if (connected()) {
    if (!std::exchange(told_, true)) say_(from + " is turned away: one gdb at a time");
    return;
  }
  gdb_ = std::move(newcomer);
  told_ = false;
  reader_ = GdbReader();
  last_.clear();
  acknowledge_ = true;
}

void GdbLink::receive() {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::recv(gdb_.get(), bytes.data(), bytes.size(), 0);
  if (count > 0)
    reader_.take({bytes.data(), static_cast<std::size_t>(count)});
  else if (count == 0 || !for_later(errno))
    close();
}

std::optional<GdbInput> GdbLink::next() {
  while (auto input = reader_.next()) {
    switch (input->kind) {
      case GdbInput::Kind::kPacket:
        if (acknowledge_) write("+");
        return input;
      case GdbInput::Kind::kInterrupt: return input;
      case GdbInput::Kind::kWrongChecksum: write("-"); break;
      case GdbInput::Kind::kRepeat: write(last_); break;
    }
  }
  return std::nullopt;
}

void GdbLink::send(std::string_view payload) {
  last_ = gdb_frame(payload);
  write(last_);
}

void GdbLink::write(std::string_view bytes) {
  while (!bytes.empty() && connected()) {
    const ssize_t count = ::send(gdb_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
      continue;
    }
    pollfd wanted{gdb_.get(), POLLOUT, 0};
    if (!for_later(errno) || ::poll(&wanted, 1, kLongestWriteMs) <= 0) close();
  }
}

void GdbLink::close() {
  gdb_.reset();
  reader_ = GdbReader();
}

}  // namespace dsdpv1::arm
