#pragma once
// Where in the source a host process was when it called its port: of the functions that led there the nearest one of
// the firmware itself. A driver that is right is not where its author looks.
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tb/chip/user_cpu/place.hpp"

namespace dsdpv1::user_cpu {

/// The line of an address in a program's file; nothing but the address where its debug information has none.
using PlaceOf = std::function<Place(std::uint32_t address)>;

class Callers {
 public:
  /// A number for return addresses in the program's file, the nearest first; the same for the same ones. One or more.
  std::uint32_t number(const std::vector<std::uint32_t>& addresses);

  /// Where that was.
  const Place& place(std::uint32_t number, const PlaceOf& place_of);

 private:
  using Chain = std::map<std::vector<std::uint32_t>, std::uint32_t>::const_iterator;

  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_;
  std::vector<Chain> chains_;              ///< by number
  std::map<std::uint32_t, Place> places_;  ///< those that were asked for
};

}  // namespace dsdpv1::user_cpu
