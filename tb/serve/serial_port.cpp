// A serial port with an RS-485 transceiver.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "io/input/input_error.hpp"
#include "tb/serve/ports.hpp"
#include "tb/serve/termios2.hpp"

namespace dsdpv1::tb::serve {
namespace {

class SerialPort : public HostConnection {
 public:
  explicit SerialPort(SerialOptions options) : options_(std::move(options)) {
    const std::string error = open();
    if (!error.empty()) throw InputError(options_.device, 0, error);
  }

  std::string name() const override { return "serial port " + options_.device; }
  bool timed() const override { return true; }
  bool marks() const override { return true; }

 protected:
  void look() override {
    if (has_peer() || WallClock::now() < retry_at_) return;
    retry_at_ = WallClock::now() + kRetry;
    if (open().empty()) say(fmt::format("{}: is back", name()));
  }

  void lost(const std::string& why) override {
    device_.reset();
    retry_at_ = WallClock::now() + kRetry;
    say(fmt::format("{}: is gone{}; it is opened again when it comes back", name(),
                    why.empty() ? "" : " (" + why + ")"));
  }

  void before_write() override {
    if (rts_by_hand_) set_rts(device_.get(), true);
  }
  void after_write() override {
    if (!rts_by_hand_) return;
    drain(device_.get());
    set_rts(device_.get(), false);
  }

 private:
  static constexpr std::chrono::milliseconds kRetry{500};

  /// Returns an empty text on success, else the error.
  std::string open() {
    const auto failed = [this](const std::string& text) {
      device_.reset();
      return text;
    };
    device_.reset(::open(options_.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!device_) return failed(std::string("cannot be opened: ") + std::strerror(errno));
    const int fd = device_.get();
    if (::isatty(fd) == 0) return failed("is no serial port, expected a terminal device such as /dev/ttyUSB0");
    if (!take_alone(fd)) return failed("is in use by another program");
    if (!set_8e1(fd, options_.bits_per_second))
      return failed(fmt::format("refuses {} bit/s 8E1: {}", options_.bits_per_second, std::strerror(errno)));
    ask_for_low_latency(fd);
    rts_by_hand_ = options_.rts && !let_driver_switch_rts(fd);
    if (!is_8e1(fd, options_.bits_per_second)) {  // after all that may have changed it
      return failed(fmt::format("offers {} bit/s instead of {}, or not 8E1, expected what its hardware can do (--baud)",
                                speed_of(fd), options_.bits_per_second));
    }
    if (rts_by_hand_ && !set_rts(fd, false)) return failed(std::string("has no RTS (--rts): ") + std::strerror(errno));
    set_peer(fd);
    return "";
  }

  SerialOptions options_;
  Descriptor device_;
  WallTime retry_at_{};
  bool rts_by_hand_ = false;
};

}  // namespace

std::unique_ptr<HostConnection> open_serial(const SerialOptions& options) {
  return std::make_unique<SerialPort>(options);
}

}  // namespace dsdpv1::tb::serve
