#pragma once
// Runs a bus::Timeline (masters, user CPUs, scripts) inside a SystemC simulation, so that they and chips in SystemC
// views share time.
#include <functional>
#include <systemc>

#include "bus/timeline.hpp"

namespace systemc_bench {

/// One SC_THREAD that sleeps until the timeline's next action and runs what is due. At equal times the SystemC
/// processes are first: an agent that looks at tick t sees everything that the chips did up to and including t. Ticks
/// of the timeline are simulation time since 0.
class TimelineModule : public sc_core::sc_module {
 public:
  /// `timeline` must outlive the simulation; nobody else runs it.
  TimelineModule(const sc_core::sc_module_name& name, bus::Timeline& timeline);

  /// Called before the agents act: brings what keeps a time of its own up to the present.
  std::function<void()> on_turn;

  /// To be called when something other than the timeline's own agents may have changed an agent's plan (a chip drove
  /// the bus).
  void wake() { wake_.notify(sc_core::SC_ZERO_TIME); }

 private:
  void run();
  void sleep(bus::Tick due);

  bus::Timeline& timeline_;
  sc_core::sc_event wake_{"wake"};
};

}  // namespace systemc_bench
