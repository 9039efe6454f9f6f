#include "kinds/spc3/chip.hpp"

#include <fmt/format.h>

#include <utility>

#include "kinds/spc3/port/bus_reader.hpp"

namespace dsdpv1::tb {
namespace {

using spc3::Pin;

static_assert(kLevelZ == spc3::kLevelZ && kLevelX == spc3::kLevelX);

const char* rulings_of(Pin pin) {
  switch (pin) {
    case Pin::kTxd: return "S11, S13, S14, S20, A28, A39";
    case Pin::kRts: return "P2, S11";
    case Pin::kXInt: return "A12, A13, A40";
    case Pin::kXDataExch: return "A24, A35";
    case Pin::kXReady: return "A42";
    case Pin::kDbOut: return "A16, A42";
    case Pin::kClkOut: return "A43";
    case Pin::kMiso: return "A59, A60";
    default: return "";
  }
}

PinTable table_of(int count) {
  PinTable pins;
  for (int i = 0; i < count; ++i) {
    const auto pin = static_cast<Pin>(i);
    const bool line = pin == Pin::kRxd || pin == Pin::kTxd, data = pin == Pin::kDbIn || pin == Pin::kDbOut;
    pins.push_back({spc3::name(pin), spc3::width(pin), spc3::is_input(pin), data ? "DB" : nullptr, line,
                    pin == Pin::kDbOut || pin == Pin::kMiso, rulings_of(pin)});
  }
  return pins;
}

}  // namespace

const PinTable& spc3_pins(spc3::Variant variant) {
  static const PinTable all = table_of(spc3::kPinCount), fewer = table_of(spc3::kTablePinCount);
  return row(variant).has_more_modes ? all : fewer;
}

const BoardPins kSpc3BoardPins = {number(Pin::kReset), number(Pin::kRxd), number(Pin::kTxd), number(Pin::kRts),
                                  number(Pin::kXInt)};

void Spc3Device::watch(const PinSink& sink, PinMask pins) {
  sink_ = sink;
  chip_.watch({[](void* self, Tick at, Pin pin, Level level) {
                 const PinSink& to = static_cast<Spc3Device*>(self)->sink_;
                 to.call(to.self, at, number(pin), level);
               },
               this},
              sink.call == nullptr ? 0 : pins);
}

void Spc3Device::on_event(const profibus::EventSink& sink) {
  event_sink_ = sink;
  if (sink.call == nullptr) return chip_.on_event({});
  chip_.on_event({[](void* self, const profibus::Event& event) { static_cast<Spc3Device*>(self)->told(event); }, this});
}

void Spc3Device::told(const profibus::Event& event) {
  if (event.at > chip_.now()) return events_.push_back(event);
  event_sink_.call(event_sink_.self, event);
}

/// An event of an access comes before all else of its edge.
void Spc3Device::advance(Tick to) {
  while (!events_.empty() && events_.front().at <= to) {
    const profibus::Event event = events_.front();
    events_.pop_front();
    chip_.advance(event.at - 1);
    event_sink_.call(event_sink_.self, event);
  }
  chip_.advance(to);
}

Spc3PinChip::Spc3PinChip(const std::string& name, std::unique_ptr<PinDevice> device, const spc3::Config& config,
                         spc3::Bus bus, PinMask watched, bus::Segment& segment, bool late)
    : PinChip(name, std::move(device), spc3_pins(config.variant), kSpc3BoardPins, watched, segment, late),
      cycle_(*device_, bus),
      has_spi_(row(config.variant).has_more_modes),
      spi_mode_(config.spi_mode) {
  const auto begin = [this](Pin pin, Level level) {
    device_->set(0, number(pin), level);
    begin_input(number(pin), level);
  };
  spc3_bus::strap(bus, begin);
  if (has_spi_ && sck_rests_high()) begin(Pin::kSck, 1);
}

void Spc3PinChip::reset_host(Tick at) {
  device();
  cycle_.idle(at);
  report(at);
  if (has_spi_) idle_serial(at);
}

// --- SPI -------------------------------------------------------------------------------------------------------------

void Spc3PinChip::idle_serial(Tick at) {
  move_serial(at, Pin::kXss, true);
  move_serial(at, Pin::kSck, sck_rests_high());
  move_serial(at, Pin::kMosi, false);
}

void Spc3PinChip::set_serial(Tick at, dsdpv1::Pin pin, bool level) {
  if (!has_spi_) return;
  switch (pin) {
    case dsdpv1::Pin::kXss: return move_serial(at, Pin::kXss, level);
    case dsdpv1::Pin::kSck: return move_serial(at, Pin::kSck, level);
    case dsdpv1::Pin::kMosi: return move_serial(at, Pin::kMosi, level);
    default: return;
  }
}

void Spc3PinChip::move_serial(Tick at, Pin pin, bool level) {
  if (device_->level(number(pin)) == (level ? 1 : 0)) return;
  device().set(at, number(pin), level ? 1 : 0);
  report_host(at, number(pin), number(pin));
  plan_again();
}

/// Released, it is high: a board has a pull-up.
bool Spc3PinChip::miso(Tick at) {
  if (!has_spi_) return true;
  device().advance(at - 1);
  return level(number(Pin::kMiso)) != 0;
}

// --- the parallel buses ----------------------------------------------------------------------------------------------

bool Spc3PinChip::is_high(Tick at, Pin pin) {
  device().advance(at);
  return level(number(pin)) != 0;
}

// Listeners act before the next edge.
void Spc3PinChip::run_edges(Tick until) {
  hear_line();
  pauses_ = false;
  for (Tick at = cycle_.next_edge(); at <= until && !pauses_; at = cycle_.next_edge()) {
    cycle_.run_edge();
    report(at);
    if (cycle_.next_edge() == bus::kNever) tell_access(at);
  }
  plan_again();
}

void Spc3PinChip::tell_access(Tick at) {
  if (!wanted_.actions) return;
  const user_cpu::Access& access = cycle_.access();
  listener_->action(number_, at,
                    access.write ? fmt::format("write {:03X} = {:02X}", access.address, access.value)
                                 : fmt::format("read {:03X}: {:02X}", access.address, cycle_.read_value()));
}

}  // namespace dsdpv1::tb
