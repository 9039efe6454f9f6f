#include "lab/compare/watchers.hpp"

#include <unordered_map>

namespace dsdpv1::tb::compare {
namespace {

constexpr std::size_t kMostPins = 4096;  // of all chips: more pins than this belong to something else

/// "strobe" for "STROBE" and "strobe_i".
std::string plain(const std::string& leaf) {
  std::string name = lower(leaf);
  if (name.size() > 2 && (name.compare(name.size() - 2, 2, "_i") == 0 || name.compare(name.size() - 2, 2, "_o") == 0))
    name.resize(name.size() - 2);
  return name;
}

}  // namespace

Watchers::Watchers(Side& side, const MakeSurroundings& make) : side_(side), touched_(kMostPins) {
  if (!make) return;
  std::unordered_map<std::string, std::size_t> numbers;
  const std::unique_ptr<Surroundings> example = make(side.nets());
  for (std::size_t i = 0; i < example->pins().size(); ++i) numbers.emplace(plain(example->pins()[i]), i);
  for (const Net& net : side.nets().all()) {
    const auto number = numbers.find(plain(net.leaf));
    if (number == numbers.end() || net.kind != WaveKind::kBits || pins_.size() == kMostPins) continue;
    std::unique_ptr<Surroundings>& of = by_scope_[net.scope];
    if (!of) of = make(side.nets());
    const auto which = static_cast<std::uint32_t>(pins_.size());
    pins_.push_back({of.get(), number->second, side.watch({net}, touched_, which)});
  }
}

void Watchers::settle(bus::Tick now) {
  for (const std::uint32_t which : touched_.list())
    pins_[which].of->change(now, pins_[which].number, side_.value(pins_[which].probe));
  touched_.clear();
}

std::vector<Line> Watchers::lines(const std::string& scope, bus::Tick now) const {
  const auto found = by_scope_.size() == 1 ? by_scope_.begin() : by_scope_.find(scope);
  return found == by_scope_.end() ? std::vector<Line>{} : found->second->lines(now);
}

}  // namespace dsdpv1::tb::compare
