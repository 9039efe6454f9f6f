#pragma once
// Judging of a scenario's conditions.
#include <string>

#include "tb/bench/journal.hpp"
#include "tb/bench/reply.hpp"
#include "tb/bench/stations.hpp"
#include "tb/scenario/scenario.hpp"

namespace tb {

/// What conditions are about.
struct Facts {
  const Stations& stations;
  const Journal& journal;
  const Replies& replies;
};

struct Judged {
  bool holds = false;
  std::string seen;  ///< what is there instead or as well: "dp_state WAIT_CFG, data_exchanges 0"
};

Judged judge(const scenario::Condition& condition, const Facts& facts);

/// The condition in words: "demo: dp_state DATA_EXCH, data_exchanges >= 10".
std::string describe(const scenario::Condition& condition);
/// ... with its time: "... by 9ms".
std::string describe(const scenario::Expectation& expectation);

}  // namespace tb
