#include "io/waves/child_stream.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "io/output/nowhere.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kPipeBuffer = std::size_t{1} << 16U;  // capacity of a pipe

/// The child drops the parent's signal handlers and skips its exit handlers.
[[noreturn]] void tell_and_end(const std::function<void(std::FILE*)>& tell, int to) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int each : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(each, SIG_DFL);
  if (!send_nowhere(STDERR_FILENO)) ::_exit(1);
  std::FILE* const file = ::fdopen(to, "wb");
  if (file == nullptr) ::_exit(1);
  std::setvbuf(file, nullptr, _IOFBF, kPipeBuffer);
  tell(file);
  ::_exit(std::fclose(file) == 0 ? 0 : 1);
}

}  // namespace

ChildStream::ChildStream(const std::function<void(std::FILE*)>& tell) : buffer_(kPipeBuffer) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  pipe_.reset(ends[0]);
  Descriptor to(ends[1]);
  child_ = ::fork();
  if (child_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child_ == 0) tell_and_end(tell, to.release());
}

ChildStream::~ChildStream() {
  pipe_.reset();
  ::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildStream::read_more(char* to, std::size_t size) {
  while (size != 0) {
    if (at_ == have_) {
      const ssize_t got = ::read(pipe_.get(), buffer_.data(), buffer_.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at_ = 0;
      have_ = static_cast<std::size_t>(got);
    }
    const std::size_t part = std::min(size, have_ - at_);
    std::memcpy(to, buffer_.data() + at_, part);
    at_ += part;
    to += part;
    size -= part;
  }
  return true;
}

}  // namespace dsdpv1::tb
