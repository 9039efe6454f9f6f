#include "kinds/dsdpv1/chip/pin_chip.hpp"

#include <utility>

#include "kinds/dsdpv1/pins/pin_table.hpp"

namespace dsdpv1::tb {

namespace {

/// The output pins that the bench needs in any case.
constexpr PinMask kBusPins =
    dsdpv1::mask(Pin::kPbtxd) | dsdpv1::mask(Pin::kPbrts) | dsdpv1::mask(Pin::kIntr0) | dsdpv1::mask(Pin::kTxd);

// So that profibus::addressee is a bus::RunReader.
static_assert(profibus::kNoTelegram == bus::kNoTelegram && profibus::kForNobody == bus::kForNobody &&
              profibus::kBroadcast == bus::kBroadcast);

}  // namespace

PinChip::PinChip(const std::string& name, const dsdpv1::Config& config, std::uint32_t watched, bus::Segment& segment)
    : PinChip(name, std::make_unique<CoreDevice>(config), watched, segment) {}

PinChip::PinChip(const std::string& name, std::unique_ptr<PinDevice> device, std::uint32_t watched,
                 bus::Segment& segment)
    : device_(std::move(device)),
      chip_(*device_),
      pins_(std::in_place, chip_),
      segment_(segment),
      station_(segment.attach(name, this)),
      line_(segment, station_) {
  begin_watch(watched);
  chip_.on_event({[](void* self, const profibus::Event& event) {
                    auto& view = *static_cast<PinChip*>(self);
                    view.pause_access();
                    if (view.on_event) view.on_event(event);
                  },
                  this});
}

void PinChip::begin_watch(PinMask pins) {
  reports_host_ = (pins & inputs_of(pins_of(Part::kRsu)) & ~dsdpv1::mask(Pin::kPbrxd)) != 0;
  reports_rxd_ = (pins & dsdpv1::mask(Pin::kPbrxd)) != 0;
  reports_txd_ = (pins & dsdpv1::mask(Pin::kPbtxd)) != 0;
  chip_.watch(
      {[](void* self, Tick at, Pin pin, Level level) { static_cast<PinChip*>(self)->pin_changed(at, pin, level); },
       this},
      (pins & outputs_of(Part::kRsu)) | kBusPins);
  for (std::size_t pin = 0; pin < inputs_.size(); ++pin) inputs_.at(pin) = chip_.level(static_cast<Pin>(pin));
}

// A telegram under way is told by its changes from here on.
void PinChip::watch(Tick now, PinMask pins) {
  segment_.cut_run(now);
  device();
  begin_watch(pins);
  segment_.set_deafness(station_, {});
  segment_.set_filter(station_, {});
  update_hearing();
}

Tick PinChip::next() const {
  if (line_.waits()) return line_.since();
  return chip_.left_run() ? core().now() : chip_.next_event();
}

void PinChip::run(Tick now) {
  PinDevice& chip = device();
  catch_up_access(now);
  chip.advance(now);
  if (inside_ && on_inside) inside_->look(now, core(), on_inside);
  if (chip_.left_run()) {
    segment_.cut_run(now);
    chip_.leave_run(now);
  }
  send_run();
  line_.pass_on();
  update_hearing();
}

// An answer begins: its first start bit waits to be told, or the whole of it is told in its place.
void PinChip::send_run() {
  if ((reports_txd_ && !on_run) || !line_.only_level_waits() || !chip_.begins_to_send()) return;
  const profibus::CharacterRun run = chip_.hide_txd();
  own_run_ = true;
  hides_txd_ = segment_.send_run(
      station_, {run.start, run.bit * bus::kTicksPerCycle, run.bytes, static_cast<std::size_t>(run.size)});
  if (hides_txd_)
    line_.forget_level();
  else
    chip_.show_txd(run.start);
}

void PinChip::pin_changed(Tick at, Pin pin, Level level) {
  if (pin != Pin::kDOut) pause_access();  // D is recorded and checked, nobody else looks at it
  tell(at, pin, level);
  if (pin == Pin::kTxd && on_txd) on_txd(at, level != 0);
  if (pin == Pin::kPbtxd) line_.drive(at, level != 0);
  if (pin == Pin::kPbrts) line_.enable(at, level != 0);
  if (pin == Pin::kPbrts) own_run_ = hides_txd_ = false;
}

void PinChip::line_changed(Tick at, bool level) {
  if (catching_up_) return chip_.hear(at, level);
  catch_up_access(at);
  chip_.set(at, Pin::kPbrxd, level ? 1 : 0);
  announce(next());
  if (reports_rxd_) report_inputs(at, Pin::kPbrxd, Pin::kPbrxd);
  update_hearing();
}

bool PinChip::run_begins(const bus::CharacterRun& run) {
  if (reports_rxd_) {
    if (!on_run) return false;
    on_run(static_cast<PinNumber>(Pin::kPbrxd));
  }
  if (own_run_ && reports_txd_) on_run(static_cast<PinNumber>(Pin::kPbtxd));
  if (own_run_) return true;  // while it sends, it does not listen
  if (run.bit % bus::kTicksPerCycle != 0) return false;
  catch_up_access(run.start);
  const bool taken =
      chip_.hear(run.start, {run.start, run.bit / bus::kTicksPerCycle, run.bytes, static_cast<int>(run.size)});
  announce(next());  // the same as before, as long as the telegram is not for this station
  update_hearing();
  return taken;
}

void PinChip::runs_passed(std::uint64_t for_stations) { chip_.pass(for_stations); }

void PinChip::run_cut(Tick at, bool level) {
  announce();
  catch_up_access(at);
  if (std::exchange(hides_txd_, false)) {
    chip_.show_txd(at);
    line_.resume(level);
  }
  if (std::exchange(own_run_, false))
    chip_.set(at, Pin::kPbrxd, level ? 1 : 0);
  else
    chip_.leave_run(at);
  inputs_[static_cast<std::size_t>(Pin::kPbrxd)] = level ? 1 : 0;
  update_hearing();
}

// Who shows the pin wants each change of it in time.
void PinChip::update_hearing() {
  if (reports_rxd_) return;
  const profibus::Unheard unheard = chip_.unheard();
  segment_.set_deafness(station_, {unheard.from, unheard.until});
  const profibus::Unconcerned unconcerned = chip_.unconcerned();
  segment_.set_filter(
      station_, {&profibus::addressee, unconcerned.from, unconcerned.bit * bus::kTicksPerCycle, unconcerned.address});
}

void PinChip::strap(const Straps& levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto pin = static_cast<std::size_t>(Pin::kMode) + i;
    device().set(0, static_cast<Pin>(pin), levels[i]);
    inputs_.at(pin) = levels[i];
  }
}

void PinChip::set_reset(Tick at, bool level) {
  device().set(at, Pin::kReset, level ? 1 : 0);
  update_hearing();
  report_host(at, Pin::kReset, Pin::kReset);
}

void PinChip::set_pin(Tick at, Pin pin, Level level) {
  device().set(at, pin, level);
  update_hearing();
  report_host(at, pin, pin);
}

void PinChip::reset_host(Tick at) {
  catch_up_access(at + 1);
  put_off_ = false;
  pins_.emplace(chip_);
  PinDevice& chip = device();
  for (const Pin pin : {Pin::kRd, Pin::kWr, Pin::kCsr}) chip.set(at, pin, 1);
  for (const Pin pin : {Pin::kRSta, Pin::kRReq}) chip.set(at, pin, 0);
  chip.set(at, Pin::kDIn, dsdpv1::kLevelZ);
  chip.set(at, Pin::kA, dsdpv1::HostAccess::kIdleAddress);
  for (const Pin pin : {Pin::kXss, Pin::kRxd}) chip.set(at, pin, 1);
  for (const Pin pin : {Pin::kSck, Pin::kMosi}) chip.set(at, pin, 0);
  report_host(at, Pin::kXss, Pin::kRxd);
  report_host(at, Pin::kRReq, Pin::kDIn);
}

void PinChip::set_serial(Tick at, Pin pin, bool level) {
  catch_up_access(at);
  if (chip_.level(pin) == (level ? 1 : 0)) return;
  device().set(at, pin, level ? 1 : 0);
  report_host(at, pin, pin);
}

/// Released, it is high: a board has a pull-up (SP6 reads FF where nobody drives).
bool PinChip::miso(Tick at) {
  PinDevice& chip = device();
  chip.advance(at - 1);
  return chip.level(Pin::kMiso) != 0;
}

void PinChip::set_r_req(Tick at, bool level) {
  tell_action(at, "R_REQ", level);
  pins().set_r_req(at, level);
  report_host(at, Pin::kRReq, Pin::kRReq);
}

void PinChip::set_r_sta(Tick at, bool level) {
  tell_action(at, "R_STA", level);
  pins().set_r_sta(at, level);
  report_host(at, Pin::kRSta, Pin::kRSta);
}

void PinChip::begin(Tick at, const user_cpu::Access& access, const AccessTiming& timing) {
  pins_->begin(at, access, timing);  // no edge yet: the chip is not concerned
  tell_action(at, access);
  if (!access.write && on_read) on_read(pins_->sample_tick());
}

bool PinChip::put_off() {
  put_off_ = !reports_host_ && pins().put_off();
  return put_off_;
}

// The chip is about to act at `at`, or to hear something.
void PinChip::catch_up_access(Tick at) {
  if (!put_off_) return;
  if (!reports_host_) {
    if (pins_->next_edge() < at) pins_->run_edges(at - 1);
    return;
  }
  for (Tick edge = pins_->next_edge(); edge < at; edge = pins_->next_edge()) {  // watched since it was put off
    pins_->run_edges(edge);
    report_access(edge);
  }
}

// Whoever is told something acts before the next edge.
void PinChip::run_edges(Tick until) {
  user_cpu::PinHostBus& host = *pins_;
  hear_line();
  pauses_ = put_off_ = false;
  const bool whole = !reports_host_ && until >= host.last_edge() && host.run_whole();
  if (!whole) run_edges_singly(host, until);
  announce(next());
  update_hearing();
}

void PinChip::run_edges_singly(user_cpu::PinHostBus& host, Tick until) {
  for (Tick at = host.next_edge(); at <= until && !pauses_; at = host.next_edge()) {
    host.run_edges(at);
    if (reports_host_) report_access(at);
  }
}

// Strobes that rise with CSR are told before it, as the TLM module does.
void PinChip::report_access(Tick at) {
  if (chip_.level(Pin::kCsr) != 0) report_inputs(at, Pin::kRd, Pin::kWr);
  report_inputs(at, Pin::kCsr, Pin::kDIn);
}

void PinChip::report_host(Tick at, Pin first, Pin last) {
  if (reports_host_) report_inputs(at, first, last);
}

void PinChip::report_inputs(Tick at, Pin first, Pin last) {
  for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
    const Pin pin = static_cast<Pin>(i);
    const Level level = chip_.level(pin);
    if (std::exchange(inputs_.at(i), level) != level) tell(at, pin, level);
  }
}

}  // namespace dsdpv1::tb
