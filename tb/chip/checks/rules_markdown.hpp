#pragma once
// The part of docs/checks.md that comes from a table of rules.
#include <string>

#include "tb/chip/checks/check.hpp"

namespace dsdpv1::checks {

/// A row for each rule, then a section for each. `place`: the page and anchor of a ruling, "chip.md#s6" for S6.
std::string rules_markdown(const RuleTable& rules, std::string (*place)(const std::string& ruling));

}  // namespace dsdpv1::checks
