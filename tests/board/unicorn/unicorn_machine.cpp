// Unicorn as a Machine. It is GPL-2.0-only as a whole, and so is any program with this file.
#include <unicorn/unicorn.h>

#include <cstring>
#include <stdexcept>

#include "tests/board/unicorn/machine.hpp"

namespace dsdpv1::arm::differential {
namespace {

// No instruction can be here, so Unicorn never stops on its own.
constexpr std::uint64_t kNoEnd = 0xFFFFFFFE;
constexpr std::uint32_t kThumbState = 1U << 24;

int unicorn_register(Register which) {
  static constexpr std::array<int, kRegisterCount - 13> kOthers = {
      UC_ARM_REG_SP,  UC_ARM_REG_LR,      UC_ARM_REG_PC,      UC_ARM_REG_XPSR,      UC_ARM_REG_MSP,
      UC_ARM_REG_PSP, UC_ARM_REG_PRIMASK, UC_ARM_REG_BASEPRI, UC_ARM_REG_FAULTMASK, UC_ARM_REG_CONTROL};
  const auto number = static_cast<std::size_t>(which);
  return which <= Register::kR12 ? UC_ARM_REG_R0 + static_cast<int>(number) : kOthers.at(number - 13);
}

/// Numbers passed to UC_HOOK_INTR: the exceptions of QEMU's ARM target.
Trap trap_of(std::uint32_t number) {
  switch (number) {
    case 2: return Trap::kSvc;
    case 3: return Trap::kBadFetch;
    case 7: return Trap::kBreakpoint;
    case 8: return Trap::kExceptionReturn;
    case 17: return Trap::kNoCoprocessor;
    case 18: return Trap::kInvalidState;
    default: return Trap::kUndefined;
  }
}

void check(uc_err error) {
  if (error != UC_ERR_OK) throw std::runtime_error(std::string("Unicorn: ") + uc_strerror(error));
}

class Unicorn : public Machine {
 public:
  Unicorn() {
    check(uc_open(UC_ARCH_ARM, static_cast<uc_mode>(UC_MODE_THUMB | UC_MODE_MCLASS), &uc_));
    check(uc_ctl(uc_, UC_CTL_WRITE(UC_CTL_CPU_MODEL, 1), UC_CPU_ARM_CORTEX_M3));
    check(uc_mem_map_ptr(uc_, kCode, kCodeBytes, UC_PROT_READ | UC_PROT_EXEC, code_));
    check(uc_mem_map_ptr(uc_, kRam, kRamBytes, UC_PROT_ALL, ram_.data()));
    check(uc_mmio_map(uc_, kBus, kBusBytes, &load_bus, this, &store_bus, this));
    hook(UC_HOOK_CODE, reinterpret_cast<void*>(&instruction));  // without it PC is not that of a failing access
    hook(UC_HOOK_INTR, reinterpret_cast<void*>(&interrupt));
    hook(UC_HOOK_MEM_INVALID, reinterpret_cast<void*>(&bad_access));
  }
  ~Unicorn() override { uc_close(uc_); }
  Unicorn(const Unicorn&) = delete;
  Unicorn& operator=(const Unicorn&) = delete;

  std::string name() const override { return "Unicorn"; }
  void load(const std::vector<std::uint8_t>& code) override {
    std::memcpy(code_, code.data(), code.size());
    check(
        uc_ctl(uc_, UC_CTL_WRITE(UC_CTL_TB_REMOVE_CACHE, 2), std::uint64_t{kCode}, std::uint64_t{kCode + kCodeBytes}));
  }
  /// Stack pointers and CONTROL can be written in privileged mode only, SPSEL in thread mode only.
  void set(const State& state) override {
    write(Register::kXpsr, kThumbState | 3U);
    write(Register::kControl, 0);
    write(Register::kXpsr, kThumbState);
    write(Register::kControl, 0);
    for (const Register which : {Register::kMsp, Register::kPsp, Register::kPrimask, Register::kBasepri,
                                 Register::kFaultmask, Register::kControl, Register::kXpsr, Register::kLr})
      write(which, state[which]);
    for (unsigned n = 0; n <= 12; ++n) write(static_cast<Register>(n), state.registers.at(n));
    pc_ = state[Register::kPc];
  }
  Trap run() override {
    bus_.clear();
    trap_ = Trap::kNone;
    const uc_err error = uc_emu_start(uc_, pc_ | 1U, kNoEnd, 0, 0);
    if (error == UC_ERR_INSN_INVALID)
      trap_ = (read(Register::kXpsr) & kThumbState) != 0 ? Trap::kUndefined : Trap::kInvalidState;
    else if (trap_ == Trap::kNone)
      check(error), trap_ = Trap::kWfi;
    pc_ = read(Register::kPc);
    return trap_;
  }
  State get() const override {
    State state;
    for (unsigned n = 0; n < kRegisterCount; ++n) state.registers.at(n) = read(static_cast<Register>(n));
    return state;
  }
  std::uint32_t bad_address() const override { return bad_address_; }

 private:
  static std::uint64_t load_bus(uc_engine*, std::uint64_t offset, unsigned size, void* self) {
    return static_cast<Unicorn*>(self)->bus_load(kBus + static_cast<std::uint32_t>(offset), size);
  }
  static void store_bus(uc_engine*, std::uint64_t offset, unsigned size, std::uint64_t value, void* self) {
    static_cast<Unicorn*>(self)->bus_store(kBus + static_cast<std::uint32_t>(offset), size,
                                           static_cast<std::uint32_t>(value));
  }
  static void instruction(uc_engine*, std::uint64_t, std::uint32_t, void*) {}
  static void interrupt(uc_engine* uc, std::uint32_t number, void* self) {
    static_cast<Unicorn*>(self)->trap_ = trap_of(number);
    uc_emu_stop(uc);
  }
  static bool bad_access(uc_engine*, uc_mem_type type, std::uint64_t address, int, std::int64_t, void* self) {
    auto& machine = *static_cast<Unicorn*>(self);
    const bool fetch = type == UC_MEM_FETCH_UNMAPPED || type == UC_MEM_FETCH_PROT;
    machine.trap_ = fetch ? Trap::kBadFetch : Trap::kBadAccess;
    machine.bad_address_ = static_cast<std::uint32_t>(address);
    return false;
  }
  void hook(int type, void* function) {
    uc_hook handle = 0;
    check(uc_hook_add(uc_, &handle, type, function, this, 1, 0));
  }
  std::uint32_t read(Register which) const {
    std::uint32_t value = 0;
    check(uc_reg_read(uc_, unicorn_register(which), &value));
    return value;
  }
  void write(Register which, std::uint32_t value) { check(uc_reg_write(uc_, unicorn_register(which), &value)); }

  uc_engine* uc_ = nullptr;
  alignas(4096) std::uint8_t code_[kCodeBytes] = {};
  Trap trap_ = Trap::kNone;
  std::uint32_t bad_address_ = 0, pc_ = 0;
};

}  // namespace

std::unique_ptr<Machine> make_unicorn() { return std::make_unique<Unicorn>(); }

}  // namespace dsdpv1::arm::differential
