#include "kinds/spc3/checks/markdown.hpp"

#include "kinds/spc3/checks/check.hpp"
#include "tb/chip/checks/rules_markdown.hpp"

namespace dsdpv1::spc3_checks {
namespace {

const char* const kIntroduction = R"(
## The checks of the SPC3 family

The checks of `apc3`, `spc3` and `vpc3` (`kinds/spc3/checks/`) see the pins of the user's bus, and from them its accesses; RESET, RTS, X/INT and
XDATAEXCH; and the telegrams on the line. So they judge every user CPU in the same way. Modes, limits and records are those above. Clauses and tables are those of the APC3
manual, rulings those of [spc3.md](spc3.md). Addresses are in Intel order.

| checks | judged |
|---|---|
| `START_...` | at each START: registers, organisation, buffers |
| `USE_...` | each access: owner of the buffer, cells that must not change online, the RAM's end |
| `ACK_...` | the answers to Set_Prm, Chk_Cfg and Set_Slave_Address |
| `IRQ_...` | IRR, IAR, IMR and EOI |
| `BUS_...` | the pins of each access; no document at hand has the times, so the limits are those of this project |
| `SPI_...` | the frames at SPI of a `vpc3` |
| `LIVE_...` | in DATA_EX: outputs, inputs, user watchdog |

These find the same as events of the chip ([reasons.md](reasons.md)), for each access: `BUS_READY` and `BEFORE_READY`, except as below; `BUS_LEVELS` and `UNKNOWN_ADDRESS`, `UNKNOWN_DATA`; `BUS_STROBES` and `BOTH_STROBES`; `USE_RAM` and `RAM_VIOLATION`; `USE_ORGANISATION` and `MODE0_ONLINE`, `ORGANISATION_ONLINE`; `SPI_FRAME` and `SPI_INSTRUCTION`, `SPI_ADDRESS`, `SPI_MORE`, `SPI_CUT`.
The pins do not show when a read is sampled, nor ready if XREADY comes sooner: by Early_Rdy, or still low from the access before. There only `BEFORE_READY` finds an access too early.
A write of the value that a cell has already does not violate `USE_ORGANISATION`. `NOT_ALLOWED` (answer 11) violates `ACK_FOUNDED` only without an event that the user has seen:
the master may have left meanwhile.

The accesses do not show:

- Bytes that the user has neither written nor read since power-on. They count as 00, and as not preset.
- The chip's owners of buffers. The user's is known from the answers of commands, after RESET and OFFLINE from A17 and A18; all others are the chip's.
- OFFLINE. The chip's event OFFLINE tells it, else the next look that shows MAC_Reset or PASSIVE_IDLE = 0. Up to then accesses count as online.
- The arrival of a block. `ACK_TIME` begins with the chip's event `TO_USER`, without such events with the first look at IRR or IR.
- The station's address. `LIVE_OUTPUTS` and `LIVE_WATCHDOG` learn it from the answers on the line while RTS is high, so they begin after the first one.
- A Diag_Buffer_Changed that the user has left standing. A later look at it counts as the return of the buffer.

A scenario with a user that does wrong on purpose names the check under `allow`, or switches it off.
)";

}  // namespace

std::string markdown(checks::RulingPlace place) { return kIntroduction + checks::rules_markdown(rules(), place); }

}  // namespace dsdpv1::spc3_checks
