#pragma once
// The kinds of chips in the library.
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "capi/names.hpp"
#include "capi/parameter.hpp"
#include "dsdpv1/chip.h"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::capi {

/// A chip to be created.
struct ChipPlan {
  std::string name;
  std::unique_ptr<tb::OwnSettings> settings;  ///< from ChipKind::make_chip_settings
  tb::Engine engine = tb::Engine::kSkip;
  std::vector<std::pair<std::string, std::int64_t>> parameters = {};  ///< those that `settings` was given

  /// Valid as long as the plan.
  tb::ChipRequest request() const { return {name, *settings, engine}; }
};

struct Kind {
  explicit Kind(const tb::ChipKind& its_chip);

  const tb::ChipKind& chip;
  const std::vector<tb::Level> reset_levels;  ///< before the first call of a chip at power-on, by pin
  const std::vector<Parameter> parameters;
  const bool has_host_bus;  ///< a parallel one, whose D is sampled
};

[[noreturn]] void refuse_host_bus();

/// The first one is the default.
const std::deque<Kind>& kinds();
/// Throws for an unknown kind; NULL and "" are the first one.
const Kind& kind_of(const char* name);
const Kind* find_kind(const char* name);

}  // namespace dsdpv1::capi
