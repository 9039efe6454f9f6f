#include "io/waves/vcd_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kLeastRoom = std::size_t{64} << 10U, kMostRoom = std::size_t{8} << 20U;

constexpr std::array<bool, 256> blanks() {
  std::array<bool, 256> blank{};
  for (const char c : {' ', '\t', '\r', '\n', '\0'}) blank[static_cast<unsigned char>(c)] = true;
  return blank;
}

}  // namespace

const std::array<bool, 256> VcdText::kBlank = blanks();

VcdText::VcdText(const std::string& path) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (!file_) throw InputError(path, 0, what_is_wrong(errno) + ", expected a wave, VCD or FST");
  struct stat status {};
  if (::fstat(file_.get(), &status) == 0) size_ = static_cast<std::uint64_t>(status.st_size);
  // Room for all of a short file and its end; a pipe has no size and may be long.
  room_ =
      size_ == 0 ? kMostRoom : static_cast<std::size_t>(std::clamp<std::uint64_t>(size_ + 1, kLeastRoom, kMostRoom));
  buffer_.reset(new char[room_ + 1]);
  at_ = end_ = buffer_.get();
  fill();
}

/// Keeps the unread rest and reads more after it; a zero byte ends the buffer.
void VcdText::fill() {
  const auto rest = static_cast<std::size_t>(end_ - at_);
  std::memmove(buffer_.get(), at_, rest);
  std::size_t have = rest;
  while (have < room_ && !whole_) {
    const ssize_t got = ::read(file_.get(), buffer_.get() + have, room_ - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(path_, 0, what_is_wrong(errno) + ", expected a wave, VCD or FST");
    whole_ = got == 0;
    have += static_cast<std::size_t>(got);
    read_ += static_cast<std::uint64_t>(got);
  }
  at_ = buffer_.get();
  end_ = at_ + have;
  buffer_[have] = '\0';
}

void VcdText::check_word(const char* begin) const {
  if (at_ != end_) fail("has a zero byte here, expected the text of a VCD");
  if (!whole_) fail("has a word that is longer than any right one, expected the text of a VCD");
  if (begin != at_) fail("ends within a line, expected a complete VCD: was the simulator stopped while it wrote?");
}

void VcdText::fail(const std::string& what) const { throw InputError(path_, line_, what); }

double VcdText::share() const {
  if (size_ == 0) return 0;
  const auto taken = static_cast<double>(read_) - static_cast<double>(end_ - at_);
  return std::min(1.0, taken / static_cast<double>(size_));
}

}  // namespace dsdpv1::tb
