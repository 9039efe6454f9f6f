#pragma once
// The part of docs/checks.md that comes from a table of rules.
#include <string>

#include "tb/chip/checks/check.hpp"

namespace dsdpv1::checks {

/// The page and anchor of a ruling, "chip.md#s6" for S6; tb::ruling_place.
using RulingPlace = std::string (*)(const std::string& ruling);

/// A row for each rule, then a section for each.
std::string rules_markdown(const RuleTable& rules, RulingPlace place);

}  // namespace dsdpv1::checks
