#include "cosim/random/play_log.hpp"

#include <fmt/format.h>

#include "bus/telegram/explain.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::cosim {

void PlayLog::pin(Tick at, Side side, PinNumber pin, Level level) {
  const tb::PinInfo& info = kind_.pins()[pin];
  log_.add({at, name(side), "pin", fmt::format("{} {}", info.name, level_text(info.width, level))});
}

void PlayLog::event(const profibus::Event& event) {
  log_.add({event.at, name(Side::kModel), tb::name(profibus::severity(event.reason)), kind_.describe(event),
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
