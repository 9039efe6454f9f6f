#pragma once
// The short names by which a VCD file calls its signals.
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace dsdpv1::tb {

/// Codes of up to three characters, which are nearly all, are indices of a table that grows as needed.
class VcdCodes {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::uint32_t find(std::string_view code) const {
    std::size_t place = 0;
    if (!is_short(code, place)) return find_long(code);
    return place < short_.size() ? short_[place] : kNone;
  }
  void add(std::string_view code, std::uint32_t signal) {
    std::size_t place = 0;
    if (!is_short(code, place)) {
      long_.emplace(texts_.emplace_back(code), signal);
      return;
    }
    if (place >= short_.size()) short_.resize(place + 1, kNone);
    short_[place] = signal;
  }

 private:
  static constexpr std::size_t kBase = '~' - '!' + 1;

  static bool is_short(std::string_view code, std::size_t& place) {
    if (code.size() > 3) return false;
    for (const char c : code) {
      if (c < '!' || c > '~') return false;
      place = place * kBase + static_cast<std::size_t>(c - '!') + 1;
    }
    return true;
  }
  std::uint32_t find_long(std::string_view code) const {
    const auto found = long_.find(code);
    return found == long_.end() ? kNone : found->second;
  }

  std::vector<std::uint32_t> short_;
  std::deque<std::string> texts_;
  std::unordered_map<std::string_view, std::uint32_t> long_;  ///< its keys are in texts_
};

}  // namespace dsdpv1::tb
