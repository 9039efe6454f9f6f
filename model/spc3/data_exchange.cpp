// Data_Exchange, Read_Inputs, Read_Outputs (M 5.2.5, 5.2.7, 5.2.8; A46, A48) and the user's commands for them.
#include "model/spc3/ram_store.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

constexpr Address pointer_of(Address first, int buffer) { return static_cast<Address>(first + buffer - 1); }

}  // namespace

profibus::Exchanged RamStore::exchange(Cycle now, const Request& request, bool fail_safe) {
  const int outputs = length(regs::kOrgDoutLength);
  const bool clears = request.size == 0 && modes_.has0(regs::kMode0SpecClear);
  if (request.size != outputs && !clears) return {false, outputs, false, {}};
  if (!has_io_buffers(now)) return {true, outputs, false, {nullptr, View::kNoBuffer}};
  ++data_exchanges_;
  if (!clears || outputs == 0) {
    put_outputs(now, request);
  } else if (config_.empty_data == 0 || fail_safe) {
    log_.at_cycle(now, Reason::kSpecClear, request.sa);
    clear_outputs(now);
  }
  return {true, outputs, diag_.flag(), read_inputs(now), user_is_gone(now)};
}

// A4: the pointers of the buffers that this telegram needs.
bool RamStore::has_io_buffers(Cycle now) const {
  const BufferStates& in = din_.states();
  const Address out_pointer = pointer_of(regs::kOrgDoutPointer, dout_.states().d);
  const Address in_pointer = pointer_of(regs::kOrgDinPointer, in.n != 0 && !freeze_ ? in.n : in.d);
  for (const auto& [size, pointer] :
       {std::pair(regs::kOrgDoutLength, out_pointer), {regs::kOrgDinLength, in_pointer}}) {
    if (ram_.cell(size) == 0 || ram_.cell(pointer) != 0) continue;
    log_.at_cycle(now, Reason::kNoPointer, pointer);
    return false;
  }
  return true;
}

// --- outputs ---------------------------------------------------------------------------------------------------------

void RamStore::put_outputs(Cycle now, const Request& request) {
  if (request.size == 0) return tell_no_outputs(now);
  const int begin = ram_.buffer(pointer_of(regs::kOrgDoutPointer, dout_.states().d));
  for (int i = 0; i < request.size; ++i) ram_.write(begin + i, request.data[i]);
  filled_ = true;
  if (!sync_) pass_outputs(now);
}

// A48.
void RamStore::tell_no_outputs(Cycle now) {
  if (variant_.has_more_modes && modes_.has2(regs::kMode2DxOutAlways)) effect(now, regs::kEventDxOut);
}

// D becomes N, if it has outputs (A56).
void RamStore::pass_outputs(Cycle now) {
  if (!std::exchange(filled_, false)) return;
  delivers_ = true;
  effect(now, regs::kEventDxOut);
}

void RamStore::clear_outputs(Cycle now) {
  filled_ = false;
  if (length(regs::kOrgDoutLength) == 0) return tell_no_outputs(now);
  clears_ = true;
  effect(now, regs::kEventDxOut);
}

void RamStore::deliver_outputs(bool cleared) {
  const Address pointer = pointer_of(regs::kOrgDoutPointer, dout_.states().d);
  const int begin = ram_.buffer(pointer), size = cleared && ram_.cell(pointer) != 0 ? length(regs::kOrgDoutLength) : 0;
  for (int i = 0; i < size; ++i) ram_.write(begin + i, 0);
  if (dout_.states().n != 0) ++outputs_missed_;
  dout_.deliver(cleared);
}

View RamStore::read_outputs(Cycle now) {
  return bytes(now, pointer_of(regs::kOrgDoutPointer, dout_.states().u), length(regs::kOrgDoutLength));
}

// --- inputs ----------------------------------------------------------------------------------------------------------

View RamStore::read_inputs(Cycle now) {
  if (!freeze_) din_.take();
  return bytes(now, pointer_of(regs::kOrgDinPointer, din_.states().d), length(regs::kOrgDinLength));
}

std::uint8_t RamStore::new_din(Cycle now) {
  const std::uint8_t users = din_.give();
  begin_exchange(now);
  return users;
}

// --- the user's watchdog ---------------------------------------------------------------------------------------------

bool RamStore::user_is_gone(Cycle now) {
  if (modes_.has1(regs::kMode1ResUserWd)) {
    modes_.clear1(regs::kMode1ResUserWd);
    user_watchdog_.restart(ram_.word(regs::kOrgUserWd));
    return false;
  }
  if (!user_watchdog_.count()) return false;
  log_.at_cycle(now, Reason::kUserWatchdog, ram_.word(regs::kOrgUserWd));
  return true;
}

}  // namespace dsdpv1::spc3
