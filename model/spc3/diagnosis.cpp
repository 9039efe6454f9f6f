// Slave_Diag (M 5.2.4; A19, A39, A51) and New_Diag.
#include <algorithm>

#include "model/spc3/ram_store.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

constexpr int kStandard = 6;
constexpr Address cell_of(Address first, int buffer) { return static_cast<Address>(first + buffer - 1); }

}  // namespace

profibus::StoredDiagnosis RamStore::diagnosis(Cycle now, bool to_holder) {
  const Address pointer = cell_of(regs::kOrgDiagPointer, diag_.chips());
  const int size = std::max(length(cell_of(regs::kOrgDiagLength, diag_.chips())), kStandard);
  profibus::StoredDiagnosis stored;
  stored.user = bytes(now, pointer, size - kStandard, kStandard);
  if (stored.user.size == View::kNoBuffer) return stored;
  stored.ext_diag = diag_.ext_diag();
  stored.stat_diag = diag_.stat_diag();
  stored.overflow = diag_.overflow();
  stored.freeze = freeze_;
  stored.sync = sync_;
  if (config_.diag_bytes == 0) stored.standard = ram_.segment(ram_.buffer(pointer));
  diag_.send(to_holder || config_.diag_flag_by != 0);
  return stored;
}

std::uint8_t RamStore::new_diag(Cycle now) {
  if (!diag_.request()) {
    log_.at_cycle(now, Reason::kDiagBusy);
    return 0;
  }
  exchange_diag();
  return diag_.user();
}

void RamStore::exchange_diag() {
  const Address pointer = cell_of(regs::kOrgDiagPointer, diag_.user());
  diag_.exchange(ram_.cell(pointer) != 0 ? ram_.read(ram_.buffer(pointer)) : std::uint8_t{0});
  interrupt_.raise(regs::kEventDiagChanged);
}

}  // namespace dsdpv1::spc3
