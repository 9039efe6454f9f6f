// A pseudo-terminal whose slave side the host opens as a serial port.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include "io/input/input_error.hpp"
#include "io/output/part_file.hpp"
#include "tb/serve/ports.hpp"
#include "tb/serve/termios2.hpp"

namespace dsdpv1::tb::serve {
namespace {

namespace fs = std::filesystem;

/// A symbolic link during the object's lifetime.
class Link {
 public:
  Link(const std::string& path, const std::string& target) : path_(path), target_(target) {
    if (path.empty()) return;
    // A link left by a killed run points to a pseudo-terminal that no longer exists, or that is now this one.
    std::error_code error;
    const fs::path left = fs::read_symlink(path, error);
    if (!error && (!fs::exists(path, error) || left == target)) fs::remove(path, error);
    if (::symlink(target.c_str(), path.c_str()) != 0) {
      const std::string hint =
          errno == EEXIST ? ", expected a name that is free; delete it if a run that was killed has left it" : "";
      throw InputError(path, 0, std::string("cannot be made a link: ") + std::strerror(errno) + hint);
    }
    while_starting_.emplace(path);
  }
  ~Link() {
    std::error_code error;
    if (!path_.empty() && fs::read_symlink(path_, error) == fs::path(target_)) fs::remove(path_, error);
  }
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

 private:
  std::string path_, target_;
  std::optional<NameToRemove> while_starting_;  ///< removes the link if a signal ends the program
};

int open_master() {
  const int fd = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0 || ::grantpt(fd) != 0 || ::unlockpt(fd) != 0)
    throw InputError(std::string("no pseudo-terminal can be had: ") + std::strerror(errno));
  return fd;
}

std::string slave_name(int master) {
  std::array<char, 128> name{};
  if (::ptsname_r(master, name.data(), name.size()) != 0)
    throw InputError(std::string("the pseudo-terminal has no name: ") + std::strerror(errno));
  return name.data();
}

class PtyPort : public HostConnection {
 public:
  PtyPort(const std::string& link, int bits_per_second)
      : master_(open_master()),
        slave_(slave_name(master_.get())),
        link_(link, slave_),
        link_name_(link),
        speed_(bits_per_second) {
    set_raw(master_.get());
    // After being opened and closed once, the other end counts as hung up until a host opens it.
    const Descriptor once(open_slave());
  }

  std::string name() const override { return link_name_.empty() ? slave_ : fmt::format("{} ({})", link_name_, slave_); }

 protected:
  void look() override {
    if (has_peer()) return;
    pollfd other{master_.get(), POLLIN, 0};
    if (::poll(&other, 1, 0) < 0) return;
    const bool closed = (other.revents & POLLHUP) != 0, left = (other.revents & POLLIN) != 0;
    if (closed && !left) return;
    set_peer(master_.get());
    if (was_lost_) say(fmt::format("{}: opened again", name()));
  }

  void lost(const std::string& why) override {
    was_lost_ = true;
    set_raw(master_.get());
    // The kernel keeps data of both directions for the next opener.
    discard_input(master_.get());
    discard_input(Descriptor(open_slave()).get());
    say(fmt::format("{}: the host hung up{}; the next one may open it", name(), why.empty() ? "" : " (" + why + ")"));
  }

  void first_bytes() override {
    const int speed = speed_of(master_.get());
    if (speed == 0 || speed_ == 0 || std::abs(speed - speed_) * 50 <= speed_) return;
    say(
        fmt::format("{}: the host has set {} bit/s, the segment runs at {} (--baud); a pseudo-terminal passes the "
                    "bytes on all the same",
                    name(), speed, speed_));
  }

 private:
  int open_slave() const { return ::open(slave_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); }

  Descriptor master_;
  std::string slave_;
  Link link_;
  std::string link_name_;
  int speed_;
  bool was_lost_ = false;
};

}  // namespace

std::unique_ptr<HostConnection> open_pty(const std::string& link, int bits_per_second) {
  return std::make_unique<PtyPort>(link, bits_per_second);
}

}  // namespace dsdpv1::tb::serve
