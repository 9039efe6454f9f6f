#include "kinds/spc3/checks/interrupt_rules.hpp"

#include <fmt/format.h>

namespace dsdpv1::spc3_checks {
namespace {

constexpr std::uint16_t kAnswered = regs::kEventNewCfg | regs::kEventNewPrm;  // cleared by their answer
constexpr std::uint16_t kEvents = regs::kEventMacReset | regs::kEventDataEx | regs::kEventBaudDetect |
                                  regs::kEventWdTimeout | regs::kEventUserTimer | regs::kEventNewGc |
                                  regs::kEventNewSsa | kAnswered | regs::kEventDiagChanged | regs::kEventDxOut;

constexpr std::uint16_t bits(unsigned value) { return static_cast<std::uint16_t>(value); }

}  // namespace

void InterruptRules::reset() {
  imr_ = regs::kImrReset;
  seen_ = 0;
  eoi_.ends();
}

void InterruptRules::x_int(Tick at, bool level) {
  const bool high_active = (chip_.mode0().value_or(0) & regs::kMode0IntPol) != 0;
  if (level == high_active)
    eoi_.begins(at);
  else
    eoi_.ends();  // by EOI, which has been judged
}

void InterruptRules::pass(Tick now) {
  eoi_.pass(
      recorder_, Check::kIrqEoi, now, [] { return "X/INT is active, no EOI"; });
}

void InterruptRules::accessed(const RegisterAccess& access) {
  if (access.write) return written(access);
  const unsigned answer = access.value & regs::kVerdictAnswer;
  if (const auto events = events_in(access)) {
    const std::uint16_t half = (access.address & 1U) != 0 ? 0xFF00 : 0x00FF;
    if (access.address < regs::kIr) seen_ = bits(seen_ & ~half);
    seen_ = bits(seen_ | *events);
  } else if (answer != regs::kVerdictConflict &&
             (access.address == regs::kPrmOk || access.address == regs::kPrmNotOk)) {
    seen_ = bits(seen_ & ~regs::kEventNewPrm);
  } else if (answer != regs::kVerdictConflict &&
             (access.address == regs::kCfgOk || access.address == regs::kCfgNotOk)) {
    seen_ = bits(seen_ & ~regs::kEventNewCfg);
  }
}

void InterruptRules::written(const RegisterAccess& access) {
  const bool high = (access.address & 1U) != 0;
  const std::uint16_t half = high ? 0xFF00 : 0x00FF, value = bits(high ? access.value * 0x100U : access.value);
  switch (access.address) {
    case regs::kIrr:
    case regs::kIrr + 1: return clear(access, bits(half & ~value));
    case regs::kIar:
    case regs::kIar + 1:
      if ((value & kAnswered) != 0) idle(access.at);
      return clear(access, bits(value & ~kAnswered));
    case regs::kImr:
    case regs::kImr + 1: return mask(access, half, value);
    case regs::kMode1S:
      if ((value & regs::kMode1Eoi) != 0) end(access.at);
      return;
    default: return;
  }
}

void InterruptRules::clear(const RegisterAccess& access, std::uint16_t events) {
  const auto unseen = bits(events & kEvents & ~seen_);
  if (chip_.online())
    recorder_.kept(Check::kIrqSeen, access.at, unseen == 0, [&] {
      return fmt::format("{:02X} to {:02X}H clears unseen events, if they have come: {:04X}", access.value,
                         access.address, unseen);
    });
  seen_ = bits(seen_ & ~events);
}

void InterruptRules::mask(const RegisterAccess& access, std::uint16_t half, std::uint16_t value) {
  const auto opened = bits(imr_ & half & ~value & seen_ & kEvents);
  recorder_.kept(Check::kIrqMask, access.at, opened == 0, [&] { return fmt::format("events {:04X} stand", opened); });
  imr_ = bits((imr_ & ~half) | value);
}

void InterruptRules::end(Tick at) {
  if (!eoi_.since()) return idle(at);
  eoi_.met(recorder_, Check::kIrqEoi, at, [] { return "EOI"; });
}

void InterruptRules::idle(Tick at) {
  recorder_.value(
      Check::kIrqIdle, at, ++idle_, [] { return "writes without effect"; });
}

}  // namespace dsdpv1::spc3_checks
