#include "kinds/xgate/checks_markdown.hpp"

#include "kinds/xgate/check.hpp"
#include "tb/chip/checks/rules_markdown.hpp"

namespace dsdpv1::xgate_checks {
namespace {

const char* const kIntroduction = R"(
## The checks of the host of an XGate-DPS10

The checks of `xgate` (`kinds/xgate/`) see the pins between host and module, and read bytes and frames from them. Modes, limits and records are those above. Clauses and tables are
those of the module's data sheet, rulings those of [xgate.md](xgate.md). Only the port in use is judged, UART or SPI. A run takes rates and times from its scenario: `LINE_RATE`,
`FRAME_GAP` and `RESET_AWAITED` have limits then, and the table has none.

`ANSWER_AWAITED` is stricter than the module's event `XGATE_LOST`: the module loses a byte that ends before its answer has left, the check asks that none begins. Bytes that the module does not
hear are neither frames nor gaps. A host that waits for longer than `answer_delay` and `frame_gap` may send again.

The pins do not show why /INT is low. `INT_SERVED` ends with the next exchange; `QUEUE_ANSWERED`, `PARAMETERS_TAKEN` and `ALARM_CLEARED` begin with the answer that tells the host. Requests and parameters
end with data exchange, as the module's errors 3/1 to 3/4 tell. Each request has its own time, until the module takes an answer to it, or the master withdraws it.

The data sheet asks for more than these four, without a time: serve a request at once (4.4.1), answer it by the very next command (4.5.1, 14), clear the flag by the next one (4.3.1). No document
has the 100 ms.

With `errors: printed` an answer with `len` 83H is an error (X3) if the first byte of its data is a class, 1 to 4, and the fourth the XOR. 131 bytes of outputs may begin so.
)";

}  // namespace

std::string markdown(checks::RulingPlace place) { return kIntroduction + checks::rules_markdown(rules(), place); }

}  // namespace dsdpv1::xgate_checks
