#pragma once
// Shared by the targets: divides an input into pieces, and reports broken promises that are not crashes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dsdpv1::fuzz {

/// The bytes of an input, from the front. At its end numbers are 0 and pieces empty.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return size_ == 0; }
  std::uint8_t byte() {
    if (empty()) return 0;
    --size_;
    return *data_++;
  }
  /// Little endian, of 1 to 8 bytes.
  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::uint64_t{byte()} << (8 * i);
    return value;
  }
  /// 0 .. count - 1.
  std::size_t below(std::size_t count) { return byte() % count; }
  /// At most `count` bytes.
  std::vector<std::uint8_t> bytes(std::size_t count) {
    const std::size_t taken = std::min(count, size_);
    std::vector<std::uint8_t> piece(data_, data_ + taken);
    data_ += taken;
    size_ -= taken;
    return piece;
  }
  std::string text(std::size_t count) {
    const std::vector<std::uint8_t> piece = bytes(count);
    return {piece.begin(), piece.end()};
  }
  std::string rest() { return text(size_); }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// A promise of the code under test; `what` names it. If broken, it ends a fuzzer and fails the replay test.
inline void promise(bool kept, std::string_view what) {
  if (!kept) throw std::logic_error("broken promise: " + std::string(what));
}

/// An error begins with the name of the file. Quoted text in it may be anything: its printer makes it printable.
inline void promise_named(const std::string& error, const std::string& name) {
  if (error.rfind(name + ":", 0) != 0) promise(false, "an error names its file: " + error);
}

}  // namespace dsdpv1::fuzz

namespace dsdpv1 {

/// A target: one per file, with libFuzzer's name; the test that replays the corpora renames each.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

}  // namespace dsdpv1
