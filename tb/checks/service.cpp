#include "tb/checks/service.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "registers/dsdpv1_regs.hpp"

namespace checks {
namespace {

namespace regs = dsdpv1::regs;

}  // namespace

void Service::reset() {
  intr0_fell_.reset();
  address_.reset();
  last_exchange_.reset();
  sending_ = false;
}

// --- INTR0 ------------------------------------------------------------------------------------------------------------

void Service::intr0(Tick at, bool level) {
  if (!level && !intr0_fell_) intr0_fell_ = at;
}

void Service::accessed(const Access& access) {
  if (!intr0_fell_ || access.write) return;
  const bool in_areas = access.address >= regs::kPrm && access.address <= regs::kCfgCrc + 1;
  if (!in_areas && (access.address != regs::kChipCommand1 || !access.value)) return;
  constexpr unsigned kNews = regs::kChipCommand1Prm | regs::kChipCommand1Cfg;
  // Nothing in B00E: an earlier service has taken this block along, and there is nothing left to do.
  if (in_areas || (*access.value & kNews) != 0)
    recorder_.value(Check::kIntr0Service, *intr0_fell_, access.began - *intr0_fell_,
                    [&access] { return fmt::format("served by the read of B{:03X}", access.address); });
  intr0_fell_.reset();
}

void Service::finish(Tick at) {
  if (intr0_fell_)
    recorder_.value(Check::kIntr0Service, *intr0_fell_, at - *intr0_fell_, [] { return std::string("not served"); });
  intr0_fell_.reset();
}

// --- the bus cycle ----------------------------------------------------------------------------------------------------

void Service::pbrts(Tick at, bool level) {
  sending_ = level;
  (level ? pbrts_rose_ : pbrts_fell_) = at;
}

void Service::request_ended(Tick since, Tick at) { longest_hold_ = std::max(longest_hold_, at - since); }

/// Which address the station has is seen by what it answers to: nobody else drives the line while PBRTS is high.
bool Service::is_own_answer(const bus::WireTelegram& telegram) const {
  return telegram.tsdr && pbrts_rose_ <= telegram.start && (sending_ || pbrts_fell_ >= telegram.end) &&
         pbrts_rose_ != 0;
}

bool Service::is_exchange(const bus::WireTelegram& telegram) const {
  if (!telegram.right() || !address_) return false;
  const bus::Telegram& request = telegram.decoded.telegram;
  const bool srd = request.function() == bus::fc::kSrdLow || request.function() == bus::fc::kSrdHigh;
  return request.is_request() && srd && request.da == *address_ && !request.dsap;
}

void Service::telegram(const bus::WireTelegram& telegram, std::optional<Tick> requested_since) {
  if (is_own_answer(telegram)) address_ = telegram.station;
  if (is_exchange(telegram)) exchange(telegram.end, requested_since);
}

void Service::exchange(Tick at, std::optional<Tick> requested_since) {
  if (requested_since) longest_hold_ = std::max(longest_hold_, at - *requested_since);
  if (last_exchange_ && longest_hold_ != 0) {
    const Tick interval = at - *last_exchange_;
    recorder_.value(Check::kHoldInterval, at, interval - longest_hold_, [&] {
      return fmt::format("R_REQ was high for {}, Data_Exchange came after {}", ns_text(longest_hold_),
                         ns_text(interval));
    });
  }
  last_exchange_ = at;
  longest_hold_ = 0;
}

}  // namespace checks
