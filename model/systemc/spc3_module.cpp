#include "model/systemc/spc3_module.hpp"

#include "model/spc3/reasons.hpp"

namespace dsdpv1::systemc {

std::string Spc3Core::describe(const profibus::Event& event) { return spc3::describe(event); }

Spc3Module::Spc3Module(const sc_core::sc_module_name& name, const Spc3Options& options)
    : CoreModule(name, options.chip, options) {
  begin_pins(spc3::kOutputPins, spc3::kPinCount);
}

template class ListenedPort<PinChange<spc3::Pin, spc3::Level>>;

}  // namespace dsdpv1::systemc
