#pragma once
// Runs a bus::Timeline (masters, user CPUs, scripts) inside a SystemC simulation, so that they and chips in SystemC
// views share time.
#include <functional>
#include <systemc>
#include <vector>

#include "bus/timeline.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"

namespace dsdpv1::systemc_bench {

/// One SC_THREAD that sleeps until the timeline's next action and runs what is due. At equal times the SystemC
/// processes are first: an agent that looks at tick t sees everything that the chips did up to and including t. Ticks
/// of the timeline are simulation time since 0.
class TimelineModule : public sc_core::sc_module {
 public:
  /// `timeline` must outlive the simulation; nobody else runs it.
  TimelineModule(const sc_core::sc_module_name& name, bus::Timeline& timeline);

  /// A chip on the timeline, for the whole of its life. What an access under way has done is told before agents act.
  void add(dsdpv1::systemc::TlmModule& chip) { chips_.push_back(&chip); }

  /// The last tick to which an agent's turn may go on (Timeline::go_on).
  bus::Tick limit = bus::kNever;
  /// Asked after each step: true pauses the simulation (sc_pause), and no agent acts any more.
  std::function<bool()> stopped = [] { return false; };

  /// As bus::Timeline has them: neither an agent nor the kernel does anything until then. The agent, and what it calls
  /// with the timeline's time, is ahead of simulation time from then on.
  bus::Tick quiet_until(const bus::Agent& agent);
  bool go_on(const bus::Agent& agent, bus::Tick tick);
  /// By how much the timeline is ahead of simulation time.
  sc_core::sc_time ahead() const { return dsdpv1::systemc::time_until(timeline_.now()); }
  /// Simulation time comes up with an agent that has gone on, before it touches what lives in simulation time.
  void catch_up();

  /// To be called when something other than the timeline's own agents may have changed an agent's plan (a chip drove
  /// the bus).
  void wake() { wake_.notify(sc_core::SC_ZERO_TIME); }

 private:
  void run();
  bool in_access() const;
  void follow_accesses();
  void sleep(bus::Tick due);

  bus::Timeline& timeline_;
  std::vector<dsdpv1::systemc::TlmModule*> chips_;
  bool in_turn_ = false;  ///< an agent acts, none of the kernel's processes
  sc_core::sc_event wake_{"wake"};
};

}  // namespace dsdpv1::systemc_bench
