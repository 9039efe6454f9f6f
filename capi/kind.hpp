#pragma once
// The kinds of chips that the library has, as far as the bench's ChipKind does not say it: how one is made without a
// bench.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "capi/names.hpp"
#include "capi/parameter.hpp"
#include "dsdpv1/chip.h"
#include "model/profibus/reason.hpp"
#include "tb/bench/chip_maker.hpp"

struct dpsim_bus;

namespace dsdpv1::capi {

/// A chip to be made.
struct ChipPlan {
  std::string name;
  std::unique_ptr<tb::OwnSettings> settings;  ///< of ChipKind::make_chip_settings
  tb::Engine engine = tb::Engine::kSkip;

  /// Good as long as the plan.
  tb::ChipRequest request() const { return {name, *settings, engine}; }
};

class Kind {
 public:
  virtual ~Kind() = default;

  virtual const tb::ChipMaker& maker() const = 0;
  virtual const std::vector<profibus::Reason>& reasons() const = 0;
  /// Before the first call of a chip fresh from power-on, by number of the pin.
  virtual const std::vector<tb::Level>& reset_levels() const = 0;
  /// Cells of the memory that chip and user share.
  virtual std::uint16_t cells() const = 0;
  /// Whether it has the pins of dsdpv1::HostAccess, with their numbers.
  virtual bool has_host_bus() const = 0;
  /// Whether a key of the chip in scenarios is the level of pins: a program sets those.
  virtual bool is_strap(const std::string& key) const = 0;
  virtual const std::vector<Parameter>& parameters() const = 0;
  /// The input that is the line when the chip is on a bus.
  virtual tb::PinNumber line_pin() const = 0;
  virtual std::unique_ptr<dpsim_chip> make_alone(const ChipPlan& plan) const = 0;
  virtual std::unique_ptr<dpsim_chip> make_on_bus(const ChipPlan& plan, dpsim_bus& bus) const = 0;
};

/// The first one is the default.
const std::vector<const Kind*>& kinds();
/// Throws for a kind that there is not; NULL and "" are the first one.
const Kind& kind_of(const char* name);
const Kind* find_kind(const char* name);

const Kind& dsdpv1_kind();
const Kind& dsdpv1_r_kind();
const Kind& dsdpv1_rsu_kind();

}  // namespace dsdpv1::capi
