#include "kinds/dsdpv1/checks/service.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/baud.hpp"
#include "bus/time_text.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::checks {

void Service::reset() {
  intr0_fell_.reset();
  due_exchange_.reset();
  last_exchange_.reset();
  longest_part_ = 0;
}

// --- INTR0 -----------------------------------------------------------------------------------------------------------

void Service::intr0(Tick at, bool level) {
  if (!level && !intr0_fell_) intr0_fell_ = at;
}

void Service::accessed(const Access& access) {
  if (!intr0_fell_ || access.write) return;
  const bool in_areas = access.address >= regs::kPrm && access.address <= regs::kCfgCrc + 1;
  if (!in_areas && (access.address != regs::kChipCommand1 || !access.value)) return;
  constexpr unsigned kJudgedNews = regs::kChipCommand1Prm | regs::kChipCommand1Cfg;
  // Nothing in B00E: an earlier service has already fetched this block.
  if (in_areas || (*access.value & kJudgedNews) != 0)
    recorder_.value(
        Check::kIntr0Service, *intr0_fell_, access.began - *intr0_fell_,
        [&access] { return fmt::format("served by the read of B{:03X}", access.address); },
        Act::omitted(*intr0_fell_, access.began));
  intr0_fell_.reset();
}

void Service::finish(Tick at, std::optional<Tick> held_off_since) {
  pass(at, held_off_since);
  if (intr0_fell_)
    recorder_.value(
        Check::kIntr0Service, *intr0_fell_, at - *intr0_fell_, [] { return std::string("not served"); },
        Act::omitted(*intr0_fell_, at));
  intr0_fell_.reset();
}

// --- the bus cycle ---------------------------------------------------------------------------------------------------

void Service::held_off(Tick since, Tick at) {
  pass(at, since);
  add_part(since, at);
}

/// The time before the interval does not count.
void Service::add_part(Tick since, Tick at) {
  if (!last_exchange_) return;
  const Tick begin = std::max(since, *last_exchange_);
  if (at - begin <= longest_part_) return;
  longest_part_ = at - begin;
  longest_since_ = begin;
}

/// Time has advanced to `at`.
void Service::pass(Tick at, std::optional<Tick> held_off_since) {
  if (!due_exchange_ || *due_exchange_ > at) return;
  if (held_off_since && *held_off_since < *due_exchange_) add_part(*held_off_since, *due_exchange_);
  exchange(*due_exchange_);
  due_exchange_.reset();
}

void Service::telegram(Tick now, const bus::WireTelegram& telegram, std::optional<Tick> held_off_since) {
  pass(now, held_off_since);
  if (station_.is_exchange(telegram)) due_exchange_ = telegram.end + bus::baud(telegram.baud).bit;
}

void Service::exchange(Tick at) {
  if (last_exchange_ && longest_part_ != 0) {
    const Tick interval = at - *last_exchange_;
    recorder_.value(
        interval_, at, interval - longest_part_,
        [&] {
          return fmt::format("the chip was held off for {} of the {} between two Data_Exchange",
                             bus::short_time(longest_part_), bus::short_time(interval));
        },
        Act::omitted(longest_since_, longest_since_ + longest_part_));
  }
  last_exchange_ = at;
  longest_part_ = 0;
}

}  // namespace dsdpv1::checks
