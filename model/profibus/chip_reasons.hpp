#pragma once
// The reasons of a kind of chip, in its words: what its reasons.hpp offers to callers, as function objects.
#include <initializer_list>
#include <string>
#include <vector>

#include "model/profibus/event.hpp"

namespace dsdpv1::profibus {

/// All reasons of these rooms, in this order.
std::vector<Reason> reasons_of(std::initializer_list<ReasonTable> rooms);

/// The event as text, one line, without the time.
template <const Words& kWords>
struct Describe {
  std::string operator()(const Event& event) const { return profibus::describe(event, kWords); }
};
/// The text of a reason with its placeholders: for documentation.
template <const Words& kWords>
struct TextTemplate {
  std::string operator()(Reason reason) const { return profibus::text_template(reason, kWords); }
};
/// The remedy.
template <const Words& kWords>
struct Advice {
  std::string operator()(Reason reason) const { return profibus::advice(reason, kWords); }
};

}  // namespace dsdpv1::profibus
