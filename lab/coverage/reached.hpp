#pragma once
// Lines, branches and named points of some files that runs have reached. The points are bits of RTL that changed, or
// what exercises a ruling in its document. As text it is a tracefile of lcov.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace dsdpv1::tb::coverage {

using Count = std::uint64_t;

/// The kind of a branch.
enum class Way : std::uint8_t { kIf, kElse, kElseIf, kCase };
/// "if", "else", "else if", "case".
const char* name(Way way);

/// The counts of a file, also those that are 0.
struct Reached {
  using Branch = std::tuple<int, int, Way>;   ///< line and column where it begins
  using Point = std::pair<int, std::string>;  ///< line, name

  std::map<int, Count> lines;
  std::map<Branch, Count> branches;
  std::map<Point, Count> points;
};
/// By path.
using Files = std::map<std::string, Reached>;

/// How many of these counts are not 0.
template <class Counts>
std::size_t reached_of(const Counts& counts) {
  return static_cast<std::size_t>(std::count_if(
      counts.begin(), counts.end(), [](const auto& each) { return each.second != 0; }));
}

void add(Files& sum, const Files& more);

/// From what Verilator 5 writes; a module's instances together. Throws InputError for another text, `origin` in front.
Files of_verilator(const std::string& records, const std::string& origin);

/// Points are functions there, the column of a branch is its block, and its way is its number.
std::string lcov(const Files& files);
/// Reads what `lcov` has made. Throws InputError for another text, `origin` in front.
Files of_lcov(const std::string& text, const std::string& origin);

}  // namespace dsdpv1::tb::coverage
