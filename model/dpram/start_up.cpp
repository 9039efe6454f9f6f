// The start-up access (rulings H6, D1): clears the RAM, then writes the version and the access count.
#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {
namespace {

constexpr std::uint8_t kVersion[] = {regs::kVersionReset, regs::kVersionYearReset, regs::kVersionMonthReset,
                                     regs::kVersionDayReset};

}  // namespace

void Sequencer::start_up(Cycle now) {
  origin_ = due_ = now;
  phase_ = Phase::kDue;
}

void Sequencer::move_start_up(Cycle now) {
  const int move = index_++;
  if (move < regs::kDpramSize) {
    put(static_cast<regs::Address>(move), 0);
  } else if (move < regs::kDpramSize + kVersionBytes) {
    const int i = move - regs::kDpramSize;
    put(static_cast<regs::Address>(regs::kVersion + i), kVersion[i]);
  } else if (move < kStartUpMoves) {
    put(regs::kAccessCount, kChipWasHere);
  } else {
    end(now);
  }
}

}  // namespace dsdpv1::dpram
