// The state of an access for waves, in the words of ruling H4.
#include "model/dpram/inside.hpp"

#include <iterator>

#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {

const char* Sequencer::name(Phase phase, Item item) {
  static constexpr const char* kItems[] = {"initialisation",    "Set_Prm verdict", "Chk_Cfg verdict",
                                           "clear input error", "inputs",          "diagnosis",
                                           "C1 answer",         "C2 answer",       "Set_Prm",
                                           "Chk_Cfg",           "outputs",         "C1 request",
                                           "C2 request",        "valid flag",      "offline count",
                                           "offline count",     "status B00A",     "status B00B",
                                           "status B012",       "status B013",     "-"};
  static_assert(std::size(kItems) == static_cast<std::size_t>(Item::kNone) + 1);
  switch (phase) {
    case Phase::kOff:
    case Phase::kDue:
    case Phase::kIdle: return "-";
    case Phase::kStartUp: return "start-up";
    case Phase::kHeader: return "commands";
    case Phase::kChoose: return "choice";
    default: return kItems[static_cast<std::size_t>(item)];
  }
}

// Not inline, so that a move costs only one test more when notes are off.
void Sequencer::note(regs::Address address, std::uint8_t byte, bool writes) {
  moved_ = {op_ - 1, address, byte, writes, phase_, item_};
}

/// A status byte is written in the cycle of the choice, so the move tells what it was, not the phase after it.
Inside Sequencer::inside(Cycle now) const {
  Inside seen;
  seen.moves = moved_.at == now;
  seen.item = name(phase_, item_);
  if (seen.moves) {
    seen.address = moved_.address, seen.byte = moved_.byte, seen.writes = moved_.writes;
    const bool chosen = moved_.phase == Phase::kChoose;
    seen.item = name(chosen ? Phase::kWrite : moved_.phase, moved_.item);
  }
  seen.crc_of = name(Phase::kCommit, crc_item_);
  seen.crc_right = crc_right_;
  return seen;
}

}  // namespace dsdpv1::dpram
