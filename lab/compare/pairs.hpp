#pragma once
// The pairs of compared signals of A and B.
#include <string>
#include <vector>

#include "lab/compare/nets.hpp"
#include "lab/compare/options.hpp"

namespace dsdpv1::tb::compare {

/// The parts of a side's value.
struct Source {
  Net net;
  bool inverted = false;
  std::optional<Net> driven = {}, released = {};  ///< see NamedPair
  bool driven_low = false;
};

struct Pair {
  std::string name;  ///< A's
  Source a, b;
  std::optional<Femtoseconds> tolerance;
};

struct Pairs {
  std::vector<Pair> pairs;
  std::vector<std::string> only_a, only_b;  ///< names of signals that are not compared
};

/// Throws InputError when a named signal does not exist, its counterpart is of another width, or no pair is found.
Pairs match(const Nets& a, const Nets& b, const Options& options);

}  // namespace dsdpv1::tb::compare
