#pragma once
// Runs a bus::Timeline (masters, user CPUs, scripts) inside a SystemC simulation, so that it shares time with chips in
// SystemC views.
#include <functional>
#include <systemc>
#include <vector>

#include "bus/timeline.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"

namespace dsdpv1::systemc_bench {

/// One SC_THREAD that sleeps until the timeline's next action and runs due actions. At equal times the SystemC
/// processes are first: an agent at tick t sees everything that the chips did up to and including t. Ticks of the
/// timeline are simulation time since 0.
class TimelineModule : public sc_core::sc_module {
 public:
  /// `timeline` must outlive the simulation; only this module runs it.
  TimelineModule(const sc_core::sc_module_name& name, bus::Timeline& timeline);

  /// Adds a chip for its whole lifetime. The effects of an access in progress are reported before agents act.
  void add(dsdpv1::systemc::TlmModule& chip) { chips_.push_back(&chip); }

  /// The last tick to which an agent's turn may be extended (Timeline::go_on).
  bus::Tick limit = bus::kNever;
  /// Called after each step: true pauses the simulation (sc_pause), and agents stop acting.
  std::function<bool()> stopped = [] { return false; };

  /// As in bus::Timeline: neither an agent nor the kernel acts until then. The agent, and its calls with the timeline's
  /// time, are ahead of simulation time from then on.
  bus::Tick quiet_until(const bus::Agent& agent);
  bool go_on(const bus::Agent& agent, bus::Tick tick);
  /// The timeline's lead over simulation time.
  sc_core::sc_time ahead() const { return dsdpv1::systemc::time_until(timeline_.now()); }
  /// Advances simulation time to an agent with an extended turn, before it touches objects in simulation time.
  void catch_up();

  /// Call this when something other than the timeline's agents may have changed an agent's plan (a chip drove the bus).
  void wake() { wake_.notify(sc_core::SC_ZERO_TIME); }

 private:
  void run();
  bool in_access() const;
  void follow_accesses();
  void sleep(bus::Tick due);

  bus::Timeline& timeline_;
  std::vector<dsdpv1::systemc::TlmModule*> chips_;
  bool in_turn_ = false;  ///< an agent is acting, none of the kernel's processes
  sc_core::sc_event wake_{"wake"};
};

}  // namespace dsdpv1::systemc_bench
