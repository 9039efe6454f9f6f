#pragma once
// Shared by the SystemC views of the SPC3 family.
#include <string>
#include <systemc>

#include "model/spc3/chip.hpp"
#include "model/systemc/core_module.hpp"

namespace dsdpv1::systemc {

/// The SPC3 family for CoreModule.
struct Spc3Core {
  using Chip = spc3::Chip;
  using Config = spc3::Config;
  using Pin = spc3::Pin;
  using Level = spc3::Level;
  static std::string describe(const profibus::Event& event);
};

extern template class ListenedPort<PinChange<spc3::Pin, spc3::Level>>;

struct Spc3Options : ModuleOptions {
  spc3::Config chip{};  ///< also the name, spc3::Variant
};

/// Base of the modules; not for direct use. peek() and poke() are of the addresses in Intel order, 0..0x7FF (VPC3+:
/// 0xFFF); a peek is of the read side.
class Spc3Module : public CoreModule<Spc3Core> {
 protected:
  Spc3Module(const sc_core::sc_module_name& name, const Spc3Options& options);
};

}  // namespace dsdpv1::systemc
