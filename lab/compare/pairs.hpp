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
  std::vector<std::string> left_out;        ///< pairs that are not required, and that a side lacks
  /// Signals that should have a counterpart, and have none: all, or those for which a pair was asked.
  std::vector<std::string> alone;
};

/// Throws InputError when a named signal does not exist, its counterpart is of another width, no pair is found, or none
/// for an output of a chip.
Pairs match(const Nets& a, const Nets& b, const Options& options);

}  // namespace dsdpv1::tb::compare
