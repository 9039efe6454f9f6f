#include "board/cpu/fault.hpp"

#include <fmt/core.h>

namespace dsdpv1::arm {

namespace {

std::string what_happened(const Fault& fault) {
  switch (fault.kind) {
    case FaultKind::kUndefinedInstruction: return "undefined instruction";
    case FaultKind::kNoCoprocessor: return "instruction of a coprocessor that this processor does not have";
    case FaultKind::kInvalidState: return "branch to an even address (no Thumb bit)";
    case FaultKind::kFetch: return "execution outside of flash and RAM";
    case FaultKind::kData: return fmt::format("no memory or peripheral takes the access to 0x{:08X}", fault.address);
    case FaultKind::kStacking:
      return fmt::format("exception entry with the stack outside of RAM, at 0x{:08X}", fault.address);
    case FaultKind::kUnstacking:
      return fmt::format("exception return with the stack outside of RAM, at 0x{:08X}", fault.address);
    case FaultKind::kExceptionReturn:
      return fmt::format("exception return with EXC_RETURN or XPSR 0x{:08X}", fault.address);
    case FaultKind::kBreakpoint: return "BKPT without a debugger";
    case FaultKind::kUnaligned:
      return "LDM, STM, LDRD, STRD, LDREX or STREX at an address that is no multiple of the size";
    case FaultKind::kSupervisorCall: return "SVC where its handler's priority does not allow it";
  }
  return {};
}

const char* name_of(unsigned handler) {
  constexpr const char* kNames[] = {"MemManage", "BusFault", "UsageFault"};
  return handler >= 4 && handler <= 6 ? kNames[handler - 4] : "HardFault";
}

std::string what_became(const Fault& fault) {
  switch (fault.outcome) {
    case FaultOutcome::kHandled: return fmt::format("{} handler entered", name_of(fault.handler));
    case FaultOutcome::kNoHandler: return fmt::format("the firmware has no {} handler", name_of(fault.handler));
    case FaultOutcome::kLockup: return "lockup: already at the priority of HardFault";
  }
  return {};
}

}  // namespace

std::string describe(const Fault& fault) {
  return fmt::format("at 0x{:08X}: {}; {}", fault.pc, what_happened(fault), what_became(fault));
}

std::string table(const Registers& registers) {
  const auto& r = registers.r;
  std::string text;
  for (std::size_t row = 0; row < 12; row += 4) {
    text += fmt::format("r{:<4}{:08X}  r{:<4}{:08X}  r{:<4}{:08X}  r{:<4}{:08X}\n", row, r[row], row + 1, r[row + 1],
                        row + 2, r[row + 2], row + 3, r[row + 3]);
  }
  text += fmt::format("r12  {:08X}  sp   {:08X}  lr   {:08X}  pc   {:08X}\n", r[12], registers.sp, registers.lr,
                      registers.pc);
  text += fmt::format("xpsr {:08X}  msp  {:08X}  psp  {:08X}  ctrl {:08X}\n", registers.xpsr, registers.msp,
                      registers.psp, registers.control);
  return text;
}

}  // namespace dsdpv1::arm
