#pragma once
// Bytes that come at the back and go from the front.
#include <cstddef>
#include <cstdint>

#include "bus/bytes.hpp"

namespace dsdpv1::tb::serve {

/// One piece of memory, so that what waits can be handed to a system call. What has gone is moved out of the way only
/// when it is more than half, so that taking all that ever came costs time in proportion to it, however small the
/// pieces.
class ByteQueue {
 public:
  bool empty() const { return size() == 0; }
  std::size_t size() const { return bytes_.size() - gone_; }
  const std::uint8_t* data() const { return bytes_.data() + gone_; }

  void push(const bus::Bytes& bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  /// The first `count` go; not more than there are.
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
  std::size_t gone_ = 0;  ///< at the front
};

}  // namespace dsdpv1::tb::serve
