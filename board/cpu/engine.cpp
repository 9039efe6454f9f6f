#include "board/cpu/engine.hpp"

#include <unicorn/unicorn.h>

#include <stdexcept>
#include <string>

namespace dsdpv1::arm {

namespace {

// No instruction can stand here, so Unicorn never ends by itself.
constexpr std::uint64_t kNoEnd = 0xFFFFFFFE;
constexpr std::uint32_t kThumbState = 1U << 24;

// Numbers that Unicorn hands to UC_HOOK_INTR: the exceptions of QEMU's ARM target.
enum QemuException : std::uint32_t {
  kSwi = 2,
  kPrefetchAbort = 3,
  kBkpt = 7,
  kExceptionExit = 8,
  kNocp = 17,
  kInvstate = 18
};

int unicorn_register(Register which) {
  switch (which) {
    case Register::kSp: return UC_ARM_REG_SP;
    case Register::kLr: return UC_ARM_REG_LR;
    case Register::kPc: return UC_ARM_REG_PC;
    case Register::kXpsr: return UC_ARM_REG_XPSR;
    case Register::kMsp: return UC_ARM_REG_MSP;
    case Register::kPsp: return UC_ARM_REG_PSP;
    case Register::kPrimask: return UC_ARM_REG_PRIMASK;
    case Register::kBasepri: return UC_ARM_REG_BASEPRI;
    case Register::kFaultmask: return UC_ARM_REG_FAULTMASK;
    case Register::kControl: return UC_ARM_REG_CONTROL;
    default: return UC_ARM_REG_R0 + static_cast<int>(which);
  }
}

Trap trap_of(std::uint32_t number) {
  switch (number) {
    case kSwi: return Trap::kSvc;
    case kPrefetchAbort: return Trap::kPrefetchAbort;
    case kBkpt: return Trap::kBreakpoint;
    case kExceptionExit: return Trap::kExceptionReturn;
    case kNocp: return Trap::kNoCoprocessor;
    case kInvstate: return Trap::kInvalidState;
    default: return Trap::kUndefined;
  }
}

}  // namespace

struct Engine::Window {
  Engine& engine;
  std::uint32_t start;
};

// What Unicorn calls.
struct Engine::Hooks {
  static void instruction(uc_engine*, std::uint64_t address, std::uint32_t, void* self) {
    static_cast<Engine*>(self)->events_.on_instruction(static_cast<std::uint32_t>(address));
  }
  static void interrupt(uc_engine*, std::uint32_t number, void* self) {
    auto& engine = *static_cast<Engine*>(self);
    engine.trap_ = trap_of(number);
    engine.stop();
  }
  static bool bad_access(uc_engine*, uc_mem_type type, std::uint64_t address, int, std::int64_t, void* self) {
    auto& engine = *static_cast<Engine*>(self);
    engine.trap_ = Trap::kBadAccess;
    engine.events_.on_bad_access(static_cast<std::uint32_t>(address),
                                 type == UC_MEM_FETCH_UNMAPPED || type == UC_MEM_FETCH_PROT);
    return false;
  }
  static void data(uc_engine*, uc_mem_type type, std::uint64_t address, int size, std::int64_t, void* self) {
    static_cast<Engine*>(self)->events_.on_data(static_cast<std::uint32_t>(address), static_cast<unsigned>(size),
                                                type == UC_MEM_WRITE);
  }
  static std::uint64_t load(uc_engine*, std::uint64_t offset, unsigned size, void* window) {
    const auto& w = *static_cast<Window*>(window);
    return w.engine.events_.on_load(w.start + static_cast<std::uint32_t>(offset), size);
  }
  static void store(uc_engine*, std::uint64_t offset, unsigned size, std::uint64_t value, void* window) {
    const auto& w = *static_cast<Window*>(window);
    w.engine.events_.on_store(w.start + static_cast<std::uint32_t>(offset), size, static_cast<std::uint32_t>(value));
  }
};

// Unicorn shows special registers to privileged code only and takes its user for the code at work: for a moment this is
// a handler.
class Engine::Privileged {
 public:
  Privileged(uc_engine* uc, Register which) : uc_(uc) {
    if (which < Register::kMsp || which == Register::kControl) return;
    std::uint32_t control = 0;
    uc_reg_read(uc_, UC_ARM_REG_CONTROL, &control);
    uc_reg_read(uc_, UC_ARM_REG_XPSR, &xpsr_);
    lifted_ = (control & 1U) != 0 && (xpsr_ & 0x1FFU) == 0;
    if (lifted_) {
      const std::uint32_t handler = xpsr_ | 3U;
      uc_reg_write(uc_, UC_ARM_REG_XPSR, &handler);
    }
  }
  ~Privileged() {
    if (lifted_) uc_reg_write(uc_, UC_ARM_REG_XPSR, &xpsr_);
  }
  Privileged(const Privileged&) = delete;
  Privileged& operator=(const Privileged&) = delete;

 private:
  uc_engine* uc_;
  std::uint32_t xpsr_ = 0;
  bool lifted_ = false;
};

Engine::Engine(EngineEvents& events) : events_(events) {
  check(uc_open(UC_ARCH_ARM, static_cast<uc_mode>(UC_MODE_THUMB | UC_MODE_MCLASS), &uc_), "uc_open");
  check(uc_ctl(uc_, UC_CTL_WRITE(UC_CTL_CPU_MODEL, 1), UC_CPU_ARM_CORTEX_M3), "uc_ctl_set_cpu_model");
  hook(UC_HOOK_CODE, reinterpret_cast<void*>(&Hooks::instruction));
  hook(UC_HOOK_INTR, reinterpret_cast<void*>(&Hooks::interrupt));
  hook(UC_HOOK_MEM_INVALID, reinterpret_cast<void*>(&Hooks::bad_access));
}

Engine::~Engine() { uc_close(uc_); }

void Engine::check(int error, const char* what) const {
  if (error != UC_ERR_OK)
    throw std::runtime_error(std::string("Unicorn: ") + what + ": " + uc_strerror(static_cast<uc_err>(error)));
}

void Engine::hook(int type, void* function) {
  uc_hook handle = 0;
  check(uc_hook_add(uc_, &handle, type, function, this, 1, 0), "uc_hook_add");
}

void Engine::map(std::uint32_t address, std::size_t size, std::uint8_t* memory, bool writable) {
  const std::uint32_t rights = UC_PROT_READ | UC_PROT_EXEC | (writable ? UC_PROT_WRITE : 0);
  check(uc_mem_map_ptr(uc_, address, size, rights, memory), "uc_mem_map_ptr");
  code_.push_back({address, size});
}

void Engine::map_events(std::uint32_t address, std::size_t size) {
  windows_.push_back(std::make_unique<Window>(Window{*this, address}));
  void* window = windows_.back().get();
  check(uc_mmio_map(uc_, address, size, &Hooks::load, window, &Hooks::store, window), "uc_mmio_map");
}

// Region by region: uc_ctl_flush_tlb writes all of Unicorn's buffer of 1 GB, which takes seconds.
void Engine::forget_translations() {
  for (const Code& region : code_) {
    check(uc_ctl(uc_, UC_CTL_WRITE(UC_CTL_TB_REMOVE_CACHE, 2), std::uint64_t{region.start},
                 std::uint64_t{region.start} + region.size),
          "uc_ctl_remove_cache");
  }
}

void Engine::report_data(bool on) {
  if (on == reports_data_) return;
  if (on) {
    check(uc_hook_add(uc_, &data_hook_, UC_HOOK_MEM_READ | UC_HOOK_MEM_WRITE, reinterpret_cast<void*>(&Hooks::data),
                      this, 1, 0),
          "uc_hook_add");
  } else {
    check(uc_hook_del(uc_, data_hook_), "uc_hook_del");
  }
  reports_data_ = on;
}

std::uint32_t Engine::read(Register which) const {
  const Privileged privileged(uc_, which);
  std::uint32_t value = 0;
  uc_reg_read(uc_, unicorn_register(which), &value);
  return value;
}

void Engine::write(Register which, std::uint32_t value) {
  const Privileged privileged(uc_, which);
  uc_reg_write(uc_, unicorn_register(which), &value);
}

Trap Engine::run() {
  trap_ = Trap::kNone;
  const uc_err error = uc_emu_start(uc_, read(Register::kPc) | 1U, kNoEnd, 0, 0);
  if (error == UC_ERR_INSN_INVALID)
    return (read(Register::kXpsr) & kThumbState) != 0 ? Trap::kUndefined : Trap::kInvalidState;
  if (trap_ == Trap::kNone) check(error, "uc_emu_start");
  return trap_;
}

void Engine::stop() { uc_emu_stop(uc_); }

}  // namespace dsdpv1::arm
