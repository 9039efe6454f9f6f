#include "kinds/dsdpv1/user_cpu/callers.hpp"

#include <optional>

namespace dsdpv1::user_cpu {
namespace {

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

/// dsdpv1_bench.c among the callers has called the handler of INTR0: those before it are another thread of control.
Place nearest_own(const std::vector<std::uint32_t>& addresses, const PlaceOf& place_of) {
  std::optional<Place> nearest;
  for (const std::uint32_t address : addresses) {
    const Place place = place_of(address - 1);  // within the call
    if (begins(place.file, "dsdpv1_bench.")) break;
    if (!nearest || (nearest->file.empty() && !place.file.empty())) nearest = place;
    if (!place.file.empty() && !begins(place.file, "dsdpv1")) return place;
  }
  return nearest.value_or(Place());
}

}  // namespace

std::uint32_t Callers::number(const std::vector<std::uint32_t>& addresses) {
  const auto [chain, is_new] = numbers_.try_emplace(addresses, static_cast<std::uint32_t>(chains_.size()));
  if (is_new) chains_.push_back(chain);
  return chain->second;
}

const Place& Callers::place(std::uint32_t number, const PlaceOf& place_of) {
  const auto [place, is_new] = places_.try_emplace(number);
  if (is_new) place->second = nearest_own(chains_.at(number)->first, place_of);
  return place->second;
}

}  // namespace dsdpv1::user_cpu
