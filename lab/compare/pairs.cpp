#include "lab/compare/pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb::compare {
namespace {

bool comparable(const Net& a, const Net& b) { return a.kind == b.kind && a.width == b.width; }

std::string form(const Net& net) {
  if (net.kind == WaveKind::kReal) return "a real";
  if (net.kind == WaveKind::kEvent) return "an event";
  return net.kind == WaveKind::kText ? "a text" : fmt::format("{} bits wide", net.width);
}

/// A pair that is left out.
struct Missing {
  NamedPair pair;
  std::string file, signal;  ///< which lacks what
};

class Matcher {
 public:
  Matcher(const Nets& a, const Nets& b) : a_(a), b_(b) {}

  Pairs named(const std::vector<NamedPair>& names) {
    for (const NamedPair& each : names) add(each);
    for (const Missing& each : missing_) leave_out(each);
    found_.alone = found_.left_out;
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
    Pairs pairs = finish();
    pairs.alone = pairs.only_a;
    pairs.alone.insert(pairs.alone.end(), pairs.only_b.begin(), pairs.only_b.end());
    return pairs;
  }

 private:
  const Net* counterpart(const Net& net) const {
    if (const Net* same = b_.at(net.name())) return same;
    const Net* const own = a_.with_leaf(net.leaf);
    return own != nullptr && own->signals == net.signals ? b_.with_leaf(net.leaf) : nullptr;
  }
  void add(const NamedPair& names) {
    if (!names.required && is_missing(names)) return;
    const Net *const a = &a_.find(names.a), *const b = &b_.find(names.b);
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
    outputs_.insert(names.output);
  }
  bool is_missing(const NamedPair& names) {
    const auto lacks = [&](const Nets& nets, const std::string& name) {
      const bool lacking = !name.empty() && !nets.knows(name);
      if (lacking) missing_.push_back({names, nets.file(), name});
      return lacking;
    };
    return lacks(a_, names.a) || lacks(b_, names.b) || lacks(b_, names.driven) || lacks(b_, names.released);
  }
  void leave_out(const Missing& missing) {
    const std::string& output = missing.pair.output;
    if (!output.empty() && outputs_.count(output) != 0) return;  // compared by another pair
    if (!output.empty())
      throw InputError(missing.file, 0,
                       fmt::format("has no signal {0} for the chip's output {1}, expected one for each output, or "
                                   "--without {1}",
                                   missing.signal, output));
    found_.left_out.push_back(missing.pair.a);
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
  std::vector<Missing> missing_;
  std::set<std::string> outputs_;  ///< of the chip, compared
  std::set<std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>>
      met_;  ///< aliases of a pair count as the pair
};

}  // namespace

Pairs match(const Nets& a, const Nets& b, const Options& options) {
  Matcher matcher(a, b);
  std::vector<NamedPair> pairs = options.pins ? options.pins(a, b) : std::vector<NamedPair>();
  for (NamedPair own : options.pairs) {
    const auto same = std::find_if(pairs.begin(), pairs.end(), [&](const NamedPair& pin) { return pin.a == own.a; });
    if (same != pairs.end()) own.output = same->output;
    if (same != pairs.end()) pairs.erase(same);
    pairs.push_back(std::move(own));
  }
  return pairs.empty() ? matcher.by_name() : matcher.named(pairs);
}

}  // namespace dsdpv1::tb::compare
