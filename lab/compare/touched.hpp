#pragma once
// Which of many things have changed since they were last looked at.
#include <cstdint>
#include <numeric>
#include <vector>

namespace dsdpv1::tb::compare {

class Touched {
 public:
  explicit Touched(std::size_t count) : is_(count, 0) {}
  void add(std::uint32_t which) {
    if (is_[which] != 0) return;
    is_[which] = 1;
    list_.push_back(which);
  }
  void add_all() {
    list_.resize(is_.size());
    std::iota(list_.begin(), list_.end(), 0U);
    is_.assign(is_.size(), 1);
  }
  const std::vector<std::uint32_t>& list() const { return list_; }
  void clear() {
    for (const std::uint32_t which : list_) is_[which] = 0;
    list_.clear();
  }

 private:
  std::vector<std::uint8_t> is_;
  std::vector<std::uint32_t> list_;
};

}  // namespace dsdpv1::tb::compare
