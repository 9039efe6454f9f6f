#include "cosim/random/play_log.hpp"

#include <fmt/format.h>

#include "bus/telegram/explain.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::cosim {

void PlayLog::pin(Tick at, Side side, Pin pin, Level level) {
  log_.add({at, name(side), "pin", fmt::format("{} {}", dsdpv1::name(pin), level_text(dsdpv1::width(pin), level))});
}

void PlayLog::event(const profibus::Event& event) {
  log_.add({event.at, name(Side::kModel), tb::name(profibus::severity(event.reason)), dsdpv1::describe(event),
            profibus::code(event.reason)});
}

void PlayLog::telegram(Tick /*now*/, const bus::WireTelegram& telegram) {
  const bus::Decoded& decoded = telegram.decoded;
  log_.add(tb::log_entry(telegram, decoded.readable ? bus::explain_line(decoded.telegram) : "not readable"));
}

void PlayLog::ends(Tick /*end*/, const Lockstep& lockstep) {
  if (const std::optional<Difference>& difference = lockstep.difference())
    log_.finding({difference->at, "lockstep", "difference", difference->what});
  log_.finish();
}

}  // namespace dsdpv1::cosim
