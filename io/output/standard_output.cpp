#include "io/output/standard_output.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <iostream>

namespace dsdpv1::tb {
namespace {

/// Another process that shares the channel may have made it non-blocking.
void wait_for_room() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  ::poll(&out, 1, -1);
  errno = EAGAIN;
}

}  // namespace

StandardOutput::StandardOutput() : before_(std::cout.rdbuf(this)) {
  setp(text_.data(), text_.data() + text_.size() - 1);  // one is for overflow's character
}

StandardOutput::~StandardOutput() {
  write_out();
  std::cout.rdbuf(before_);
}

bool StandardOutput::write_out() {
  for (const char* from = pbase(); from < pptr() && error_ == 0;) {
    const ssize_t written = ::write(STDOUT_FILENO, from, static_cast<std::size_t>(pptr() - from));
    if (written >= 0) from += written;
    if (written < 0 && errno == EAGAIN) wait_for_room();
    if (written < 0 && errno != EINTR && errno != EAGAIN) error_ = errno;
  }
  setp(text_.data(), text_.data() + text_.size() - 1);
  return error_ == 0;
}

StandardOutput::int_type StandardOutput::overflow(int_type character) {
  if (!traits_type::eq_int_type(character, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(character);
    pbump(1);
  }
  return write_out() ? traits_type::not_eof(character) : traits_type::eof();
}

int StandardOutput::sync() { return write_out() ? 0 : -1; }

int StandardOutput::finish() {
  write_out();
  return error_;
}

void fill_closed_channels() {
  for (const int channel : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(channel, F_GETFD) >= 0 || errno != EBADF) continue;
    ::open("/dev/null", channel == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // takes the lowest free number, this one
  }
}

}  // namespace dsdpv1::tb
