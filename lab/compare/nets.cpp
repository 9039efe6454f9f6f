#include "lab/compare/nets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb::compare {
namespace {

constexpr std::size_t kNamed = 8;           // in a message
constexpr std::size_t kCompared = 100'000;  // names searched for a suggestion

/// The scope without the prefix; nullopt when it is not below it.
std::optional<std::string> below(const std::string& scope, const std::string& prefix) {
  if (prefix.empty()) return scope;
  if (scope == prefix) return "";
  if (scope.size() > prefix.size() && scope.compare(0, prefix.size(), prefix) == 0 && scope[prefix.size()] == '.')
    return scope.substr(prefix.size() + 1);
  return std::nullopt;
}

int high(const WaveVariable& piece) { return std::max(piece.range->first, piece.range->second); }
int low(const WaveVariable& piece) { return std::min(piece.range->first, piece.range->second); }

/// True when variables of one name are the pieces of one vector; they come in order of their highest bit.
bool is_split(const WaveDeclarations& declarations, const std::vector<const WaveVariable*>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const WaveSignal& signal = declarations.signals[pieces[i]->signal];
    if (!pieces[i]->range || signal.kind != WaveKind::kBits) return false;
    if (high(*pieces[i]) - low(*pieces[i]) + 1 != static_cast<int>(signal.width)) return false;
    if (i != 0 && high(*pieces[i]) + 1 != low(*pieces[i - 1])) return false;
  }
  return true;
}

/// Simulators declare a port inside and outside, and some a net twice.
void drop_repeated(std::vector<const WaveVariable*>& pieces) {
  const auto key = [](const WaveVariable* each) { return std::pair(each->range ? -high(*each) : 0, each->signal); };
  std::stable_sort(
      pieces.begin(), pieces.end(), [&](const auto* a, const auto* b) { return key(a) < key(b); });
  const auto same = [](const WaveVariable* a, const WaveVariable* b) { return a->range == b->range; };
  pieces.erase(std::unique(pieces.begin(), pieces.end(), same), pieces.end());
}

bool ends_with_part(const std::string& name, const std::string& end) {
  return name.size() > end.size() && name[name.size() - end.size() - 1] == '.' &&
         name.compare(name.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Nets::Nets(const WaveDeclarations& declarations, const std::string& prefix, std::string file)
    : declarations_(declarations), file_(std::move(file)) {
  std::map<std::pair<std::uint32_t, std::string>, std::vector<const WaveVariable*>> named;
  for (const WaveVariable& each : declarations.variables) named[{each.scope, each.name}].push_back(&each);
  bool found = false;
  for (auto& [name, pieces] : named) {
    const std::optional<std::string> scope = below(declarations.scopes[name.first], prefix);
    found = found || scope;
    if (scope) add_pieces(pieces, *scope);
  }
  if (!found && !prefix.empty())
    throw InputError(file_, 0,
                     "has no signals in " + prefix + did_you_mean(prefix, declarations.scopes) +
                         ", expected one of its scopes, like " + declarations.scopes.back());
  index();
}

void Nets::add_pieces(std::vector<const WaveVariable*>& pieces, const std::string& scope) {
  drop_repeated(pieces);
  const auto net = [&](const WaveVariable& piece, const std::string& leaf) {
    const WaveSignal& signal = declarations_.signals[piece.signal];
    nets_.push_back({scope, leaf, signal.kind, signal.width, {piece.signal}});
  };
  if (pieces.size() == 1) return net(*pieces[0], pieces[0]->name);
  if (!is_split(declarations_, pieces)) {  // words of a memory, or names that mean different things
    for (const WaveVariable* piece : pieces)
      net(*piece, piece->range ? fmt::format("{}[{}:{}]", piece->name, piece->range->first, piece->range->second)
                               : piece->name);
    return;
  }
  Net whole{scope, pieces[0]->name, WaveKind::kBits, 0, {}};
  for (const WaveVariable* piece : pieces) {
    whole.width += declarations_.signals[piece->signal].width;
    whole.signals.push_back(piece->signal);
  }
  if (whole.width > kMostWaveWidth) throw InputError(file_, 0, whole.name() + " is wider than what is read");
  nets_.push_back(std::move(whole));
}

void Nets::index() {
  for (std::size_t i = 0; i < nets_.size(); ++i) {
    by_name_.emplace(nets_[i].name(), i);
    std::vector<std::size_t>& same = by_leaf_[lower(nets_[i].leaf)];
    const auto alias = [&](std::size_t other) { return nets_[other].signals == nets_[i].signals; };
    if (same.size() < 2 && std::none_of(same.begin(), same.end(), alias)) same.push_back(i);
  }
}

const Net* Nets::at(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &nets_[found->second];
}

const Net* Nets::with_leaf(const std::string& leaf) const {
  const auto found = by_leaf_.find(lower(leaf));
  return found == by_leaf_.end() || found->second.size() != 1 ? nullptr : &nets_[found->second[0]];
}

bool Nets::knows(const std::string& name) const {
  const auto is = [&](const Net& net) { return ends_with_part(net.name(), name); };
  return at(name) != nullptr || with_leaf(name) != nullptr || std::any_of(nets_.begin(), nets_.end(), is);
}

const Net& Nets::find(const std::string& name) const {
  if (const Net* net = at(name)) return *net;
  std::vector<const Net*> found;
  const auto alias = [&](const Net& net) {
    return std::any_of(found.begin(), found.end(), [&](const Net* other) { return other->signals == net.signals; });
  };
  for (const Net& net : nets_)
    if (ends_with_part(net.name(), name) && found.size() <= kNamed && !alias(net)) found.push_back(&net);
  if (found.size() == 1) return *found[0];
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const Net* net : found) names.push_back(net->name());
  if (!found.empty()) throw InputError(file_, 0, name + " is more than one signal, expected " + join(names));
  if (const Net* net = with_leaf(name)) return *net;
  for (std::size_t i = 0; i < std::min(nets_.size(), kCompared); ++i) names.push_back(nets_[i].leaf);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const std::string meant = did_you_mean(name, names);
  names.resize(std::min(names.size(), kNamed));
  throw InputError(file_, 0, "has no signal " + name + meant + ", expected its own, like " + join(names));
}

}  // namespace dsdpv1::tb::compare
