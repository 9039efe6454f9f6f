#include "lab/compare/pairs.hpp"

#include <fmt/format.h>

#include <set>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb::compare {
namespace {

bool comparable(const Net& a, const Net& b) { return a.kind == b.kind && a.width == b.width; }

std::string form(const Net& net) {
  if (net.kind == WaveKind::kReal) return "a real";
  return net.kind == WaveKind::kText ? "a text" : fmt::format("{} bits wide", net.width);
}

/// nullptr for an optional signal that is missing.
const Net* look_for(const Nets& nets, const std::string& name, bool required) {
  return required || nets.knows(name) ? &nets.find(name) : nullptr;
}

class Matcher {
 public:
  Matcher(const Nets& a, const Nets& b) : a_(a), b_(b) {}

  Pairs named(const std::vector<NamedPair>& names) {
    for (const NamedPair& each : names) add(each);
    return finish();
  }
  Pairs by_name() {
    for (const Net& net : a_.all()) {
      const Net* other = counterpart(net);
      if (other == nullptr || !comparable(net, *other)) continue;
      if (met_.insert({net.signals, other->signals}).second) found_.pairs.push_back({net.name(), {net}, {*other}, {}});
      used_a_.insert(net.name());
      used_b_.insert(other->name());
    }
    return finish();
  }

 private:
  const Net* counterpart(const Net& net) const {
    if (const Net* same = b_.at(net.name())) return same;
    const Net* const own = a_.with_leaf(net.leaf);
    return own != nullptr && own->signals == net.signals ? b_.with_leaf(net.leaf) : nullptr;
  }
  void add(const NamedPair& names) {
    const Net* const a = look_for(a_, names.a, names.required);
    const Net* const b = look_for(b_, names.b, names.required);
    if (a == nullptr || b == nullptr || lacks_a_side(names)) return;
    if (!comparable(*a, *b))
      throw InputError(a_.file(), 0,
                       fmt::format("{} is {}, but {} of {} is {}, expected signals of one width", a->name(), form(*a),
                                   b->name(), b_.file(), form(*b)));
    Pair pair{a->name(), {*a}, {*b, names.inverted}, names.tolerance};
    pair.b.driven = side_of(names.driven);
    pair.b.released = side_of(names.released);
    pair.b.driven_low = names.driven_low;
    used_a_.insert(a->name());
    used_b_.insert(b->name());
    found_.pairs.push_back(std::move(pair));
  }
  /// True if B lacks `driven` or `released` of an optional signal.
  bool lacks_a_side(const NamedPair& names) const {
    const auto lacks = [this](const std::string& name) { return !name.empty() && !b_.knows(name); };
    return !names.required && (lacks(names.driven) || lacks(names.released));
  }
  std::optional<Net> side_of(const std::string& name) {
    if (name.empty()) return std::nullopt;
    const Net& net = b_.find(name);
    used_b_.insert(net.name());
    return net;
  }
  Pairs finish() {
    for (const Net& net : a_.all())
      if (used_a_.count(net.name()) == 0) found_.only_a.push_back(net.name());
    for (const Net& net : b_.all())
      if (used_b_.count(net.name()) == 0) found_.only_b.push_back(net.name());
    if (found_.pairs.empty()) refuse();
    return std::move(found_);
  }
  [[noreturn]] void refuse() const {
    const auto some = [](const std::vector<std::string>& names) {
      return names.empty() ? "none"
                           : join({names.begin(), names.begin() + std::min<std::ptrdiff_t>(
                                                                      3, static_cast<std::ptrdiff_t>(names.size()))});
    };
    throw InputError(a_.file(), 0,
                     fmt::format("no signal has its counterpart in {} (here {}; there {}), expected "
                                 "equal names, --scope, --pins, --signal A=B",
                                 b_.file(), some(found_.only_a), some(found_.only_b)));
  }

  const Nets &a_, &b_;
  Pairs found_;
  std::set<std::string> used_a_, used_b_;
  std::set<std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>>
      met_;  ///< aliases of a pair count as the pair
};

}  // namespace

Pairs match(const Nets& a, const Nets& b, const Options& options) {
  Matcher matcher(a, b);
  return options.pairs.empty() ? matcher.by_name() : matcher.named(options.pairs);
}

}  // namespace dsdpv1::tb::compare
