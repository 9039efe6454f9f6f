#include "kinds/spc3/checks/checks.hpp"

#include "kinds/spc3/checks/start_rules.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/event.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3_checks {

using spc3::Pin;

void Checks::pin(Tick at, tb::PinNumber pin, tb::Level level) {
  history_.add(at, pin, level);
  bus_.pin(at, static_cast<Pin>(pin), level, reader_.lines());
  spi_.pin(at, static_cast<Pin>(pin), level, reader_.lines());
  reader_.pin(at, pin, level);
  switch (static_cast<Pin>(pin)) {
    case Pin::kReset: return reset_pin(level != 0);
    case Pin::kRts: return live_.rts(at, level != 0);
    case Pin::kXInt:
      if (!in_reset_) interrupt_.x_int(at, level != 0);
      return;
    case Pin::kXDataExch:
      if (!in_reset_) live_.xdataexch(at, level != 0);
      return;
    default: return;
  }
}

void Checks::reset_pin(bool level) {
  in_reset_ = level;
  bus_.reset();
  spi_.reset();
  chip_.reset();
  blocks_.drop();
  interrupt_.reset();
  live_.reset();
}

// --- accesses --------------------------------------------------------------------------------------------------------

void Checks::transferred(Tick at, const spc3_bus::BusAccess& access) {
  if (access.address < 0 || access.data < 0) return;
  accessed({at, static_cast<std::uint16_t>(access.address), static_cast<std::uint8_t>(access.data), access.write});
}

void Checks::accessed(const RegisterAccess& access) {
  constexpr std::uint16_t kMap = 0x7FF, kMapOfVpc3 = 0xFFF;
  has_accesses_ = true;
  if (in_reset_) return;
  RegisterAccess in_map = access;
  in_map.address &= chip_.is_vpc3() ? kMapOfVpc3 : kMap;
  recorder_.now(access.at);
  pass(access.at);
  take(in_map);
}

void Checks::take(const RegisterAccess& access) {
  const bool was_online = chip_.online(), starts = chip_.starts(access);
  if (starts) judge_start(recorder_, access.at, chip_);
  use_.accessed(access, blocks_.judges_cfg() && !live_.exchanging());
  blocks_.accessed(access);
  interrupt_.accessed(access);
  live_.accessed(access);
  chip_.accessed(access);
  if (starts) blocks_.start();
  if (was_online && !chip_.online()) blocks_.drop();
}

// --- time, telegrams, events -----------------------------------------------------------------------------------------

void Checks::pass(Tick now) {
  blocks_.pass(now);
  interrupt_.pass(now);
  live_.pass(now);
}

void Checks::telegram(Tick now, const bus::WireTelegram& telegram) {
  recorder_.now(now);
  live_.telegram(telegram);
  if (!in_reset_) pass(now);
}

void Checks::event(const profibus::Event& event) {
  if (event.reason == spc3::Reason::kToUser) {
    blocks_.arrived(event.at, event.a);
  } else if (event.reason == spc3::Reason::kOffline) {
    chip_.offline();
    blocks_.drop();
  } else if (event.reason == profibus::Reason::kDpState &&
             event.b == static_cast<std::uint16_t>(profibus::DpState::kWaitPrm)) {
    blocks_.left();
  }
}

bool Checks::applies(checks::CheckId check) const {
  const auto which = static_cast<Check>(check.index);
  if (which >= Check::kBusReady && which <= Check::kBusStrobes && by_spi()) return false;
  if (which >= Check::kSpiClock && which <= Check::kSpiArray && !by_spi()) return false;
  return has_accesses_;
}

void Checks::finish(Tick end) {
  reader_.pass(end + 1);
  recorder_.now(end);
  if (!in_reset_) pass(end);
}

}  // namespace dsdpv1::spc3_checks
