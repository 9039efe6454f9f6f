#pragma once
// A VCD file as tokens: read in large pieces, from a file or a FIFO, also packed as gz.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/input/input_error.hpp"
#include "io/waves/wave_bytes.hpp"

namespace dsdpv1::tb {

class VcdText {
 public:
  /// Throws InputError when it cannot be read.
  explicit VcdText(const std::string& path);

  /// The next word between blanks, until the next call; empty at the end of the file. Throws InputError for a word
  /// longer than any right one.
  std::string_view token() {
    skip_blanks();
    if (end_ - at_ < kLongest && !whole_) fill();
    const char* const begin = at_;
    while (!kBlank[static_cast<unsigned char>(*at_)]) ++at_;
    if (at_ == end_ || *at_ == '\0') check_word(begin);
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }
  /// Whether the last word ended with the file, without a blank after it: it may have been cut.
  bool at_bare_end() const { return bare_end_; }
  /// Bytes of the text up to the end of the last word.
  std::uint64_t offset() const { return read_ - static_cast<std::uint64_t>(end_ - at_); }
  /// Throws InputError for this line; a text that ends within a word has that fault instead.
  [[noreturn]] void fail(const std::string& what) const;
  /// How much of the file has been read, 0 to 1; 0 of a FIFO.
  double share() const;

 private:
  static constexpr std::ptrdiff_t kLongest = 0x12'0000;  ///< a value of kMostWaveWidth with some margin
  static const std::array<bool, 256> kBlank;             ///< and the zero byte after the last one

  void skip_blanks() {
    for (;;) {
      while (*at_ != '\0' && kBlank[static_cast<unsigned char>(*at_)]) line_ += *at_++ == '\n' ? 1 : 0;
      if (at_ != end_ || whole_) return;
      fill();
    }
  }
  void fill();
  std::size_t read(char* to, std::size_t size);
  void check_word(const char* begin);

  std::string path_;
  WaveBytes bytes_;
  std::size_t room_ = 0;            ///< bytes of the buffer, without the zero after them
  std::unique_ptr<char[]> buffer_;  ///< not filled before it is needed
  const char *at_, *end_;
  bool whole_ = false;  ///< all of the file is in the buffer
  bool bare_end_ = false;
  std::optional<InputError> fault_;  ///< after the text
  int line_ = 1;
  std::uint64_t read_ = 0;  ///< bytes of the text
};

}  // namespace dsdpv1::tb
