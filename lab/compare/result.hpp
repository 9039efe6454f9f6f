#pragma once
// The result of a comparison.
#include <optional>
#include <string>
#include <vector>

#include "lab/compare/surroundings.hpp"

namespace dsdpv1::tb::compare {

struct Difference {
  Time at = 0;
  std::string a, b;  ///< values, for people
};

struct SignalResult {
  std::string name;            ///< A's
  std::uint64_t compared = 0;  ///< number of compared values
  std::uint64_t differences = 0;
  std::optional<Difference> first;
};

struct FileResult {
  std::string path;
  std::size_t signals = 0;
  Time begin = 0, end = 0;  ///< of the times read
  bool ended = false;       ///< to its end
};

struct Result {
  Scale scale{-15};
  FileResult a, b;
  Time from = 0, to = 0;  ///< compared
  Time tolerance = 0;
  std::optional<Time> rounded;  ///< B's unit of time, if no tolerance was asked for and it is coarser than A's
  std::optional<Time> wanted;   ///< --to
  std::vector<SignalResult> signals;
  std::vector<std::string> only_a, only_b;
  std::vector<std::string> left_out;  ///< pins that a side lacks
  bool strict = false;
  std::vector<std::string> alone;    ///< if strict: signals without a counterpart
  bool b_ends_first = false;         ///< ... and whether B ends before A
  std::optional<std::size_t> first;  ///< the signal that differed first
  std::vector<Line> surroundings;    ///< its surroundings

  /// A file that ends before --to is not equal.
  bool short_of_end() const { return wanted && to < *wanted; }
  bool equal() const { return !first && !short_of_end() && alone.empty() && !b_ends_first; }
};

}  // namespace dsdpv1::tb::compare
