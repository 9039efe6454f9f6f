// Global_Control (M 5.2.6; A29, A38, A47): what the gates of Sync and Freeze do to the buffers.
#include "model/spc3/ram_store.hpp"

namespace dsdpv1::spc3 {

using profibus::Gate;

void RamStore::control(Cycle now, const profibus::Control& control) {
  const bool each = variant_.reports_each_control && modes_.has2(regs::kMode2GcEach);
  const bool tells = each || control.command != ram_.cell(regs::kOrgGcCommand);
  has_control_ = true;
  control_ = control.command;
  if (control.clears) clear_outputs(now);
  if (control.outputs != Gate::kStays) {
    sync_ = control.outputs == Gate::kCloses;
    pass_outputs(now);
  }
  if (control.inputs == Gate::kCloses) din_.take();
  if (control.inputs != Gate::kStays) freeze_ = control.inputs == Gate::kCloses;
  effect(now, tells ? regs::kEventNewGc : std::uint16_t{0});
}

}  // namespace dsdpv1::spc3
