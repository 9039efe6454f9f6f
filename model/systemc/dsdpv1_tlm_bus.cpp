// The bus side of the TLM module: characters to and from PBRXD and PBTXD, as runs if the pins are not observed.
#include <algorithm>
#include <string>
#include <utility>

#include "model/systemc/dsdpv1_tlm.hpp"

namespace dsdpv1::systemc {

// --- characters to the line ------------------------------------------------------------------------------------------

void TlmModule::write(const BusCharacter& character) {
  const Tick bit = to_tick(character.bit);
  if (!line_.is_sendable(character)) return;
  const Tick before = next_of_line();
  put_on_line(character, bit);
  if (next_of_line() != before) plan();  // else it belongs to a telegram already planned
}

void TlmModule::put_on_line(const BusCharacter& character, Tick bit) {
  const Tick start = line_.tick_of_bit(character, 0);
  if (line_.collides(character)) take_back_last_run();
  if (!put_in_run(character, start, bit)) line_.put(character);
}

/// A valid character whose bits are whole cycles extends the run before it, or begins one. Accumulated rounded times
/// are some femtoseconds off the ticks; if the nearest tick is right at both ends, it is right in between.
bool TlmModule::put_in_run(const BusCharacter& character, Tick start, Tick bit) {
  const bool exact =
      line_.tick_of_bit(character, profibus::kBitsPerCharacter) == start + profibus::kBitsPerCharacter * bit &&
      bit % profibus::kTicksPerCycle == 0;
  if (!tells_runs() || !exact || !character.parity_ok || !character.stop_ok || start < line_.busy_until) return false;
  if (runs_.empty() || runs_.back().end() != start || runs_.back().bit != bit) runs_.push_back({start, bit, {}});
  runs_.back().bytes.push_back(character.data);
  line_.busy_until = runs_.back().end();
  return true;
}

/// Converts the last run on the line back to changes, because something interrupts it.
void TlmModule::take_back_last_run() {
  if (!runs_.empty() && runs_.back().end() == line_.busy_until) {
    spell_out(runs_.back(), 0);
    runs_.pop_back();
  } else if (run_is_own_ && run_.end() == line_.busy_until) {
    stop_run(chip_now());
  }
}

// --- the line to the core --------------------------------------------------------------------------------------------

void TlmModule::apply_line(Tick now) {
  const auto take_edges = [&] {
    while (line_.edges.next() <= now) characters_level_ = line_.edges.take().level;
    if (in_run(now) && line_level()) return;
    if (in_run(now)) stop_run(now);
    set(now, Pin::kPbrxd, line_level());
  };
  take_edges();
  if (runs_.empty() || runs_.front().start > now) return;
  begin_run(now);
  take_edges();
}

void TlmModule::begin_run(Tick now) {
  run_ = std::move(runs_.front());
  runs_.pop_front();
  const bool idle = !in_run(now) && chip().level(Pin::kPbrxd) == 1;
  run_is_own_ = idle && run_.start == now && core_hears(now, run_.told());
  if (run_is_own_)
    run_end_ = run_.end();
  else
    spell_out(run_, now - 1);
}

/// Changes of a run that come later.
void TlmModule::spell_out(const LineRun& run, Tick behind) {
  bool level = true;
  for (std::size_t i = 0; i < run.bytes.size(); ++i) {
    const unsigned frame = profibus::frame_of(run.bytes[i]);
    for (int bit = 0; bit < profibus::kBitsPerCharacter; ++bit) {
      const bool before = std::exchange(level, ((frame >> bit) & 1U) != 0);
      const Tick at = run.character(i) + bit * run.bit;
      if (level != before && at > behind) line_.edges.insert({at, level});
    }
  }
}

/// The core receives changes again from `now` on; later ones of a run of `bus_in` are queued.
void TlmModule::stop_run(Tick now) {
  core_leaves_run(now);
  if (!in_run(now)) return;
  run_end_ = now;
  if (!run_is_own_) {
    if (on_left_run) on_left_run(now);
    return;
  }
  characters_level_ = chip().level(Pin::kPbrxd) != 0;
  spell_out(run_, now);
}

void TlmModule::set_line(bool level) {
  far_level_ = level;
  schedule_now();
}

bool TlmModule::hear_run(const profibus::CharacterRun& run) {
  catch_up();
  const Tick now = chip_now();
  const bool hears = tells_runs() && !in_run(now) && chip().level(Pin::kPbrxd) == 1 && core_hears(now, run);
  if (hears) {
    run_is_own_ = false;
    run_end_ = now + static_cast<Tick>(run.size) * profibus::kBitsPerCharacter * run.bit * profibus::kTicksPerCycle;
  }
  plan();
  return hears;
}

void TlmModule::leave_run() {
  catch_up();
  const Tick now = chip_now();
  if (in_run(now) && !run_is_own_) {
    core_leaves_run(now);
    run_end_ = now;
  }
  plan();
}

// --- characters of the chip ------------------------------------------------------------------------------------------

bool TlmModule::output_changed(Tick at, Pin pin, Level level) {
  others_changed();
  if (pin == Pin::kPbrts && level == 0) {
    end_answer(at);
    txd_changed(at, true);  // RESET ends both
  }
  if (pin == Pin::kPbrts && on_rts) tell([&] { on_rts(at, level != 0); });
  if (pin == Pin::kPbrts) return ((bound_ | observed_ | observed_by_ports()) & mask(pin)) != 0;
  if (may_hide_ && chip().begins_to_send()) {
    answer_waits_ = true;  // until the core is idle
    return false;
  }
  txd_changed(at, level != 0);
  if (on_txd) tell([&] { on_txd(at, level != 0); });
  return true;
}

void TlmModule::txd_changed(Tick at, bool level) {
  collect_character(at);
  from_chip_.edge(at, level, bit_time_of(chip().status().baud_index));
}

void TlmModule::collect_character(Tick now) {
  if (now < std::min(from_chip_.next(), next_answered())) return;
  if (const auto character = from_chip_.take(now)) complete_.push_back(*character);
  for (; next_answered() <= now; ++answered_)
    complete_.push_back({answer_.character(answered_), answer_.bit, answer_.bytes[answered_], true, true});
}

void TlmModule::tell_characters(Tick now) {
  collect_character(now);
  if (complete_.empty()) return;
  while (emitted_ < complete_.size())  // a listener may call back and continue here
    bus_out.write(on_bus(complete_[emitted_++], zero()));
  complete_.clear();
  emitted_ = 0;
}

// --- answers as runs -------------------------------------------------------------------------------------------------

/// The end of a character of the answer, which is then sent if bus_out is bound.
Tick TlmModule::next_answered() const {
  const bool more = bus_out.bound() && answered_ < answer_.bytes.size();
  return more ? answer_.character(answered_ + 1) : profibus::kNever;
}

/// PBTXD has fallen, not reported yet.
void TlmModule::offer_answer() {
  if (!std::exchange(answer_waits_, false)) return;
  const profibus::CharacterRun run = hide_core_txd();
  if (on_answer && !on_answer(run)) {
    show_core_txd(run.start);
    if (on_pin && (observed_ & mask(Pin::kPbtxd)) != 0) on_pin(run.start, Pin::kPbtxd, 0);
    in_core([&] { tell_ports(run.start, Pin::kPbtxd, 0); });
    txd_changed(run.start, false);
    if (on_txd) on_txd(run.start, false);
    return;
  }
  answer_.start = run.start;
  answer_.bit = run.bit * profibus::kTicksPerCycle;
  answer_.bytes.assign(run.bytes, run.bytes + run.size);
  answered_ = 0;
}

/// PBTXD is reported again, or rises for good, maybe in the middle of a character: emits the part already on the line.
void TlmModule::end_answer(Tick at) {
  collect_character(at);
  if (answered_ < answer_.bytes.size() && bus_out.bound()) {
    const unsigned frame = profibus::frame_of(answer_.bytes[answered_]);
    for (int bit = 0; bit < profibus::kBitsPerCharacter; ++bit)
      if (const Tick edge = answer_.character(answered_) + bit * answer_.bit; edge <= at)
        from_chip_.edge(edge, ((frame >> bit) & 1U) != 0, answer_.bit);
  }
  answer_.bytes.clear();
  answered_ = 0;
}

void TlmModule::show_txd() {
  catch_up();
  show_core_txd(chip_now());
  end_answer(chip_now());
  plan();
}

}  // namespace dsdpv1::systemc
