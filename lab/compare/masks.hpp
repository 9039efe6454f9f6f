#pragma once
// Conditions under which nothing, or one signal, is not compared.

#include "lab/compare/side.hpp"

namespace dsdpv1::tb::compare {

class Masks {
 public:
  /// Throws InputError when a mask names an unknown signal, or a value that the signal cannot have.
  Masks(const std::vector<Mask>& masks, Side& a, Side& b, const std::vector<Pair>& pairs);
  /// Processes the changes; adds signals whose comparison resumes or stops to `pairs`.
  void settle(Touched& pairs);
  bool hide(std::uint32_t pair) const { return all_ != 0 || of_pair_[pair] != 0; }

 private:
  struct Condition {
    Side* side = nullptr;
    Probe probe;
    std::string value;
    bool equal = true, holds = false;
    std::vector<std::uint32_t> targets;  ///< empty: all
  };
  void hold(Condition& condition, bool holds, Touched& pairs);

  std::vector<Condition> conditions_;
  Touched touched_;
  std::vector<std::uint32_t> of_pair_;  ///< number of masks on it alone
  std::uint32_t all_ = 0;               ///< ... for all
};

}  // namespace dsdpv1::tb::compare
