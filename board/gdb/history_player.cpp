#include "board/gdb/history_player.hpp"

#include <utility>

namespace dsdpv1::arm {
namespace {

using user_cpu::DebuggerInput;

std::vector<std::uint8_t> bytes_of(std::uint32_t value) {
  std::vector<std::uint8_t> bytes;
  for (unsigned i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  return bytes;
}

std::uint32_t value_of(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

}  // namespace

void NotedTarget::note(DebuggerInput::Kind kind, std::uint32_t where, std::vector<std::uint8_t> bytes) {
  history_.inputs.push_back({board_, target_.instructions(), target_.now(), kind, where, std::move(bytes)});
}

void NotedTarget::write_register(Register which, std::uint32_t value) {
  note(DebuggerInput::Kind::kRegister, static_cast<std::uint32_t>(which), bytes_of(value));
  target_.write_register(which, value);
}

bool NotedTarget::write_memory(std::uint32_t address, const std::uint8_t* from, std::size_t count) {
  if (!target_.write_memory(address, from, count)) return false;
  note(DebuggerInput::Kind::kMemory, address, {from, from + count});
  return true;
}

bool NotedTarget::reset() {
  if (!target_.reset()) return false;
  note(DebuggerInput::Kind::kReset, 0, {});
  return true;
}

HistoryPlayer::HistoryPlayer(DebugTarget& target, user_cpu::DebugHistory& history, const MakeDebugger& make)
    : target_(target),
      history_(history),
      board_(history.boards++),
      end_(history.inputs.size()),
      noted_(target, history, board_),
      debugger_(debugger_of(make)) {
  while (next_ < end_ && history_.inputs[next_].board < board_) ++next_;
}

/// The debugger that travels keeps its connection: the port is taken.
std::unique_ptr<Debugger> HistoryPlayer::debugger_of(const MakeDebugger& make) {
  const bool wanted = make && (!history_.journey || travels());
  return wanted ? make(noted_, board_) : nullptr;
}

bool HistoryPlayer::has_more() const { return next_ < end_ && history_.inputs[next_].board == board_; }

/// Halted, the processor is at the same instruction and time as it was then.
bool HistoryPlayer::is_due(const DebuggerInput& input) const {
  return target_.instructions() >= input.instructions && target_.now() >= input.at;
}

bool HistoryPlayer::wanted() const {
  if (has_more() && target_.instructions() + kAhead >= history_.inputs[next_].instructions) return true;
  if (live_ != nullptr || travels()) return debugger_->wanted();
  return !has_more() && debugger_ && target_.now() >= history_.live_from;
}

void HistoryPlayer::before_instruction(std::uint32_t pc) {
  pass_on([pc](Debugger& debugger) { debugger.before_instruction(pc); });
}

void HistoryPlayer::poll() {
  pass_on([](Debugger& debugger) { debugger.poll(); });
}

/// At the end of a journey what was done after it is undone.
template <class Call>
void HistoryPlayer::pass_on(Call call) {
  if (!play()) return;
  const bool travelled = travels();
  call(*live_);
  if (!travelled || travels() || history_.back) return;
  const auto first = history_.inputs.begin();
  history_.inputs.erase(first + static_cast<std::ptrdiff_t>(next_), first + static_cast<std::ptrdiff_t>(end_));
  end_ = next_;
}

/// Returns whether the debugger may act.
bool HistoryPlayer::play() {
  while (has_more() && is_due(history_.inputs[next_])) {
    const DebuggerInput& input = history_.inputs[next_++];
    carry_out(input);
    if (input.kind == DebuggerInput::Kind::kReset) return false;  // the processor calls again at the reset handler
  }
  const bool has_a_say = travels() || (!has_more() && target_.now() >= history_.live_from);
  if (has_a_say) live_ = debugger_.get();
  return live_ != nullptr;
}

void HistoryPlayer::carry_out(const DebuggerInput& input) {
  switch (input.kind) {
    case DebuggerInput::Kind::kRegister:
      target_.write_register(static_cast<Register>(input.where), value_of(input.bytes));
      break;
    case DebuggerInput::Kind::kMemory: target_.write_memory(input.where, input.bytes.data(), input.bytes.size()); break;
    case DebuggerInput::Kind::kReset: target_.reset(); break;
  }
}

}  // namespace dsdpv1::arm
