#pragma once
// The scenario's script and expectations, as the last agent of the timeline: it acts after all other agents at a tick.
#include <cstddef>
#include <set>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "tb/bench/journal.hpp"
#include "tb/bench/observer.hpp"
#include "tb/bench/record.hpp"
#include "tb/bench/reply.hpp"
#include "tb/bench/stations.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

class Script : public bus::Agent, public Observer {
 public:
  /// All arguments must outlive it. `left_out`: addresses of actions and expectations that are neither executed nor
  /// judged.
  Script(const scenario::Scenario& scenario, Stations& stations, bus::Segment& segment, Journal& journal,
         Replies& replies, const std::set<const void*>& left_out, const Observers& observers);

  /// Conditions are evaluated again at `at`.
  void changed(Tick at) override {
    if (!waits_) return;
    changed_at_ = at;
    announce();
  }
  bool acts_on_events() const override { return waits_; }
  Tick next() const override;
  void run(Tick now) override;
  /// An action from outside, done at the next step.
  void order(scenario::Action action);
  /// Judges the expectations for the end; an expectation whose time did not come has failed, as have those for the end
  /// if interrupted.
  std::vector<ExpectationResult> finish(Tick now, bool interrupted);

 private:
  enum class Kind : std::uint8_t {
    kReleaseReset,
    kStartMaster,
    kStartMaster2,
    kAction,
    kResumeUser,
    kEndGlitch,
    kExpectation
  };
  /// One entry of the agenda.
  struct Due {
    Tick at = 0;
    Kind kind{};
    std::size_t index = 0;  ///< of the slave, master, action or expectation
  };
  void plan(Tick at, Kind kind, std::size_t index);
  void carry_out(const Due& due, Tick now);
  void look(Tick now);
  bool waits() const;
  void look_at_actions(Tick now);
  void judge(std::size_t index, Tick now, bool last_chance);

  void act(const scenario::Action& action, Tick now);
  void act_on_user(const scenario::Action& action, Tick now);
  void act_on_master(const scenario::Action& action, Tick now);
  void act_on_class2(const scenario::Action& action, Class2Station& station, Tick now);
  void act_on_bus(const scenario::Action& action, Tick now);
  void order_of_chip(const scenario::Action& action, Tick now);
  void reset_chip(const scenario::Action& action, Tick now);
  void ask(const scenario::Action& action);
  void ask_acyclic(const scenario::Action& action);
  void global_control(const scenario::Action& action);
  void send_telegram(const scenario::Action& action);
  std::uint8_t target(const scenario::Action& action) const;

  const scenario::Scenario& scenario_;
  Stations& stations_;
  bus::Segment& segment_;
  Journal& journal_;
  Replies& replies_;
  const Observers& observers_;
  std::vector<scenario::Action> orders_;
  std::vector<Due> agenda_;           ///< latest first; equal times in the order of planning
  std::vector<std::size_t> waiting_;  ///< actions whose condition does not hold yet
  std::vector<ExpectationResult> expectations_;
  std::vector<bool> judged_;
  bool waits_ = true;  ///< for a condition to come true, else no change means anything
  Tick changed_at_ = bus::kNever;
};

}  // namespace dsdpv1::tb
