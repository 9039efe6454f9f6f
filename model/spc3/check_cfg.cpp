// Check_Cfg and Get_Cfg (M 5.2.3, 5.2.9; A24 to A26).
#include "model/spc3/ram_store.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {

profibus::Take RamStore::configuration(Cycle now, const Request& request, bool /*exchanging*/) {
  if (!blocks_.has_room(now, Block::kCfg, request.size)) return profibus::Take::kNoRoom;
  cfg_held_ = false;
  blocks_.receive(now, Block::kCfg, request);
  effect(now);
  return profibus::Take::kAwaited;
}

profibus::IoLengths RamStore::configured() { return {length(regs::kOrgDinLength), length(regs::kOrgDoutLength)}; }

View RamStore::read_cfg(Cycle now, bool /*exchanging*/) {
  return bytes(now, regs::kOrgReadCfgPointer, length(regs::kOrgReadCfgLength));
}

// --- the user's verdict ----------------------------------------------------------------------------------------------

std::uint8_t RamStore::cfg_verdict(Cycle now, bool good) {
  const std::uint8_t answer = take_back(now, Block::kCfg, regs::kEventNewCfg);
  if (answer != regs::kVerdictFinished) return answer;
  if (!good) {
    station_.cfg_verdict(now, false);
    return answer;
  }
  if (modes_.has1(regs::kMode1EnChangeCfg)) ram_.swap_cells(regs::kOrgCfgPointer, regs::kOrgReadCfgPointer);  // A26
  cfg_held_ = true;
  station_.cfg_is_right();
  begin_exchange(now);
  if (cfg_held_) log_.at_cycle(now, Reason::kExchangeWaits, blocks_.pending(Block::kPrm), !has_inputs());
  return answer;
}

bool RamStore::has_inputs() const {
  const bool at_once = config_.data_ex == 0 ? variant_.exchanges_at_cfg_ok : config_.data_ex == 2;
  return at_once || ram_.cell(regs::kOrgDinLength) == 0 || din_.has_new();
}

// A24, after each command that may make it so.
void RamStore::begin_exchange(Cycle now) {
  const bool exchanges = station_.slave().state() == DpState::kDataExch;
  const bool ready = !blocks_.pending(Block::kPrm) && has_inputs();
  if (!cfg_held_ || (!exchanges && !ready)) return;
  cfg_held_ = false;
  station_.cfg_verdict(now, true);
}

}  // namespace dsdpv1::spc3
