#include "cosim/random/situations.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dsdpv1::cosim {

std::string text(const Situations& situations, const std::vector<Situation>& known) {
  std::string lines;
  for (auto begin = known.begin(); begin != known.end();) {
    const auto end =
        std::find_if(begin, known.end(), [&](const Situation& each) { return each.first != begin->first; });
    std::string missing;
    std::size_t seen = 0;
    for (auto each = begin; each != end; ++each)
      if (situations.of(*each) != 0)
        ++seen;
      else
        missing += fmt::format("{}{}", missing.empty() ? "; never seen: " : ", ", each->second);
    lines += fmt::format("{:<22}{} of {}{}\n", begin->first, seen, end - begin, missing);
    begin = end;
  }
  return lines;
}

std::string table(const Situations& situations, const std::vector<Situation>& known) {
  std::map<Situation, std::uint64_t> others = situations.counts();
  std::string lines;
  for (const Situation& each : known) {
    lines += fmt::format("{}\t{}\t{}\n", each.first, each.second, situations.of(each));
    others.erase(each);
  }
  for (const auto& [each, times] : others) lines += fmt::format("{}\t{}\t{}\n", each.first, each.second, times);
  return lines;
}

}  // namespace dsdpv1::cosim
