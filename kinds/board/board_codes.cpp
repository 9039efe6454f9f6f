#include "kinds/board/board_codes.hpp"

#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb {

CodeTable board_codes() {
  CodeTable table = {
      "The ARM board",
      "See [arm_board.md](arm_board.md#what-a-real-board-would-not-forgive). Numbers are sections of RM0008, rev. 21.",
      {{scenario::kFirmwareFault, "violation", "ARM board",
        "the firmware of an ARM board has met a fault; the run ends",
        "See the source line and the registers below the table, or run it again with --gdb."}}};
  for (const BoardCode& each : kBoardCodes)
    table.codes.push_back({each.code, "violation", "ARM board", each.text, each.advice});
  return table;
}

}  // namespace dsdpv1::tb
