#include "tb/bench/ruling_place.hpp"

#include <algorithm>
#include <regex>

#include "bus/capture/lower_case.hpp"

namespace dsdpv1::tb {

std::string ruling_place(const std::string& name) {
  static const std::regex chip("[PHDSVU][0-9]+"), sisters("(R|SP|UA)[0-9]+"), family("A[0-9]+"), alarms("AL[0-9]+"),
      module("X[0-9]+");
  if (name == "PROFIBUS facts") return "chip.md#profibus-facts-that-the-documents-take-for-granted";
  if (name == "host process") return "tutorials/c_driver_on_host.md";
  if (name == "ARM board") return "arm_board.md#what-a-real-board-would-not-forgive";
  const char* page = std::regex_match(name, chip)      ? "chip.md#"
                     : std::regex_match(name, sisters) ? "chip_rsu.md#"
                     : std::regex_match(name, family)  ? "spc3.md#"
                     : std::regex_match(name, alarms)  ? "alarms.md#"
                     : std::regex_match(name, module)  ? "xgate.md#"
                                                       : "conformance.md#";
  return page + bus::capture::lower_case(name);
}

std::vector<std::string> names_of(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(", ", at), list.size());
    names.push_back(list.substr(at, end - at));
    at = end + 2;
  }
  return names;
}

}  // namespace dsdpv1::tb
