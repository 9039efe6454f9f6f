#include "board/cpu/nvic.hpp"

#include <algorithm>

namespace dsdpv1::arm {

namespace {

// Blocks of registers, offsets from 0xE000E000 (B3.4.3). Each has room for 496 interrupts.
constexpr std::uint32_t kEnable = 0x100, kDisable = 0x180, kPend = 0x200, kUnpend = 0x280, kActive = 0x300;
constexpr std::uint32_t kPriorities = 0x400, kPrioritiesEnd = 0x4F0, kBlock = 0x80;

// First exception of the 32 whose bits stand in the register.
unsigned first_of(std::uint32_t offset) { return kFirstInterrupt + (offset % kBlock) / 4 * 32; }

}  // namespace

void Nvic::reset() {
  state_.fill(State{});
  for (unsigned exception = 0; exception < kFirstInterrupt; ++exception) state_[exception].enabled = true;
  grouping_ = 0;
  update_active();
  update_foremost();
}

void Nvic::set_pending(unsigned exception) {
  state_[exception].pending = true;
  update_foremost();
}

void Nvic::clear_pending(unsigned exception) {
  State& state = state_[exception];
  state.pending = state.level && !state.active;
  update_foremost();
}

void Nvic::set_level(unsigned exception, bool high) {
  State& state = state_[exception];
  state.level = high;
  if (!high) state.unserved = 0;
  if (high && !state.active) set_pending(exception);
}

void Nvic::begin(unsigned exception) {
  state_[exception].pending = false;
  state_[exception].active = true;
  update_active();
  update_foremost();
}

void Nvic::end(unsigned exception) {
  State& state = state_[exception];
  state.active = false;
  state.pending = state.pending || state.level;
  if (state.level) ++state.unserved;
  update_active();
  update_foremost();
}

void Nvic::set_priority(unsigned exception, std::uint8_t priority) {
  state_[exception].priority = priority & kPriorityBits;
  update_active();
  update_foremost();
}

void Nvic::set_grouping(unsigned prigroup) {
  grouping_ = prigroup & 7U;
  update_active();
  update_foremost();
}

int Nvic::full_priority(unsigned exception) const {
  switch (exception) {
    case kReset: return -3;
    case kNmi: return -2;
    case kHardFault: return -1;
    default: return state_[exception].priority;
  }
}

int Nvic::group_priority(unsigned exception) const {
  const int priority = full_priority(exception);
  return priority < 0 ? priority : priority & ~((2 << grouping_) - 1);
}

int Nvic::execution_priority(const Masks& masks) const {
  int priority = active_priority_;
  if (masks.basepri != 0) priority = std::min(priority, masks.basepri & ~((2 << grouping_) - 1));
  if (masks.primask) priority = std::min(priority, 0);
  if (masks.faultmask) priority = std::min(priority, -1);
  return priority;
}

unsigned Nvic::preempting(int execution_priority) const {
  return foremost_ != kNoException && group_priority(foremost_) < execution_priority ? foremost_ : kNoException;
}

bool Nvic::goes_before(unsigned one, unsigned other) const {
  return full_priority(one) < full_priority(other);  // of equals the lower number stays first (B1.5.4)
}

void Nvic::update_active() {
  active_count_ = 0;
  active_priority_ = kIdlePriority;
  for (unsigned exception = kNmi; exception < kExceptions; ++exception) {
    if (state_[exception].active) {
      ++active_count_;
      active_priority_ = std::min(active_priority_, group_priority(exception));
    }
  }
}

void Nvic::update_foremost() {
  foremost_ = kNoException;
  for (unsigned exception = kNmi; exception < kExceptions; ++exception) {
    const State& state = state_[exception];
    if (state.pending && state.enabled && (foremost_ == kNoException || goes_before(exception, foremost_)))
      foremost_ = exception;
  }
}

template <typename Test>
std::uint32_t Nvic::collect(unsigned first, Test test) const {
  std::uint32_t bits = 0;
  for (unsigned exception = first; exception < std::min(first + 32, kExceptions); ++exception)
    bits |= (test(state_[exception]) ? 1U : 0U) << (exception - first);
  return bits;
}

template <typename Action>
void Nvic::for_each_bit(unsigned first, std::uint32_t bits, Action action) {
  for (unsigned exception = first; exception < std::min(first + 32, kExceptions); ++exception)
    if ((bits >> (exception - first) & 1U) != 0) action(exception);
}

std::uint32_t Nvic::load(std::uint32_t offset) const {
  if (offset >= kPriorities)
    return offset < kPrioritiesEnd ? load_priorities(kFirstInterrupt + offset - kPriorities) : 0;
  switch (offset & ~(kBlock - 1)) {
    case kEnable:
    case kDisable: return collect(first_of(offset), [](const State& state) { return state.enabled; });
    case kPend:
    case kUnpend: return collect(first_of(offset), [](const State& state) { return state.pending; });
    case kActive: return collect(first_of(offset), [](const State& state) { return state.active; });
    default: return 0;
  }
}

void Nvic::store(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  if (offset >= kPriorities) {
    if (offset < kPrioritiesEnd) store_priorities(kFirstInterrupt + offset - kPriorities, value, lanes);
    return;
  }
  const unsigned first = first_of(offset);
  const std::uint32_t bits = value & lanes;
  switch (offset & ~(kBlock - 1)) {
    case kEnable: for_each_bit(first, bits, [this](unsigned exception) { state_[exception].enabled = true; }); break;
    case kDisable: for_each_bit(first, bits, [this](unsigned exception) { state_[exception].enabled = false; }); break;
    case kPend: for_each_bit(first, bits, [this](unsigned exception) { set_pending(exception); }); break;
    case kUnpend: for_each_bit(first, bits, [this](unsigned exception) { clear_pending(exception); }); break;
    default: break;
  }
  update_foremost();
}

std::uint32_t Nvic::load_priorities(unsigned first) const {
  std::uint32_t value = 0;
  for (unsigned byte = 0; byte < 4 && first + byte < kExceptions; ++byte)
    value |= static_cast<std::uint32_t>(state_[first + byte].priority) << (8 * byte);
  return value;
}

void Nvic::store_priorities(unsigned first, std::uint32_t value, std::uint32_t lanes) {
  for (unsigned byte = 0; byte < 4 && first + byte < kExceptions; ++byte)
    if ((lanes >> (8 * byte) & 0xFFU) != 0) set_priority(first + byte, static_cast<std::uint8_t>(value >> (8 * byte)));
}

}  // namespace dsdpv1::arm
