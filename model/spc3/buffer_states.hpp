#pragma once
// The states of three exchange buffers: each of D (the chip's), N (next), U (the user's) and F (free) is buffer 1, 2, 3
// or nil, and either N or F is nil (M tables 5.8 and 5.10).
#include <cstdint>
#include <utility>

namespace dsdpv1::spc3 {

struct BufferStates {
  std::uint8_t d = 1, n = 0, u = 2, f = 3;  ///< A17

  /// The register's byte.
  std::uint8_t code() const { return static_cast<std::uint8_t>(f << 6 | u << 4 | n << 2 | d); }
  /// The writer's buffer (D or U) is complete: it becomes N, and the writer gets the free one or the old N.
  void pass_on(std::uint8_t& writer) {
    if (n != 0) return std::swap(n, writer);
    n = std::exchange(writer, std::exchange(f, std::uint8_t{0}));
  }
  /// The reader (U or D) takes N, which is not nil, and frees its own.
  void fetch(std::uint8_t& reader) { f = std::exchange(reader, std::exchange(n, std::uint8_t{0})); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [chips, next, users, free] = *this;
    archive.within(0, 3, chips, next, users, free);
    archive.check(is_possible());
  }

 private:
  bool is_possible() const {
    const unsigned present = 1U << d | 1U << n | 1U << u | 1U << f;
    return present == 0xF && d != 0 && u != 0;
  }
};

}  // namespace dsdpv1::spc3
