#include "model/systemc/chip_module.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::systemc {
namespace {

/// The violations of the host port after which the data of the access are not reliable.
bool spoils_data(profibus::Reason reason) {
  constexpr profibus::Reason kSpoiling[] = {
      Reason::kWriteLowTooShort, Reason::kWriteSetup,   Reason::kWriteHold,          Reason::kWriteFloating,
      Reason::kWriteDeselected,  Reason::kWriteOverrun, Reason::kReadAddressChanged, Reason::kReadTooShort,
      Reason::kReadInFlight,     Reason::kReadUnknown};
  return std::find(std::begin(kSpoiling), std::end(kSpoiling), reason) != std::end(kSpoiling);
}

}  // namespace

std::string Dsdpv1Core::describe(const profibus::Event& event) { return dsdpv1::describe(event); }

ChipModule::ChipModule(const sc_core::sc_module_name& name, const ChipOptions& options)
    : CoreModule(name, options.chip, options), part_(options.chip.part) {
  begin_pins(outputs_of(part_), pin_count(part_));
}

Level ChipModule::sample(Tick at) {
  Level level = kLevelX;
  in_core([&] { level = chip_.sample(at); });
  return level;
}

Level ChipModule::miso_before(Tick at) {
  advance(at - 1);
  return chip_.level(Pin::kMiso);
}

bool ChipModule::carry_out(Tick begin, const HostAccess& access, Level& sampled) {
  bool done = false;
  in_core([&] { done = chip_.carry_out(begin, access, sampled); });
  return done;
}

bool ChipModule::take_broken_timing() { return std::exchange(broken_timing_, false); }

void ChipModule::heard(const profibus::Event& event) { broken_timing_ = broken_timing_ || spoils_data(event.reason); }

template class ListenedPort<PinChange<Pin, Level>>;

}  // namespace dsdpv1::systemc
