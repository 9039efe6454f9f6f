#pragma once
// A fault of the firmware (ARMv7-M, B1.5.14), as the user of the board wants to see it.
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace dsdpv1::arm {

/// Everything a debugger shows. `pc` is without Thumb bit.
struct Registers {
  std::array<std::uint32_t, 13> r;
  std::uint32_t sp, lr, pc, xpsr;
  std::uint32_t msp, psp;
  std::uint32_t primask, basepri, faultmask, control;
};

enum class FaultKind {
  kUndefinedInstruction,
  kNoCoprocessor,
  kInvalidState,     ///< an instruction was to be executed with EPSR.T 0: branch to an even address
  kFetch,            ///< execution outside of flash and RAM; `address` is that of the instruction
  kData,             ///< load or store where nothing answers, or to flash
  kStacking,         ///< the stack pointer was outside of RAM at exception entry
  kUnstacking,       ///< the same at exception return
  kExceptionReturn,  ///< EXC_RETURN or the stacked XPSR does not fit
  kBreakpoint,       ///< BKPT
  kSupervisorCall,   ///< SVC where SVCall cannot be taken
  kUnaligned,        ///< LDM, STM, LDRD, STRD, LDREX, STREX at an address that is not a multiple of their size
};

/// The consequence.
enum class FaultOutcome {
  kHandled,    ///< the firmware's handler of exception `handler` begins
  kNoHandler,  ///< the vector of `handler` leads to no code in flash or RAM: the run ends
  kLockup,     ///< inside of HardFault or NMI, or with FAULTMASK set: the run ends
};

struct Fault {
  FaultKind kind;
  std::uint32_t pc;       ///< of the instruction at fault
  std::uint32_t address;  ///< of the access; kFetch: pc; otherwise 0
  Registers registers;    ///< when it happened, before the handler's entry
  unsigned handler;       ///< exception number
  FaultOutcome outcome;
  std::string text;  ///< one line: what, where, what became of it
};

/// Leaves CortexM3::run() when a fault ends the run.
class FaultError : public std::runtime_error {
 public:
  explicit FaultError(Fault fault) : std::runtime_error(fault.text), fault_(std::move(fault)) {}
  const Fault& fault() const { return fault_; }

 private:
  Fault fault_;
};

/// One line in words, `fault.text` apart.
std::string describe(const Fault& fault);
/// The registers in rows of four, for the end of a run.
std::string table(const Registers& registers);

}  // namespace dsdpv1::arm
