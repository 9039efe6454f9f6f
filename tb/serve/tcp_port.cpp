// A TCP port: each byte of the connection is a character of the segment.
#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "tb/scenario/input_error.hpp"
#include "tb/serve/ports.hpp"

namespace tb::serve {
namespace {

sockaddr_in address_of(const std::string& bind, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, bind.c_str(), &address.sin_addr) != 1) {
    throw InputError(
        fmt::format("dsdpv1-sim serve: --bind is {}, allowed is an IPv4 address such as 127.0.0.1 or 0.0.0.0", bind));
  }
  return address;
}

std::string text_of(const sockaddr_in& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &address.sin_addr, text.data(), static_cast<socklen_t>(text.size()));
  return fmt::format("{}:{}", text.data(), ntohs(address.sin_port));
}

int listen_at(const sockaddr_in& address) {
  Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (!listener || ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener.get(), 4) != 0) {
    throw InputError(fmt::format("dsdpv1-sim serve: TCP port {} cannot be had: {}, allowed is a free one",
                                 text_of(address), std::strerror(errno)));
  }
  return listener.release();
}

class TcpPort : public HostPort {
 public:
  TcpPort(const std::string& bind, int port) : listener_(listen_at(address_of(bind, port))) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size);  // port 0: which one it has become
    name_ = "TCP port " + text_of(address);
  }

  std::string name() const override { return name_; }
  pollfd watched() const override { return has_peer() ? HostPort::watched() : pollfd{listener_.get(), POLLIN, 0}; }

 protected:
  void look() override {
    if (has_peer()) return;
    sockaddr_in from{};
    socklen_t size = sizeof from;
    host_.reset(::accept4(listener_.get(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!host_) return;
    const int on = 1;
    ::setsockopt(host_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    set_peer(host_.get());
    say(fmt::format("{}: {} has connected", name(), text_of(from)));
  }

  void lost(const std::string& why) override {
    host_.reset();
    say(fmt::format("{}: the host hung up{}; the next one may connect", name(), why.empty() ? "" : " (" + why + ")"));
  }

 private:
  Descriptor listener_, host_;
  std::string name_;
};

}  // namespace

std::unique_ptr<HostPort> open_tcp(const std::string& bind, int port) { return std::make_unique<TcpPort>(bind, port); }

}  // namespace tb::serve
