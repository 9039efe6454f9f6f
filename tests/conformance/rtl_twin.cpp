#include "tests/conformance/rtl_twin.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>

#include "cosim/lockstep.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"

namespace dsdpv1::conformance {
namespace {

using Lockstep = cosim::Lockstep;

std::unique_ptr<Lockstep> make_lockstep(const Config& config, unsigned fault) {
  const tb::ChipKind& kind = *tb::find_chip_kind(row(config.part).name);
  tb::Dsdpv1Settings settings;
  static_cast<Config&>(settings) = config;
  return std::make_unique<Lockstep>(kind.make_device({"chip", settings}),
                                    kind.rtl()->make_reference(settings, fault, cosim::kUsualSeed), kind, settings);
}

}  // namespace

std::unique_ptr<RtlTwin> RtlTwin::make(const Config& config) {
  const char* const fault = std::getenv("DSDPV1_RTL_TWIN");
  if (fault == nullptr) return nullptr;
  return std::make_unique<RtlTwin>(make_lockstep(config, static_cast<unsigned>(std::strtoul(fault, nullptr, 10))));
}

RtlTwin::RtlTwin(std::unique_ptr<Lockstep> lockstep) : lockstep_(std::move(lockstep)) {}

RtlTwin::~RtlTwin() = default;

void RtlTwin::set(bus::Tick at, Pin pin, Level level) { lockstep_->set(at, number(pin), level); }

void RtlTwin::compare(bus::Tick at) {
  lockstep_->advance(at);
  if (!lockstep_->difference() || std::exchange(differs_, true)) return;
  ADD_FAILURE() << "model and reference RTL: " << cosim::describe(*lockstep_->difference());
}

}  // namespace dsdpv1::conformance
