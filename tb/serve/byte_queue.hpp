#pragma once
// A queue of bytes.
#include <cstddef>
#include <cstdint>

#include "bus/bytes.hpp"

namespace dsdpv1::tb::serve {

/// One block of memory, so that waiting bytes can be passed to a system call. Taken bytes are removed only when they
/// are more than half, so the total cost is proportional to the bytes, however small the pieces.
class ByteQueue {
 public:
  bool empty() const { return size() == 0; }
  std::size_t size() const { return bytes_.size() - gone_; }
  const std::uint8_t* data() const { return bytes_.data() + gone_; }

  void push(const bus::Bytes& bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  /// Drops the first `count` bytes; at most as many as there are.
  void drop(std::size_t count) {
    gone_ += count;
    if (gone_ <= size()) return;
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(gone_));
    gone_ = 0;
  }
  bus::Bytes take(std::size_t count) {
    bus::Bytes taken(data(), data() + count);
    drop(count);
    return taken;
  }
  void clear() {
    bytes_.clear();
    gone_ = 0;
  }

 private:
  bus::Bytes bytes_;
  std::size_t gone_ = 0;  ///< dropped at the front
};

}  // namespace dsdpv1::tb::serve
