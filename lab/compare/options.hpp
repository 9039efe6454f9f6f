#pragma once
// Options of a comparison.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/compare/scale.hpp"

namespace dsdpv1::tb::compare {

/// The matches of an unknown bit (X). A is the expectation, B is compared with it.
enum class XRule : std::uint8_t {
  kExpected,  ///< X of A matches anything, X of B only X
  kAny,       ///< X of either side matches anything
  kEqual,     ///< X matches X
  kNever,     ///< X matches nothing
};

/// The matches of a released bit (Z).
enum class ZRule : std::uint8_t {
  kEqual,     ///< Z
  kExpected,  ///< Z of A matches anything, Z of B only Z
  kAny,       ///< Z of either side matches anything
};

/// A signal of A and its counterpart.
struct NamedPair {
  std::string a, b;
  bool inverted = false;    ///< B has the other level
  std::string driven;       ///< of B: while it is not set, `released` replaces b; empty: b alone
  bool driven_low = false;  ///< it is set when 0
  std::string released;     ///< empty: undriven, Z
  bool required = true;     ///< else it is left out if a side lacks it
  std::string output;       ///< of a chip: of the pairs for it one must be found; empty: no output
  std::optional<Femtoseconds> tolerance;
};

struct Clock {
  std::string signal;
  bool rising = true;
};

/// While the signal (of A, or of B when A has none) has the value, or has it not, `target` is not compared; empty: no
/// signal is.
struct Mask {
  std::string signal, value;
  bool equal = true;
  std::string target;
};

class Nets;
/// The pairs for the pins of a chip, which the signals of both sides may decide.
using ChipPairs = std::function<std::vector<NamedPair>(const Nets& a, const Nets& b)>;

struct Options {
  std::string scope_a, scope_b;
  std::vector<NamedPair> pairs;  ///< these and those of `pins`; neither: by name
  ChipPairs pins;                ///< except signals of A that `pairs` has
  bool strict = false;           ///< signals without a counterpart, and a B that ends before A, are differences
  std::optional<Femtoseconds> from, to;
  Femtoseconds shift = 0;                 ///< added to B's times
  std::optional<Femtoseconds> tolerance;  ///< default: A's unit of time if the two differ, else 0
  std::optional<Clock> clock;
  XRule x = XRule::kExpected;
  ZRule z = ZRule::kEqual;
  std::vector<Mask> masks;
};

/// "ready=0", "state!=IDLE@bus": throws InputError.
Mask parse_mask(const std::string& text);
/// "clk", "clk:rise", "clk:fall".
Clock parse_clock(const std::string& text);
/// "irq=irq_n", "irq=!irq_n"; throws InputError.
NamedPair parse_pair(const std::string& text);

}  // namespace dsdpv1::tb::compare
