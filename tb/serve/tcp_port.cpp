// A TCP port: each byte of the connection is a character of the segment.
#include <fmt/format.h>

#include "tb/serve/ports.hpp"
#include "tb/socket/tcp_listener.hpp"

namespace tb::serve {
namespace {

class TcpPort : public HostPort {
 public:
  TcpPort(const std::string& bind, int port) : listener_("dsdpv1-sim serve", bind, port) {}

  std::string name() const override { return "TCP port " + listener_.address(); }
  pollfd watched() const override {
    return has_peer() ? HostPort::watched() : pollfd{listener_.descriptor(), POLLIN, 0};
  }

 protected:
  void look() override {
    if (has_peer()) return;
    const auto [descriptor, from] = listener_.accept();
    if (descriptor < 0) return;
    host_.reset(descriptor);
    set_peer(host_.get());
    say(fmt::format("{}: {} has connected", name(), from));
  }

  void lost(const std::string& why) override {
    host_.reset();
    say(fmt::format("{}: the host hung up{}; the next one may connect", name(), why.empty() ? "" : " (" + why + ")"));
  }

 private:
  TcpListener listener_;
  Descriptor host_;
};

}  // namespace

std::unique_ptr<HostPort> open_tcp(const std::string& bind, int port) { return std::make_unique<TcpPort>(bind, port); }

}  // namespace tb::serve
