#include "io/socket/tcp_listener.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb {
namespace {

sockaddr_in address_of(const std::string& who, const std::string& bind, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, bind.c_str(), &address.sin_addr) != 1)
    throw InputError(fmt::format("{}: --bind is {}, expected an IPv4 address such as 127.0.0.1 or 0.0.0.0", who, bind));
  return address;
}

std::string text_of(const sockaddr_in& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &address.sin_addr, text.data(), static_cast<socklen_t>(text.size()));
  return fmt::format("{}:{}", text.data(), ntohs(address.sin_port));
}

/// The sender's own buffer grows with the size of segments, which is 64 KB within a computer.
void keep_buffers_little(int listener) {
  const int window = 2048, segment = 536;
  ::setsockopt(listener, SOL_SOCKET, SO_RCVBUF, &window, sizeof window);
  ::setsockopt(listener, IPPROTO_TCP, TCP_MAXSEG, &segment, sizeof segment);
}

int listen_at(const std::string& who, const sockaddr_in& address, const TcpOptions& options) {
  Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (options.little_buffered) keep_buffers_little(listener.get());
  if (!listener || ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener.get(), options.backlog) != 0) {
    throw InputError(fmt::format("{}: TCP port {} cannot be had: {}, expected a free one", who, text_of(address),
                                 std::strerror(errno)));
  }
  return listener.release();
}

/// A host whose computer has vanished would keep the port indefinitely. So it is probed after 30 s of silence and
/// dropped a minute later.
void notice_when_gone(int fd) {
  const int on = 1, idle_s = 30, interval_s = 10, tries = 6;
  ::setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPIDLE, &idle_s, sizeof idle_s);
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPINTVL, &interval_s, sizeof interval_s);
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPCNT, &tries, sizeof tries);
}

}  // namespace

TcpListener::TcpListener(const std::string& who, const std::string& bind, int port, const TcpOptions& options)
    : listener_(listen_at(who, address_of(who, bind, port), options)) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size);
  port_ = ntohs(address.sin_port);
  address_ = text_of(address);
}

TcpListener::Connection TcpListener::accept() {
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const int fd = ::accept4(listener_.get(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd < 0) return {-1, ""};
  const int on = 1;
  ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  notice_when_gone(fd);
  return {fd, text_of(from)};
}

}  // namespace dsdpv1::tb
