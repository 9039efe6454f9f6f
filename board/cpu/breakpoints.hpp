#pragma once
// Where a debugger wants the run to stop.
#include <algorithm>
#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

namespace dsdpv1::arm {

/// Addresses of instructions. at() is called for every instruction: nearly always one look at a bit.
class Breakpoints {
 public:
  bool empty() const { return addresses_.empty(); }
  bool at(std::uint32_t pc) const { return maybe_[slot(pc)] && has(pc); }

  void add(std::uint32_t address) {
    if (!has(address)) addresses_.push_back(address);
    maybe_.set(slot(address));
  }
  void remove(std::uint32_t address) {
    addresses_.erase(std::remove(addresses_.begin(), addresses_.end(), address), addresses_.end());
    maybe_.reset();
    for (const std::uint32_t other : addresses_) maybe_.set(slot(other));
  }
  void clear() {
    addresses_.clear();
    maybe_.reset();
  }

 private:
  static constexpr std::size_t kSlots = 4096;
  /// Thumb instructions stand at even addresses.
  static std::size_t slot(std::uint32_t address) { return (address >> 1) % kSlots; }
  bool has(std::uint32_t address) const {
    return std::find(addresses_.begin(), addresses_.end(), address) != addresses_.end();
  }

  std::bitset<kSlots> maybe_;
  std::vector<std::uint32_t> addresses_;
};

/// Data that is watched. Numbered as gdb's Z packets are.
struct Watchpoint {
  enum class Kind : std::uint8_t { kWrite = 2, kRead = 3, kAccess = 4 };
  Kind kind;
  std::uint32_t address, size;  ///< bytes, > 0

  bool operator==(const Watchpoint& other) const {
    return kind == other.kind && address == other.address && size == other.size;
  }
  bool meets(std::uint32_t at, std::uint32_t count, bool write) const {
    if (kind == (write ? Kind::kRead : Kind::kWrite)) return false;
    return std::uint64_t{at} < std::uint64_t{address} + size && std::uint64_t{address} < std::uint64_t{at} + count;
  }
};

class Watchpoints {
 public:
  bool empty() const { return points_.empty(); }
  void add(const Watchpoint& point) {
    if (std::find(points_.begin(), points_.end(), point) == points_.end()) points_.push_back(point);
  }
  void remove(const Watchpoint& point) {
    points_.erase(std::remove(points_.begin(), points_.end(), point), points_.end());
  }
  void clear() { points_.clear(); }

  /// The first that an access meets.
  std::optional<Watchpoint> met_by(std::uint32_t address, std::uint32_t size, bool write) const {
    for (const Watchpoint& point : points_)
      if (point.meets(address, size, write)) return point;
    return std::nullopt;
  }

 private:
  std::vector<Watchpoint> points_;
};

}  // namespace dsdpv1::arm
