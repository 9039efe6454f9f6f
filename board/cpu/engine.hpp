#pragma once
// Unicorn with a Cortex-M3 in it: the only place that knows its programming interface. What Unicorn leaves to its user
// - exceptions, the system control space, time - is CortexM3's.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "board/cpu/debug_target.hpp"

struct uc_struct;

namespace dsdpv1::arm {

/// What the engine calls while it runs. No exception may leave these functions: Unicorn's frames cannot be unwound.
class EngineEvents {
 public:
  virtual ~EngineEvents() = default;
  virtual void on_instruction(std::uint32_t address) noexcept = 0;
  virtual std::uint32_t on_load(std::uint32_t address, unsigned bytes) noexcept = 0;
  virtual void on_store(std::uint32_t address, unsigned bytes, std::uint32_t value) noexcept = 0;
  /// An access, or with `fetch` an execution, where no memory is or none that may be written. The engine stops.
  virtual void on_bad_access(std::uint32_t address, bool fetch) noexcept = 0;
  /// An access to mapped memory or outside, while report_data(true).
  virtual void on_data(std::uint32_t address, unsigned bytes, bool write) noexcept = 0;
};

/// Why Engine::run() returned.
enum class Trap {
  kNone,  ///< stop(), or WFI was executed
  kSvc,
  kBreakpoint,
  kExceptionReturn,
  kPrefetchAbort,
  kNoCoprocessor,
  kInvalidState,  ///< an instruction was to be executed with EPSR.T 0
  kUndefined,     ///< also WFE, which Unicorn does not know
  kBadAccess,     ///< after on_bad_access()
};

/// Not copied, not moved: Unicorn holds pointers to it.
class Engine {
 public:
  /// Throws std::runtime_error when the library refuses (another version, another build).
  explicit Engine(EngineEvents& events);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// `size` a multiple of 4096; `memory` stays the caller's and is shared with it.
  void map(std::uint32_t address, std::size_t size, std::uint8_t* memory, bool writable);
  /// Loads and stores there go to on_load and on_store; nothing can be executed.
  void map_events(std::uint32_t address, std::size_t size);
  /// The caller wrote code into mapped memory; not while running.
  void forget_translations();
  /// From now on data accesses call on_data too; slow; not while running. forget_translations() has to follow.
  void report_data(bool on);

  /// Whatever mode the processor is in.
  std::uint32_t read(Register which) const;
  /// kControl as an instruction in the present mode may write it, the others in any mode.
  void write(Register which, std::uint32_t value);

  /// Executes from kPc on until stop() or a trap.
  Trap run();
  /// From inside of on_instruction: the instruction is not executed, unless it stands in an IT block.
  void stop();

 private:
  struct Window;
  struct Hooks;
  class Privileged;
  struct Code {
    std::uint32_t start;
    std::size_t size;
  };
  void check(int error, const char* what) const;
  void hook(int type, void* function);
  EngineEvents& events_;
  uc_struct* uc_ = nullptr;
  std::vector<std::unique_ptr<Window>> windows_;
  std::vector<Code> code_;
  Trap trap_ = Trap::kNone;
  std::size_t data_hook_ = 0;
  bool reports_data_ = false;
};

}  // namespace dsdpv1::arm
