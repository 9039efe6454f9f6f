#pragma once
// What is compared, and how.
#include <optional>
#include <string>
#include <vector>

#include "lab/compare/scale.hpp"

namespace dsdpv1::tb::compare {

/// What an unknown bit (X) matches. A is what is expected, B what is held to it.
enum class XRule : std::uint8_t {
  kExpected,  ///< X of A matches anything, X of B only X
  kAny,       ///< X of either side matches anything
  kEqual,     ///< X matches X
  kNever,     ///< X matches nothing
};

/// What a released bit (Z) matches.
enum class ZRule : std::uint8_t {
  kEqual,     ///< Z
  kExpected,  ///< Z of A matches anything, Z of B only Z
  kAny,       ///< Z of either side matches anything
};

/// A signal of A and its counterpart.
struct NamedPair {
  std::string a, b;
  bool inverted = false;    ///< B has the other level
  std::string driven;       ///< of B: while it does not say so, `released` stands in b's place; empty: b alone
  bool driven_low = false;  ///< it says so with 0
  std::string released;     ///< empty: nobody drives, Z
  bool required = true;     ///< else it is left out where a side lacks it
  std::optional<Femtoseconds> tolerance;
};

struct Clock {
  std::string signal;
  bool rising = true;
};

/// While the signal (of A, or of B when A has none) has the value, or has it not, `target` is not compared; empty:
/// nothing is.
struct Mask {
  std::string signal, value;
  bool equal = true;
  std::string target;
};

struct Options {
  std::string scope_a, scope_b;
  std::vector<NamedPair> pairs;  ///< empty: by name
  std::optional<Femtoseconds> from, to;
  Femtoseconds shift = 0;                 ///< added to B's times
  std::optional<Femtoseconds> tolerance;  ///< left out: the coarser time scale's unit where the two differ, else 0
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
