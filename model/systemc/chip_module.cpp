#include "model/systemc/chip_module.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::systemc {
namespace {

/// The violations of the host port after which the data of the access are not reliable.
bool spoils_data(profibus::Reason reason) {
  constexpr profibus::Reason kSpoiling[] = {
      Reason::kWriteLowTooShort, Reason::kWriteSetup,   Reason::kWriteHold,          Reason::kWriteFloating,
      Reason::kWriteDeselected,  Reason::kWriteOverrun, Reason::kReadAddressChanged, Reason::kReadTooShort,
      Reason::kReadInFlight,     Reason::kReadUnknown};
  return std::find(std::begin(kSpoiling), std::end(kSpoiling), reason) != std::end(kSpoiling);
}

/// True during its lifetime, even if a report throws.
class WhileIn {
 public:
  explicit WhileIn(bool& flag) : flag_(flag) { flag = true; }
  ~WhileIn() { flag_ = false; }
  WhileIn(const WhileIn&) = delete;
  WhileIn& operator=(const WhileIn&) = delete;

 private:
  bool& flag_;
};

}  // namespace

ChipModule::ChipModule(const sc_core::sc_module_name& name, const ChipOptions& options)
    : sc_core::sc_module(name), due_("due"), options_(options), chip_(options.chip) {
  require_resolution();
  if (options.phase < 0 || options.phase >= profibus::kTicksPerCycle) {
    const std::string text = "phase is " + std::to_string(options.phase) + " ticks, expected 0 to 249";
    SC_REPORT_ERROR("/dsdpv1/phase", text.c_str());
  }
  changed_ = outputs_of(options.chip.part);
  for (int pin = 0; pin < pin_count(options.chip.part); ++pin)
    if (chip_.level(static_cast<Pin>(pin)) == 1) high_ |= mask(static_cast<Pin>(pin));
  chip_.on_event(
      {[](void* self, const profibus::Event& event) { static_cast<ChipModule*>(self)->event_happened(event); }, this});
}

void ChipModule::watch(std::uint32_t pins, std::uint32_t asked) {
  asked_ = asked;
  chip_.watch(
      {[](void* self, Tick at, Pin pin, Level level) { static_cast<ChipModule*>(self)->pin_changed(at, pin, level); },
       this},
      pins);
}

void ChipModule::set(Tick at, Pin pin, Level level) {
  if (chip_.level(pin) == level) return;
  const WhileIn core(in_core_);
  if (on_pin) {
    chip_.advance(at);  // earlier events of the core must precede this change
    on_pin(at, pin, level);
  }
  chip_.set(at, pin, level);
}

void ChipModule::advance(Tick to) {
  const WhileIn core(in_core_);
  chip_.advance(to);
}

Level ChipModule::sample(Tick at) {
  const WhileIn core(in_core_);
  return chip_.sample(at);
}

Level ChipModule::miso_before(Tick at) {
  advance(at - 1);
  return chip_.level(Pin::kMiso);
}

bool ChipModule::carry_out(Tick begin, const HostAccess& access, Level& sampled) {
  const WhileIn core(in_core_);
  return chip_.carry_out(begin, access, sampled);
}

bool ChipModule::hear(Tick at, const profibus::CharacterRun& run) {
  const WhileIn core(in_core_);
  return chip_.hear(at, run);
}

void ChipModule::leave_run(Tick at) {
  const WhileIn core(in_core_);
  chip_.leave_run(at);
}

profibus::CharacterRun ChipModule::hide_txd() {
  const WhileIn core(in_core_);
  return chip_.hide_txd();
}

void ChipModule::show_txd(Tick at) {
  const WhileIn core(in_core_);
  chip_.show_txd(at);
}

std::uint32_t ChipModule::take_changed() {
  const std::uint32_t pins = changed_;
  changed_ = 0;
  return pins;
}

void ChipModule::drive(std::uint32_t pins) {
  for (auto wire = wires_.begin(); wire != wires_.end() && pins != 0; ++wire) {
    if ((pins & wire->pin) == 0) continue;
    wire->signal->write((high_ & wire->pin) != 0);
    pins &= ~wire->pin;
  }
}

bool ChipModule::take_broken_timing() {
  const bool broken = broken_timing_;
  broken_timing_ = false;
  return broken;
}

// A notification that is no longer needed is not cancelled: the kernel keeps cancelled ones in its queue until their
// time, and a watchdog that every telegram moves would leave thousands there. For the same reason no notification is
// made for a time far ahead.
void ChipModule::schedule(Tick now, Tick due) {
  constexpr Tick kFarthest = 100'000 * profibus::kTicksPerNs;
  if (due == profibus::kNever) return;
  // Everything of this tick is done; scheduling it again would stop simulation time.
  const Tick at = std::min(std::max(due, now + 1), now + kFarthest);
  if (scheduled_ > now && scheduled_ <= at) return;
  scheduled_ = at;
  scheduled_at_ = to_time(at + options_.phase);
  due_.notify(scheduled_at_ - sc_core::sc_time_stamp());
}

void ChipModule::schedule_now() {
  scheduled_ = 0;
  scheduled_at_ = sc_core::sc_max_time();
  due_.notify(sc_core::SC_ZERO_TIME);
}

void ChipModule::pin_changed(Tick at, Pin pin, Level level) {
  if ((asked_ & mask(pin)) != 0 && !output_changed(at, pin, level)) return;
  changed_ |= mask(pin);
  high_ = level == 1 ? high_ | mask(pin) : high_ & ~mask(pin);
  if (on_pin) on_pin(at, pin, level);
}

void ChipModule::event_happened(const profibus::Event& event) {
  broken_timing_ = broken_timing_ || spoils_data(event.reason);
  if (on_event) on_event(event);
  if (!options_.report_violations || profibus::severity(event.reason) != profibus::Severity::kViolation) return;
  const std::string text = std::string(name()) + ": " + profibus::code(event.reason) + ": " + dsdpv1::describe(event);
  SC_REPORT_WARNING("/dsdpv1/violation", text.c_str());
}

}  // namespace dsdpv1::systemc
