#pragma once
// Notes each change that a debugger makes to a processor, and repeats those of an earlier one.
#include <functional>
#include <memory>

#include "board/cpu/debug_target.hpp"
#include "tb/chip/user_cpu/debug_history.hpp"

namespace dsdpv1::arm {

/// The processor of a board as its debugger has it: each change is noted.
class NotedTarget final : public DebugTarget {
 public:
  NotedTarget(DebugTarget& target, user_cpu::DebugHistory& history, std::uint64_t board)
      : target_(target), history_(history), board_(board) {}

  std::uint32_t read_register(Register which) const override { return target_.read_register(which); }
  void write_register(Register which, std::uint32_t value) override;
  std::vector<MemoryRegion> memory_map() const override { return target_.memory_map(); }
  std::size_t read_memory(std::uint32_t address, std::uint8_t* to, std::size_t count) const override {
    return target_.read_memory(address, to, count);
  }
  bool write_memory(std::uint32_t address, const std::uint8_t* from, std::size_t count) override;
  bool report_data_accesses(bool on) override { return target_.report_data_accesses(on); }
  bool reset() override;
  bus::Tick now() const override { return target_.now(); }
  std::uint64_t instructions() const override { return target_.instructions(); }
  bool asleep() const override { return target_.asleep(); }
  void end_run() override { target_.end_run(); }

 private:
  void note(user_cpu::DebuggerInput::Kind kind, std::uint32_t where, std::vector<std::uint8_t> bytes);

  DebugTarget& target_;
  user_cpu::DebugHistory& history_;
  std::uint64_t board_;
};

/// Plays what is noted of a board; then, not before DebugHistory::live_from, it is the debugger of this run. On a
/// journey of its board that one is there from the beginning, to see where it ends.
class HistoryPlayer final : public Debugger {
 public:
  using MakeDebugger = std::function<std::unique_ptr<Debugger>(DebugTarget&, std::uint64_t board)>;

  /// `make`: null without a debugger. `target` and `history` must outlive it.
  HistoryPlayer(DebugTarget& target, user_cpu::DebugHistory& history, const MakeDebugger& make);

  bool wanted() const override;
  void before_instruction(std::uint32_t pc) override;
  void data_access(std::uint32_t address, std::uint32_t size, bool write) override {
    if (live_) live_->data_access(address, size, write);
  }
  void poll() override;
  void fault(const std::string& what) override {
    if (live_) live_->fault(what);
  }

 private:
  /// The processor asks wanted() every 250 ns, which are far fewer instructions.
  static constexpr std::uint64_t kAhead = 1024;

  std::unique_ptr<Debugger> debugger_of(const MakeDebugger& make);
  bool play();
  bool travels() const { return history_.journey && history_.journey->board == board_; }
  template <class Call>
  void pass_on(Call call);
  bool is_due(const user_cpu::DebuggerInput& input) const;
  void carry_out(const user_cpu::DebuggerInput& input);
  bool has_more() const;

  DebugTarget& target_;
  user_cpu::DebugHistory& history_;
  std::uint64_t board_;
  std::size_t next_ = 0, end_;  ///< of what was noted before this run
  NotedTarget noted_;
  std::unique_ptr<Debugger> debugger_;
  Debugger* live_ = nullptr;  ///< debugger_, once it has a say
};

}  // namespace dsdpv1::arm
