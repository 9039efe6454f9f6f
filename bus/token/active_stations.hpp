#pragma once
// The list of active stations (LAS) of a master, learnt from the tokens of others (EN 50170 part 2, FDL).
#include <bitset>
#include <cstdint>
#include <vector>

#include "bus/telegram/telegram.hpp"

namespace dsdpv1::bus {

class ActiveStations {
 public:
  void clear() { stations_.reset(); }
  void add(std::uint8_t address) { stations_.set(address); }
  void remove(std::uint8_t address) { stations_.reset(address); }
  bool contains(std::uint8_t address) const { return stations_.test(address); }
  /// NS: the next in the order of addresses, after the highest the lowest; `address` if there is no other.
  std::uint8_t next_after(std::uint8_t address) const;
  /// PS: the same downwards.
  std::uint8_t previous_of(std::uint8_t address) const;
  /// A token from `sa` to `da`: both are in the ring, and no station between them.
  void token_passed(std::uint8_t sa, std::uint8_t da);
  std::vector<std::uint8_t> addresses() const;

  friend bool operator==(const ActiveStations& a, const ActiveStations& b) { return a.stations_ == b.stations_; }

 private:
  std::bitset<kBroadcast + 1> stations_;
};

/// True if a token from `sa` to `da` skips `address`. A token to itself skips all others.
bool token_skips(std::uint8_t sa, std::uint8_t da, std::uint8_t address);

/// Learns the LAS: it is valid after two equal rotations of the token in succession. A rotation ends with the token
/// that goes to the same or a lower address.
class StationLearner {
 public:
  void reset() { *this = StationLearner(); }
  void token_passed(std::uint8_t sa, std::uint8_t da);
  bool valid() const { return valid_; }
  const ActiveStations& stations() const { return earlier_; }

 private:
  enum class Stage : std::uint8_t { kSearching, kFirst, kLater };
  Stage stage_ = Stage::kSearching;  ///< no rotation begun yet, the first, another
  ActiveStations now_, earlier_;
  bool valid_ = false;
};

}  // namespace dsdpv1::bus
