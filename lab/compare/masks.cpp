#include "lab/compare/masks.hpp"

#include <fmt/format.h>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "lab/compare/levels.hpp"

namespace dsdpv1::tb::compare {
namespace {

/// The pairs that a name selects: A's whole name, or the end of it.
std::vector<std::uint32_t> targets_of(const std::string& name, const std::vector<Pair>& pairs) {
  std::vector<std::uint32_t> targets;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::string& own = pairs[i].name;
    const bool end =
        own.size() > name.size() && own.compare(own.size() - name.size() - 1, std::string::npos, "." + name) == 0;
    if (own == name || end) targets.push_back(static_cast<std::uint32_t>(i));
    names.push_back(pairs[i].a.net.leaf);
  }
  if (!targets.empty()) return targets;
  throw InputError(
      fmt::format("dsdpv1-sim compare: --mask is for {}, which is not compared{}, expected signals that are", name,
                  did_you_mean(name, names)));
}

}  // namespace

Masks::Masks(const std::vector<Mask>& masks, Side& a, Side& b, const std::vector<Pair>& pairs)
    : touched_(masks.size()), of_pair_(pairs.size(), 0) {
  for (const Mask& mask : masks) {
    Condition condition;
    condition.side = b.nets().knows(mask.signal) && !a.nets().knows(mask.signal) ? &b : &a;
    const Net& net = condition.side->nets().find(mask.signal);
    condition.probe = condition.side->watch({net}, touched_, static_cast<std::uint32_t>(conditions_.size()));
    condition.value = parse_value(mask.value, net.kind, net.width, "dsdpv1-sim compare: --mask " + mask.signal);
    condition.equal = mask.equal;
    if (!mask.target.empty()) condition.targets = targets_of(mask.target, pairs);
    conditions_.push_back(std::move(condition));
  }
  touched_.add_all();
}

void Masks::settle(Touched& pairs) {
  for (const std::uint32_t which : touched_.list()) {
    Condition& condition = conditions_[which];
    const bool holds = (condition.side->value(condition.probe) == condition.value) == condition.equal;
    if (holds != condition.holds) hold(condition, holds, pairs);
  }
  touched_.clear();
}

void Masks::hold(Condition& condition, bool holds, Touched& pairs) {
  condition.holds = holds;
  const std::uint32_t step = holds ? 1U : UINT32_MAX;  // UINT32_MAX: one less
  if (condition.targets.empty()) {
    all_ += step;
    return pairs.add_all();
  }
  for (const std::uint32_t target : condition.targets) {
    of_pair_[target] += step;
    pairs.add(target);
  }
}

}  // namespace dsdpv1::tb::compare
