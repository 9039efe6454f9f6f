#pragma once
// The short names by which a VCD file calls its signals.
#include <algorithm>
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
  /// Whether another code begins with this one.
  bool begins_another(std::string_view code) const {
    const auto longer = [code](const std::string& other) {
      return other.size() > code.size() && other.compare(0, code.size(), code) == 0;
    };
    if (std::any_of(texts_.begin(), texts_.end(), longer)) return true;
    std::size_t first = 0;
    if (!is_short(code, first)) return false;
    const auto used = [this](std::size_t from, std::size_t to) {
      const auto at = [this](std::size_t place) {
        return short_.begin() + static_cast<std::ptrdiff_t>(std::min(place, short_.size()));
      };
      return std::any_of(at(from), at(to), [](std::uint32_t signal) { return signal != kNone; });
    };
    std::size_t end = first + 1;
    for (std::size_t length = code.size(); length < kShort; ++length) {  // the places of codes one character longer
      first = first * kBase + 1;
      end = end * kBase + 1;
      if (used(first, end)) return true;
    }
    return false;
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
  static constexpr std::size_t kBase = '~' - '!' + 1, kShort = 3;

  static bool is_short(std::string_view code, std::size_t& place) {
    if (code.size() > kShort) return false;
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
