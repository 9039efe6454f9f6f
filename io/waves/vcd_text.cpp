#include "io/waves/vcd_text.hpp"

#include <algorithm>
#include <cstring>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kLeastRoom = std::size_t{64} << 10U, kMostRoom = std::size_t{8} << 20U;

constexpr std::array<bool, 256> blanks() {
  std::array<bool, 256> blank{};
  for (const char c : {' ', '\t', '\r', '\n', '\0'}) blank[static_cast<unsigned char>(c)] = true;
  return blank;
}

/// The header's tag, or that of a file that is compressed as a whole.
bool is_fst_byte(char first) { return first == '\0' || first == '\xFE'; }

}  // namespace

const std::array<bool, 256> VcdText::kBlank = blanks();

VcdText::VcdText(const std::string& path) : path_(path), bytes_(path) {
  const std::uint64_t size = bytes_.packed() ? 0 : bytes_.size();
  // Room for all of a short file and its end; a pipe has no size and may be long, and so may the content of a gz.
  room_ = size == 0 ? kMostRoom : static_cast<std::size_t>(std::clamp<std::uint64_t>(size + 1, kLeastRoom, kMostRoom));
  buffer_.reset(new char[room_ + 1]);
  at_ = end_ = buffer_.get();
  fill();
  const std::string foreign = foreign_form(at_, static_cast<std::size_t>(end_ - at_));
  if (!foreign.empty()) throw InputError(path_, 0, foreign);
  if (bytes_.packed() && is_fst_byte(*at_))
    throw InputError(path_, 0, "is an FST within a gz, expected the FST itself, as gunzip makes it");
}

/// Keeps the unread rest and reads more after it; a zero byte ends the buffer. A gz that was cut is told after its
/// text.
void VcdText::fill() {
  const auto rest = static_cast<std::size_t>(end_ - at_);
  std::memmove(buffer_.get(), at_, rest);
  std::size_t have = rest;
  while (have < room_ && !whole_) {
    const std::size_t got = read(buffer_.get() + have, room_ - have);
    whole_ = got == 0;
    have += got;
    read_ += got;
  }
  at_ = buffer_.get();
  end_ = at_ + have;
  buffer_[have] = '\0';
}

std::size_t VcdText::read(char* to, std::size_t size) {
  try {
    return bytes_.read(to, size);
  } catch (const InputError& error) {
    fault_ = error;
    return 0;
  }
}

void VcdText::check_word(const char* begin) {
  if (at_ != end_) fail("has a zero byte here, expected the text of a VCD");
  if (!whole_) fail("has a word that is longer than any right one, expected the text of a VCD");
  if (fault_) throw InputError(*fault_);
  bare_end_ = bare_end_ || begin != at_;
}

void VcdText::fail(const std::string& what) const {
  if (!bare_end_) throw InputError(path_, line_, what);
  throw InputError(path_, line_,
                   "ends within a line, expected a complete VCD: was the simulator stopped while it wrote? dsdpv1-sim "
                   "recover keeps the part before");
}

double VcdText::share() const {
  if (bytes_.size() == 0) return 0;
  const auto unread = bytes_.packed() ? 0.0 : static_cast<double>(end_ - at_);
  return std::clamp((static_cast<double>(bytes_.taken()) - unread) / static_cast<double>(bytes_.size()), 0.0, 1.0);
}

}  // namespace dsdpv1::tb
