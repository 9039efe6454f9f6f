// Set_Slave_Address (M 5.2.1; A23).
#include "model/spc3/ram_store.hpp"

namespace dsdpv1::spc3 {

profibus::Take RamStore::address(Cycle now, const Request& request, bool right) {
  if (!blocks_.has_room(now, Block::kSsa, request.size)) return profibus::Take::kNoRoom;
  if (!right) return profibus::Take::kRefused;
  if (config_.ssa_cells != 0) {
    ram_.set_cell(regs::kOrgAddress, request.data[0]);
    ram_.set_cell(regs::kOrgNoAddressChange, request.data[3] != 0 ? 0xFF : 0x00);
  }
  blocks_.receive(now, Block::kSsa, request);
  effect(now);
  return profibus::Take::kAccepted;
}

}  // namespace dsdpv1::spc3
