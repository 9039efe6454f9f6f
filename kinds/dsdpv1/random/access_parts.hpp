#pragma once
// The parts of a chip access to the DPRAM that stimuli target and situations distinguish, in the words of
// dpram::Inside::item.
#include <cstddef>

namespace dsdpv1::cosim {

enum class AccessPart {
  kStartUp,
  kCommands,
  kChoice,  ///< a transfer's last cycle: its flag is set or cleared, the next one is not chosen yet
  // H4's transfers, without those that end in the cycle of the choice.
  kInit,
  kPrmVerdict,
  kCfgVerdict,
  kInputs,
  kDiag,
  kC1Answer,
  kC2Answer,
  kPrm,
  kCfg,
  kOutputs,
  kC1Request,
  kC2Request,
  kStatusB00B,
  kNone,
};

inline constexpr auto kFirstTransfer = static_cast<std::size_t>(AccessPart::kInit);

/// By AccessPart.
inline constexpr const char* kAccessParts[] = {"start-up",        "commands",        "choice",     "initialisation",
                                               "Set_Prm verdict", "Chk_Cfg verdict", "inputs",     "diagnosis",
                                               "C1 answer",       "C2 answer",       "Set_Prm",    "Chk_Cfg",
                                               "outputs",         "C1 request",      "C2 request", "status B00B"};

/// Action::during.
inline const char* item_of(AccessPart part) {
  return part == AccessPart::kNone ? nullptr : kAccessParts[static_cast<std::size_t>(part)];
}

}  // namespace dsdpv1::cosim
