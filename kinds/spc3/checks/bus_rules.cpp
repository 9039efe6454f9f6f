#include "kinds/spc3/checks/bus_rules.hpp"

#include <fmt/format.h>

#include <string>

namespace dsdpv1::spc3_checks {

using spc3::Pin;

namespace {

std::string cell_text(const BusAccess& access) {
  return access.address < 0 ? "AB without levels"
                            : fmt::format("{} of {:03X}H", access.write ? "write" : "read", access.address);
}

}  // namespace

void BusRules::reset() {
  running_.reset();
  hold_.reset();
}

void BusRules::pin(Tick at, Pin pin, tb::Level level, const spc3::BusLines& lines) {
  const bool is_motorola = spc3::is_motorola(lines.bus());
  switch (pin) {
    case Pin::kAb:
    case Pin::kAb11: return address_moves(at);
    case Pin::kDbIn: data_moved_ = at; return moves(at);
    case Pin::kXRd:
      if (is_motorola) address_moves(at);
      break;
    case Pin::kXReady:
      if (level == 0)
        ready_ = at;
      else
        ready_.reset();
      break;
    default: break;
  }
  if (is_motorola || (pin != Pin::kXRd && pin != Pin::kXWr && pin != Pin::kXCs) || level != 0) return;
  const auto is_low = [&](Pin each) { return each == pin || !lines.is_high(each); };
  const bool selected = lines.bus() == spc3::Bus::kIntelSync ? running_.has_value() : is_low(Pin::kXCs);
  if (!selected) return;
  recorder_.kept(Check::kBusStrobes, at, !is_low(Pin::kXRd) || !is_low(Pin::kXWr),
                 [] { return std::string("XRD and XWR are low at once"); });
}

void BusRules::address_moves(Tick at) {
  address_moved_ = at;
  if (running_) recorder_.value(Check::kBusSetup, at, running_->began - at, [this] { return cell_text(*running_); });
  moves(at);
}

void BusRules::moves(Tick at) {
  if (hold_) recorder_.value(Check::kBusHold, *hold_, at - *hold_, [] { return std::string("a write"); });
  hold_.reset();
}

void BusRules::began(const BusAccess& access, const spc3::BusLines& lines) {
  running_ = access;
  if (ready_) ready_ = access.began;
  recorder_.value(
      Check::kBusSetup, access.began, access.began - address_moved_, [&] { return cell_text(access); });
  recorder_.kept(Check::kBusLevels, access.began, lines.address() >= 0, [&] { return cell_text(access); });
  if (lines.bus() == spc3::Bus::kIntelSync)  // the strobes may be low before AB selects (A45)
    recorder_.kept(Check::kBusStrobes, access.began, !lines.reads() || !lines.writes(),
                   [] { return std::string("XRD and XWR are low at once"); });
}

void BusRules::ended(Tick at, const BusAccess& access, const spc3::BusLines& lines) {
  if (!spc3::is_synchronous(lines.bus())) judge_ready(at);
  running_.reset();
  if (!access.write) return;
  recorder_.value(
      Check::kBusData, at, at - data_moved_, [&] { return cell_text(access); });
  recorder_.kept(Check::kBusLevels, at, access.data >= 0,
                 [&] { return "DB without levels at the end of the " + cell_text(access); });
  hold_ = at;
}

void BusRules::judge_ready(Tick at) {
  const Tick measured = ready_ ? at - *ready_ : running_->began - at;
  recorder_.value(Check::kBusReady, at, measured, [this] { return cell_text(*running_); });
}

}  // namespace dsdpv1::spc3_checks
