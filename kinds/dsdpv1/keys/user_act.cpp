#include "kinds/dsdpv1/keys/user_act.hpp"

#include <algorithm>
#include <array>

#include "model/dsdpv1/reasons.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::tb {
namespace {

using bus::Tick;
using profibus::Reason;
using user_cpu::Act;
using Block = dpram::Reason;
using Port = dsdpv1::Reason;

// Refusals of what the user handed over: by a flag of its first command byte, by one of the second, and telegrams.
constexpr std::array kBlocks = {
    Block::kInitCrc,         Block::kInitLength,     Block::kInitAddress,        Block::kInitLimit,
    Block::kInitCfg,         Reason::kInputLength,   Block::kInputCrc,           Reason::kDiagLength,
    Reason::kDiagType,       Block::kDiagCrc,        Reason::kVerdictUnexpected, Reason::kVerdictSuperseded,
    Reason::kPrmUserRefused, Reason::kCfgUserRefused};
constexpr std::array kAnswers = {Block::kC1Crc, Block::kC2Crc, Block::kAcyclicLength, Reason::kAcyclicNoRequest,
                                 Reason::kAcyclicAnswerDiffers};
constexpr std::array kTelegrams = {Port::kTelegramStart,   Port::kTelegramCut,  Port::kTelegramCrc,
                                   Port::kTelegramAddress, Port::kTelegramData, Port::kTelegramLength,
                                   Port::kUartParity,      Port::kUartFraming,  Port::kSpiBusy};

template <class Reasons>
bool holds(const Reasons& reasons, Reason reason) {
  return std::find(reasons.begin(), reasons.end(), reason) != reasons.end();
}

}  // namespace

std::optional<Act> user_act_of(const profibus::Event& event) {
  if (event.reason == Port::kStrapChanged) return std::nullopt;
  if (event.reason == Port::kSpiUTimer)
    return Act::omitted(event.at - Tick{event.a} * profibus::kTicksPerCycle, event.at);
  if (event.reason == Block::kBeforeInit) return Act::written(event.b, event.at);
  if (holds(kBlocks, event.reason)) return Act::written(regs::kUserCommand1, event.at);
  if (holds(kAnswers, event.reason)) return Act::written(regs::kUserCommand2, event.at);
  const bool violates = profibus::severity(event.reason) == profibus::Severity::kViolation;
  return violates || holds(kTelegrams, event.reason) ? std::optional(Act::done(event.at)) : std::nullopt;
}

}  // namespace dsdpv1::tb
