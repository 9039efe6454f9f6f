#pragma once
// Evaluates a scenario's conditions.
#include <string>

#include "tb/bench/journal.hpp"
#include "tb/bench/reply.hpp"
#include "tb/bench/stations.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// The data that conditions refer to.
struct Facts {
  const Stations& stations;
  const Journal& journal;
  const Replies& replies;
};

/// Called at every change, so it makes no text.
bool holds(const scenario::Condition& condition, const Facts& facts);
/// The actual values: "dp_state WAIT_CFG, data_exchanges 0".
std::string seen(const scenario::Condition& condition, const Facts& facts);

/// The condition as text: "demo: dp_state DATA_EXCH, data_exchanges >= 10".
std::string describe(const scenario::Condition& condition);
/// ... with its time: "... by 9ms".
std::string describe(const scenario::Expectation& expectation);

}  // namespace dsdpv1::tb
