#pragma once
// Reads numbers of either byte order from a binary file.
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

/// The unsigned number in up to eight bytes.
inline std::uint64_t number_in(std::string_view bytes, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t at = big_endian ? i : bytes.size() - 1 - i;
    value = value << 8U | static_cast<std::uint8_t>(bytes[at]);
  }
  return value;
}

/// A binary stream that tracks its position.
class ByteReader {
 public:
  explicit ByteReader(std::istream& in) : in_(in) {}

  /// Returns false at the end of the file; throws CaptureError if the file ends within the bytes.
  bool read(std::size_t size, std::string& to) {
    to.resize(size);
    in_.read(to.data(), static_cast<std::streamsize>(size));
    const auto count = static_cast<std::size_t>(in_.gcount());
    at_ += count;
    if (count != size && count != 0) fail_short();
    return count == size;
  }
  /// The file must not end here.
  void need(std::size_t size, std::string& to) {
    if (size != 0 && !read(size, to)) fail_short();
    if (size == 0) to.clear();
  }
  std::uint64_t at() const { return at_; }

 private:
  [[noreturn]] void fail_short() const {
    throw CaptureError("ends in the middle of a packet, at byte " + std::to_string(at_) +
                       ", expected whole packets; it was cut off");
  }

  std::istream& in_;
  std::uint64_t at_ = 0;
};

}  // namespace dsdpv1::bus::capture
