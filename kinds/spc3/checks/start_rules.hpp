#pragma once
// The state of registers, organisation and buffers at START.
#include "kinds/spc3/checks/check.hpp"
#include "kinds/spc3/checks/seen_chip.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::spc3_checks {

/// Before the chip has taken the START of `at`.
void judge_start(checks::Recorder& recorder, Tick at, const SeenChip& chip);

}  // namespace dsdpv1::spc3_checks
