#include "kinds/spc3/checks/spi_rules.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "registers/spc3_regs.hpp"

namespace dsdpv1::spc3_checks {

using spc3::Pin;

void SpiRules::reset() {
  taken_.reset();
  hold_.reset();
}

void SpiRules::pin(Tick at, Pin pin, tb::Level level, const spc3::BusLines& lines) {
  if (lines.bus() != spc3::Bus::kSpi) return;
  if (pin == Pin::kXss) return reset();
  if (pin == Pin::kMosi) return mosi_moves(at);
  if (pin == Pin::kSck && !lines.is_high(Pin::kXss) && (level != 0) == takes_at_) take(at);
}

void SpiRules::take(Tick at) {
  const auto words = [] { return std::string("in a frame"); };
  if (taken_) recorder_.value(Check::kSpiClock, at, at - *taken_, words);
  recorder_.value(Check::kSpiData, at, at - mosi_moved_, [] { return std::string("MOSI before SCK"); });
  taken_ = hold_ = at;
}

void SpiRules::mosi_moves(Tick at) {
  mosi_moved_ = at;
  if (const auto held = std::exchange(hold_, std::nullopt))
    recorder_.value(Check::kSpiData, at, at - *held, [] { return std::string("MOSI after SCK"); });
}

void SpiRules::ended(const spc3_bus::SpiFrame& frame) {
  if (frame.out.empty() && frame.bits == 0) return;
  const std::string wrong = wrong_with(frame);
  recorder_.kept(Check::kSpiFrame, frame.ended, wrong.empty(), [&] { return words_of(frame) + ": " + wrong; });
  const bool is_array_read = frame.is_known() && frame.is_read() && frame.is_array() && frame.data() > 0;
  if (is_array_read)
    recorder_.kept(Check::kSpiArray, frame.ended, frame.address() >= spc3::regs::kOrg, [&] { return words_of(frame); });
}

}  // namespace dsdpv1::spc3_checks
