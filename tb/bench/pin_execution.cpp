// Chips by the pins of their cores.
#include <utility>

#include "tb/bench/execution.hpp"

namespace dsdpv1::tb {
namespace {

class PinExecution : public Execution {
 public:
  Tick quiet_until(const bus::Agent& agent) override { return timeline_.quiet_until(agent); }
  bool go_on(const bus::Agent& agent, Tick tick) override { return timeline_.go_on(agent, tick); }

  void run(Tick end, const std::function<bool()>& stopped) override {
    while (!stopped() && timeline_.step(end)) {
    }
  }
};

}  // namespace

std::unique_ptr<ChipView> Execution::add_chip(const ChipKind& kind, const ChipRequest& request,
                                              std::unique_ptr<PinDevice> device) {
  std::unique_ptr<PinChip> chip = kind.make_pin_chip(request, std::move(device), segment_);
  timeline_.add(*chip);
  return chip;
}

std::unique_ptr<Execution> make_pin_execution() { return std::make_unique<PinExecution>(); }

}  // namespace dsdpv1::tb
