#pragma once
// The masters of a scenario on an external bus, with their part of its script. The slaves are elsewhere: RTL in a
// simulator, a chip of the caller.
#include <functional>
#include <string>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "tb/bench/journal.hpp"
#include "tb/bench/reply.hpp"
#include "tb/bench/script.hpp"
#include "tb/bench/setup.hpp"
#include "tb/bench/stations.hpp"

namespace dsdpv1::tb {

class ScenarioMasters {
 public:
  /// They attach to the segment, class 1 first, each in the order of the file; segment and timeline must outlive them.
  /// Throws InputError for a scenario without masters, and for a `when` of theirs that only a slave could evaluate.
  ScenarioMasters(scenario::Scenario scenario, bus::Segment& segment, const bus::Timeline& timeline);
  ScenarioMasters(const ScenarioMasters&) = delete;
  ScenarioMasters& operator=(const ScenarioMasters&) = delete;

  Stations& stations() { return stations_; }
  /// The script, to be added to the timeline after the masters.
  bus::Agent& script() { return script_; }
  /// A value that conditions of the script may refer to has changed: they are evaluated again at `at`.
  void changed(Tick at) { script_.changed(at); }
  /// The parts of the scenario that do not concern masters and are ignored, in one line.
  const std::string& left_out() const { return left_out_; }
  /// The number of the master named by `asker`: its name, that of one of its connections, "" for the first.
  std::size_t number_of(const std::string& asker) const;

  /// Called for the answer to a request of the script.
  std::function<void(const std::string& asker, scenario::ActionKind service, const Reply& reply)> on_reply;

 private:
  const scenario::Scenario whole_;
  Setup setup_;
  const std::string left_out_;
  const scenario::Scenario part_;  ///< without slaves and their parts
  Observers observers_;
  Journal journal_;
  Replies replies_;
  Stations stations_;
  Script script_;
};

}  // namespace dsdpv1::tb
