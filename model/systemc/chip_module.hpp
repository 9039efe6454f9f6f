#pragma once
// Shared by the two SystemC views of the DSDPV1.
#include <string>
#include <systemc>

#include "model/dsdpv1/chip.hpp"
#include "model/systemc/core_module.hpp"

namespace dsdpv1::systemc {

/// The DSDPV1 for CoreModule.
struct Dsdpv1Core {
  using Chip = dsdpv1::Chip;
  using Config = dsdpv1::Config;
  using Pin = dsdpv1::Pin;
  using Level = dsdpv1::Level;
  static std::string describe(const profibus::Event& event);
};

extern template class ListenedPort<PinChange<Pin, Level>>;

struct ChipOptions : ModuleOptions {
  Config chip{};
};

/// Base of the modules; not for direct use. peek() and poke() are of the DPRAM, 0..0x7FF.
class ChipModule : public CoreModule<Dsdpv1Core> {
 public:
  Part part() const { return part_; }

 protected:
  ChipModule(const sc_core::sc_module_name& name, const ChipOptions& options);

  Level sample(Tick at);
  /// MISO as it is strictly before `at`.
  Level miso_before(Tick at);
  bool carry_out(Tick begin, const HostAccess& access, Level& sampled);
  /// True if an access of the user has violated the timing of table 15 or P8 since the last call.
  bool take_broken_timing();
  bool broken_timing() const { return broken_timing_; }

 private:
  void heard(const profibus::Event& event) override;

  Part part_;
  bool broken_timing_ = false;
};

}  // namespace dsdpv1::systemc
