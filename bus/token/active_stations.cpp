#include "bus/token/active_stations.hpp"

namespace dsdpv1::bus {

namespace {

constexpr int kAddresses = kBroadcast + 1;

std::uint8_t search(const ActiveStations& stations, std::uint8_t from, int step) {
  for (int distance = 1; distance < kAddresses; ++distance) {
    const auto address = static_cast<std::uint8_t>((from + kAddresses + step * distance) % kAddresses);
    if (stations.contains(address)) return address;
  }
  return from;
}

}  // namespace

std::uint8_t ActiveStations::next_after(std::uint8_t address) const { return search(*this, address, 1); }

std::uint8_t ActiveStations::previous_of(std::uint8_t address) const { return search(*this, address, -1); }

bool token_skips(std::uint8_t sa, std::uint8_t da, std::uint8_t address) {
  if (address == sa || address == da) return false;
  if (sa < da) return sa < address && address < da;
  return address > sa || address < da;
}

void ActiveStations::token_passed(std::uint8_t sa, std::uint8_t da) {
  for (std::uint8_t address = 0; address < kAddresses; ++address)
    if (token_skips(sa, da, address)) remove(address);
  add(sa);
  add(da);
}

std::vector<std::uint8_t> ActiveStations::addresses() const {
  std::vector<std::uint8_t> list;
  for (std::uint8_t address = 0; address < kAddresses; ++address)
    if (contains(address)) list.push_back(address);
  return list;
}

void StationLearner::token_passed(std::uint8_t sa, std::uint8_t da) {
  if (stage_ != Stage::kSearching) now_.add(sa);
  if (da > sa) return;
  valid_ = stage_ == Stage::kLater && now_ == earlier_;
  earlier_ = now_;
  now_.clear();
  stage_ = stage_ == Stage::kSearching ? Stage::kFirst : Stage::kLater;
}

}  // namespace dsdpv1::bus
