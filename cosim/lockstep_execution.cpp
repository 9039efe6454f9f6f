#include "cosim/lockstep_execution.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cosim/rtl_device.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::cosim {
namespace {

std::unique_ptr<Rtl> rtl_of(const MakeRtl& make, const tb::ChipKind& kind, const tb::ChipRequest& request) {
  require_rtl(kind);
  return make(request.name, kind, request.settings);
}

class RtlExecution : public tb::Execution {
 public:
  explicit RtlExecution(MakeRtl make) : make_(std::move(make)) {}

  std::unique_ptr<tb::ChipView> make_chip(const tb::ChipKind& kind, const tb::ChipRequest& request) override {
    std::unique_ptr<Rtl> rtl = rtl_of(make_, kind, request);
    return add_chip(kind, request,
                    std::make_unique<RtlDevice>(kind.make_device(request), std::move(rtl), kind, request.settings));
  }
  void run(tb::Tick end, const std::function<bool()>& stopped) override {
    while (!stopped() && timeline_.step(end)) {
    }
  }

 private:
  MakeRtl make_;
};

}  // namespace

void require_rtl(const tb::ChipKind& kind) {
  if (kind.rtl() != nullptr) return;
  std::vector<std::string> with_rtl;
  for (const tb::ChipKind* each : tb::chip_kinds())
    if (each->rtl() != nullptr) with_rtl.emplace_back(each->name());
  throw tb::InputError(
      fmt::format("RTL is for chips of the kinds {}, the scenario has {}", tb::join(with_rtl), kind.name()));
}

std::unique_ptr<tb::Execution> make_rtl_execution(MakeRtl make) {
  return std::make_unique<RtlExecution>(std::move(make));
}

std::unique_ptr<tb::ChipView> LockstepExecution::make_chip(const tb::ChipKind& kind, const tb::ChipRequest& request) {
  std::unique_ptr<Rtl> rtl = rtl_of(make_, kind, request);
  auto device = std::make_unique<Lockstep>(kind.make_device(request), std::move(rtl), kind, request.settings, options_);
  chips_.push_back({request.name, device.get()});
  return add_chip(kind, request, std::move(device));
}

void LockstepExecution::run(tb::Tick end, const std::function<bool()>& stopped) {
  while (!stopped() && !broken_off() && timeline_.step(end)) {
  }
  const Tick reached = stopped() || broken_off() ? timeline_.now() : std::max(end, timeline_.now());
  for (const Chip& chip : chips_) chip.lockstep->advance(reached);
}

Lockstep* LockstepExecution::different() {
  const auto found = std::find_if(chips_.begin(), chips_.end(),
                                  [](const Chip& chip) { return chip.lockstep->difference().has_value(); });
  return found == chips_.end() ? nullptr : found->lockstep;
}

const std::string& LockstepExecution::different_name() {
  return std::find_if(
             chips_.begin(), chips_.end(), [](const Chip& chip) { return chip.lockstep->difference().has_value(); })
      ->name;
}

MatchCounts LockstepExecution::counts() const {
  MatchCounts sum;
  for (const Chip& chip : chips_) {
    const MatchCounts& one = chip.lockstep->counts();
    sum.cycles = std::max(sum.cycles, one.cycles);
    sum.pin_changes += one.pin_changes;
    sum.dpram_images += one.dpram_images;
  }
  return sum;
}

tb::LockstepResult LockstepExecution::result() {
  const MatchCounts sum = counts();
  tb::LockstepResult result{sum.cycles, sum.pin_changes, sum.dpram_images, {}};
  const Lockstep* found = different();
  if (found == nullptr) return result;
  result.cycles = found->counts().cycles;
  result.difference = found->difference();
  result.difference->slave = different_name();
  return result;
}

bool report(LockstepExecution& execution, const std::string& wave, std::string& text) {
  const tb::LockstepResult result = execution.result();
  Lockstep* different = execution.different();
  text = fmt::format("lockstep          {} cycles, {} pin changes and {} DPRAM images of model and RTL are the same\n",
                     result.cycles, result.pin_changes, result.dpram_images);
  if (different == nullptr) return true;
  text += fmt::format("chip              {}\n{}", execution.different_name(), describe(*different->difference()));
  if (!wave.empty()) {
    different->write_wave(wave);
    text += fmt::format("wave              {}\n", wave);
  }
  return false;
}

}  // namespace dsdpv1::cosim
