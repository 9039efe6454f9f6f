#include "model/systemc/core_module.hpp"

#include <array>

#include "model/systemc/character_line.hpp"

namespace dsdpv1::systemc {
namespace {

/// Increment when the content or meaning of a module's stored state changes.
constexpr profibus::StateFrame kFrame = {0x4353'3156'5044'5344, 1};  // "DSDPV1SC"

using Title = std::array<std::uint8_t, 24>;

Title bytes_of(const char* text) {
  Title title{};
  for (std::size_t i = 0; i < title.size() && text[i] != 0; ++i) title[i] = static_cast<std::uint8_t>(text[i]);
  return title;
}

std::string text_of(const Title& title) { return {title.begin(), std::find(title.begin(), title.end(), 0)}; }

}  // namespace

TimedModule::TimedModule(const sc_core::sc_module_name& name, Tick phase)
    : sc_core::sc_module(name), phase_(phase), zero_(phase) {
  require_resolution();
  if (phase < 0 || phase >= profibus::kTicksPerCycle) {
    const std::string text = "phase is " + std::to_string(phase) + " ticks, expected 0 to 249";
    SC_REPORT_ERROR("/dsdpv1/phase", text.c_str());
  }
}

void TimedModule::drive(std::uint32_t pins) {
  for (auto wire = wires_.begin(); wire != wires_.end() && pins != 0; ++wire) {
    if ((pins & wire->pin) == 0) continue;
    wire->signal->write((high_ & wire->pin) != 0);
    pins &= ~wire->pin;
  }
}

// A notification that is no longer needed is not cancelled: the kernel keeps cancelled ones in its queue until their
// time, and a watchdog that every telegram moves would leave thousands there. For the same reason no notification is
// made for a time far ahead.
void TimedModule::schedule(Tick now, Tick due) {
  constexpr Tick kFarthest = 100'000 * profibus::kTicksPerNs;
  if (due == profibus::kNever) return;
  // Everything of this tick is done; scheduling it again would stop simulation time.
  const Tick at = std::min(std::max(due, now + 1), now + kFarthest);
  if (scheduled_ > now && scheduled_ <= at) return;
  scheduled_ = at;
  scheduled_at_ = to_time(at + zero_);
  due_.notify(scheduled_at_ - sc_core::sc_time_stamp());
}

void TimedModule::begin_again(Tick now) {
  zero_ = current_tick() - now;
  unschedule();
  schedule_now();
}

// ------------------------------------------------------------------------------------------------- save and restore

std::vector<std::uint8_t> SavedModule::save() {
  if (is_in_core()) refuse_to_save("the chip is running");
  if (is_busy()) refuse_to_save("an access is in progress");
  settle();
  profibus::StateWriter writer;
  profibus::begin_frame(writer, kFrame);
  Title its_title = bytes_of(title());
  std::vector<std::uint8_t> core = save_core();
  writer(its_title);
  store_list(writer, core);
  store_module(writer);
  return profibus::end_frame(writer.take());
}

void SavedModule::restore(const std::vector<std::uint8_t>& state) {
  if (!sc_core::sc_start_of_simulation_invoked())
    throw profibus::StateError(std::string(name()) + ": restore after the simulation has started: sc_start(0) will do");
  if (is_busy()) throw profibus::StateError(std::string(name()) + ": not restored, because an access is in progress");
  profibus::StateReader reader = profibus::open_frame(state.data(), state.size(), kFrame);
  Title saved{};
  std::vector<std::uint8_t> core;
  reader(saved);
  profibus::check_title(text_of(saved), title());
  store_list(reader, core);
  restore_core(core);
  begin_again(core_now());
  store_module(reader);
  profibus::check_frame(reader);
}

void SavedModule::refuse_to_save(const std::string& why) const {
  throw profibus::StateError(std::string(name()) + ": not saved, because " + why);
}

void TimedModule::unschedule() {
  scheduled_ = 0;
  scheduled_at_ = sc_core::sc_max_time();
  due_.cancel();
}

template class ListenedPort<profibus::Event>;
template class ListenedPort<AccessReport>;
template class ListenedPort<Tick>;
template class ListenedPort<ModuleEnd>;
template class ListenedPort<std::uint8_t>;

}  // namespace dsdpv1::systemc
