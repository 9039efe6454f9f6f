// Chips by the pins of their cores.
#include "tb/bench/execution.hpp"

namespace dsdpv1::tb {
namespace {

class PinExecution : public Execution {
 public:
  std::unique_ptr<ChipView> make_chip(const ChipMaker& maker, const ChipRequest& request) override {
    return maker.make_pin_chip(request, segment_, timeline_);
  }

  bool quiet(const bus::Agent& agent, Tick tick) override { return timeline_.quiet(agent, tick); }
  bool go_on(const bus::Agent& agent, Tick tick) override { return timeline_.go_on(agent, tick); }

  void run(Tick end, const std::function<bool()>& stopped) override {
    while (!stopped() && timeline_.step(end)) {
    }
  }
};

}  // namespace

std::unique_ptr<Execution> make_pin_execution() { return std::make_unique<PinExecution>(); }

}  // namespace dsdpv1::tb
