#include "kinds/dsdpv1/chip/dsdpv1_pin_chip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "kinds/dsdpv1/chip/core_device.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"

namespace dsdpv1::tb {
namespace {

dsdpv1::Chip* core_of(PinDevice& device) {
  auto* core = dynamic_cast<CoreDevice*>(&device);
  return core == nullptr ? nullptr : &core->chip();
}

}  // namespace

const BoardPins kDsdpv1BoardPins = {number(Pin::kReset), number(Pin::kPbrxd), number(Pin::kPbtxd),
                                    number(Pin::kPbrts), number(Pin::kIntr0), dsdpv1::mask(Pin::kTxd)};

std::string words_of(const user_cpu::Access& access) {
  return access.write ? fmt::format("write B{:03X} {:02X}", access.address, access.value)
                      : fmt::format("read B{:03X}", access.address);
}

std::string words_of(const char* pin, bool level) { return fmt::format("{} {}", pin, level ? 1 : 0); }

Dsdpv1PinChip::Dsdpv1PinChip(const std::string& name, std::unique_ptr<PinDevice> device, Part part, PinMask watched,
                             bus::Segment& segment, bool late)
    : PinChip(name, std::move(device), pins_of(part), kDsdpv1BoardPins, watched, segment, late),
      part_(part),
      core_(core_of(*device_)) {
  pins_.emplace(*device_, core_);
}

void Dsdpv1PinChip::strap(const Straps& levels) {
  if (!dsdpv1::has_serial_ports(part_)) return;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto pin = static_cast<PinNumber>(number(Pin::kMode) + i);
    device().set(0, pin, levels[i]);
    begin_input(pin, levels[i]);
  }
}

void Dsdpv1PinChip::reset_host(Tick at) {
  if (put_off_) catch_up_host(at + 1);
  put_off_ = false;
  pins_.emplace(*device_, core_);
  PinDevice& chip = device();
  for (const Pin pin : {Pin::kRd, Pin::kWr, Pin::kCsr}) chip.set(at, number(pin), 1);
  for (const Pin pin : {Pin::kRSta, Pin::kRReq}) chip.set(at, number(pin), 0);
  chip.set(at, number(Pin::kDIn), dsdpv1::kLevelZ);
  chip.set(at, number(Pin::kA), dsdpv1::HostAccess::kIdleAddress);
  if (dsdpv1::has_serial_ports(part_)) {
    for (const Pin pin : {Pin::kXss, Pin::kRxd}) chip.set(at, number(pin), 1);
    for (const Pin pin : {Pin::kSck, Pin::kMosi}) chip.set(at, number(pin), 0);
    report(at, Pin::kXss, Pin::kRxd);
  }
  report(at, Pin::kRReq, Pin::kDIn);
}

void Dsdpv1PinChip::set_serial(Tick at, Pin pin, bool level) {
  if (put_off_) catch_up_host(at);
  if (device_->level(number(pin)) == (level ? 1 : 0)) return;
  device().set(at, number(pin), level ? 1 : 0);
  if (pin == Pin::kRxd || (pin == Pin::kXss && !level)) spoiler_.request_begins();
  if (pin == Pin::kSck && level) sck_rises(at);
  report(at, pin, pin);
}

void Dsdpv1PinChip::sck_rises(Tick at) {
  spoiler_.sck_rises(device_->level(number(Pin::kMiso)) != 0);
  if (spoiler_.begins_to_invert()) tell_spoilt(at);
}

/// Released, it is high: a board has a pull-up (SP6 reads FF while MISO is not driven).
bool Dsdpv1PinChip::miso(Tick at) {
  PinDevice& chip = device();
  chip.advance(at - 1);
  return (chip.level(number(Pin::kMiso)) != 0) != spoiler_.inverts_miso();
}

void Dsdpv1PinChip::host_pin_changed(Tick at, PinNumber /*pin*/, Level level) {
  if (level == 0 && spoiler_.hides_fall()) return tell_spoilt(at);
  if (on_txd) on_txd(at, level != 0);
}

void Dsdpv1PinChip::set_r_req(Tick at, bool level) {
  if (wanted_.actions) listener_->action(number_, at, words_of("R_REQ", level));
  pins().set_r_req(at, level);
  report(at, Pin::kRReq, Pin::kRReq);
}

void Dsdpv1PinChip::set_r_sta(Tick at, bool level) {
  if (wanted_.actions) listener_->action(number_, at, words_of("R_STA", level));
  pins().set_r_sta(at, level);
  report(at, Pin::kRSta, Pin::kRSta);
}

void Dsdpv1PinChip::looked(const user_cpu::Looks& last) {
  if (!wanted_.reads) return;
  listener_->looked(number_, number(Pin::kLReq), last.l_req);
  listener_->looked(number_, number(Pin::kLSta), last.l_sta);
}

void Dsdpv1PinChip::begin(Tick at, const user_cpu::Access& access, const AccessTiming& timing) {
  pins_->begin(at, access, timing);  // no edge yet, so the chip is not affected
  wrong_bits_ = access.write ? std::uint8_t{0} : spoiler_.wrong_bits(access.address);
  if (wrong_bits_ != 0) tell_spoilt(at);
  if (wanted_.actions) listener_->action(number_, at, words_of(access));
  if (!access.write && wanted_.reads) listener_->read(number_, pins_->sample_tick());
}

bool Dsdpv1PinChip::put_off() {
  put_off_ = !reports_host() && pins().put_off();
  return put_off_;
}

void Dsdpv1PinChip::catch_up_host(Tick at) {
  if (!reports_host()) {
    if (pins_->next_edge() < at) pins_->run_edges(at - 1);
    return;
  }
  for (Tick edge = pins_->next_edge(); edge < at; edge = pins_->next_edge()) {  // watched since the access was put off
    pins_->run_edges(edge);
    report_access(edge);
  }
}

// Listeners act before the next edge.
void Dsdpv1PinChip::run_edges(Tick until) {
  hear_line();
  put_off_ = false;
  if (until >= pins_->last_edge() && run_whole()) return announce(next());  // only the host port has acted
  pauses_ = false;
  run_edges_singly(until);
  plan_again();
}

bool Dsdpv1PinChip::run_whole() {
  const bool quiet = !acts_on_events();
  pauses_ = quiet;  // a whole access does not pause: its events need not ask again
  if (!reports_host()) return pins_->run_whole(quiet);
  if (!reports_late() || !quiet || !pins_->run_whole(false)) return false;
  report_whole(pins_->access(), pins_->last_edge() - pins_->access().last());
  return true;
}

/// The edges as the user CPU and the chip have made them.
void Dsdpv1PinChip::report_whole(const dsdpv1::HostAccess& access, Tick begin) {
  std::array<PinEdge, dsdpv1::kMostChanges> edges;
  const Level read = access.is_write() ? dsdpv1::kLevelZ : pins_->read_value();
  report_edges(edges.data(), dsdpv1::changes_of_whole(
                                 access, begin, read, [](Pin pin) { return number(pin); }, edges));
}

void Dsdpv1PinChip::run_edges_singly(Tick until) {
  for (Tick at = pins_->next_edge(); at <= until && !pauses_; at = pins_->next_edge()) {
    pins_->run_edges(at);
    if (reports_host()) report_access(at);
  }
}

// Strobes that rise with CSR are reported before it, as the TLM module does.
void Dsdpv1PinChip::report_access(Tick at) {
  if (device_->level(number(Pin::kCsr)) != 0) report_inputs(at, number(Pin::kRd), number(Pin::kWr));
  report_inputs(at, number(Pin::kCsr), number(Pin::kDIn));
}

void Dsdpv1PinChip::report(Tick at, Pin first, Pin last) { report_host(at, number(first), number(last)); }

}  // namespace dsdpv1::tb
