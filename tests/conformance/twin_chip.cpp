#include "tests/conformance/twin_chip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "model/profibus/addressee.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::conformance {
namespace {

dsdpv1::Config with_engine(dsdpv1::Config config, dsdpv1::Engine engine) {
  config.engine = engine;
  return config;
}

std::string words(const PinChange& change) {
  return std::string(dsdpv1::name(change.pin)) + "=" + std::to_string(change.level) + " at tick " +
         std::to_string(change.at) + " (cycle " + std::to_string(change.at / profibus::kTicksPerCycle) + ")";
}

std::string words(const profibus::Event& event) {
  return std::string(profibus::code(event.reason)) + " at tick " + std::to_string(event.at) + ": " +
         dsdpv1::describe(event);
}

bool same(const PinChange& a, const PinChange& b) { return a == b; }
bool same(const profibus::Event& a, const profibus::Event& b) {
  return a.at == b.at && a.reason == b.reason && a.a == b.a && a.b == b.b && a.c == b.c;
}

template <typename T>
void compare_lists(const std::vector<T>& skip, const std::vector<T>& other, std::size_t& compared, const char* name) {
  for (; compared < skip.size() && compared < other.size(); ++compared) {
    ASSERT_TRUE(same(skip[compared], other[compared])) << "skip: " << words(skip[compared]) << "\n"
                                                       << name << ": " << words(other[compared]);
  }
  ASSERT_EQ(skip.size(), other.size()) << "skip or " << name << " did more, first: "
                                       << words(skip.size() > other.size() ? skip[compared] : other[compared]);
}

constexpr unsigned kEachWay = 16;  // comparisons
constexpr std::uint32_t kAccessPins = mask(Pin::kLReq) | mask(Pin::kLSta);

unsigned restored_every(unsigned usual) {
  const char* const given = std::getenv("DSDPV1_RESTORED_EVERY");
  return given == nullptr ? usual : static_cast<unsigned>(std::max(1L, std::strtol(given, nullptr, 10)));
}

/// The chip continues from its saved state, and saves the same state again.
void save_and_restore(dsdpv1::Chip& chip) {
  const std::vector<std::uint8_t> state = chip.save();
  chip.restore(state.data(), state.size());
  ASSERT_TRUE(chip.save() == state) << "at tick " << chip.now();
}

}  // namespace

Restorer::Restorer(unsigned usual) : every_(restored_every(usual)) {}

void Restorer::compared(std::initializer_list<dsdpv1::Chip*> twins) {
  if (++comparisons_ % every_ == 0) save_and_restore(**(twins.begin() + comparisons_ / every_ % twins.size()));
}

TwinChip::TwinChip(bus::Segment& segment, dsdpv1::Config config, Engines engines)
    : segment_(segment),
      station_(segment.attach("chip", this)),
      twin_(engines == Engines::kStepAndSkip),
      outputs_(outputs_of(config.part)),
      skip_(with_engine(config, dsdpv1::Engine::kSkip)),
      step_(with_engine(config, dsdpv1::Engine::kStep)),
      doze_(with_engine(config, dsdpv1::Engine::kSkip)),
      rtl_(twin_ ? RtlTwin::make(config) : nullptr) {
  skip_.watch({&on_skip_pin, this}, twin_ ? outputs_of(config.part) : mask(Pin::kPbtxd) | mask(Pin::kPbrts));
  step_.watch({&on_step_pin, this}, outputs_of(config.part));
  watch_doze(false);
  skip_.on_event({&on_skip_event, this});
  step_.on_event({&on_step_event, this});
  doze_.on_event({&on_doze_event, this});
  if (twin_) doze_station_ = segment.attach("doze", &ear_);
}

/// Compares the rest after the last comparison, which ends before its tick: for tests that end with an answer.
TwinChip::~TwinChip() {
  constexpr Tick kAfterwards = 100 * profibus::kTicksPerCycle;
  if (rtl_) rtl_->compare(skip_.now() + kAfterwards);
}

void TwinChip::set(Tick at, Pin pin, Level level) {
  announce();
  skip_.set(at, pin, level);
  if (!twin_) return;
  step_.set(at, pin, level);
  if (rtl_) rtl_->set(at, pin, level);
  doze().set(at, pin, level);
  leave_run_with_doze(at);
}

void TwinChip::line_changed(Tick at, bool level) {
  const Level value = level ? 1 : 0;
  announce();
  skip_.set(at, Pin::kPbrxd, value);
  if (!twin_) return;
  step_.set(at, Pin::kPbrxd, value);
  if (rtl_) rtl_->set(at, Pin::kPbrxd, value);
}

void TwinChip::Ear::line_changed(Tick at, bool level) {
  const profibus::Unheard may_wait = twin_.doze_.unheard();
  if (at >= may_wait.from && at < may_wait.until)
    twin_.unheard_.push_back({at, level});
  else
    twin_.doze().set(at, Pin::kPbrxd, level ? 1 : 0);
}

bool TwinChip::Ear::run_begins(const bus::CharacterRun& run) {
  const bool taken = twin_.doze().hear(
      run.start, {run.start, run.bit / profibus::kTicksPerCycle, run.bytes, static_cast<int>(run.size)});
  twin_.filter_for_doze();
  return taken;
}

void TwinChip::filter_for_doze() {
  const profibus::Unconcerned unconcerned = doze_.unconcerned();
  segment_.set_filter(doze_station_, {&profibus::addressee, unconcerned.from,
                                      unconcerned.bit * profibus::kTicksPerCycle, unconcerned.address});
}

void TwinChip::leave_run_with_doze(Tick at) {
  if (!doze_.left_run()) return;
  segment_.cut_run(at);
  doze_.leave_run(at);
}

/// With the line's pending changes; it receives all changes until filter_for_doze().
dsdpv1::Chip& TwinChip::doze() {
  segment_.hear(doze_station_);
  segment_.set_filter(doze_station_, {});
  for (const Unheard& change : unheard_) doze_.hear(change.at, change.level);
  unheard_.clear();
  return doze_;
}

Level TwinChip::sample(Tick at) {
  announce();
  const Level level = skip_.sample(at);
  if (twin_) EXPECT_EQ(step_.sample(at), level) << "at tick " << at;
  if (twin_) EXPECT_EQ(doze().sample(at), level) << "at tick " << at;
  return level;
}

void TwinChip::run(Tick now) {
  skip_.advance(now);
  if (!twin_ || doze_.next_event() > now) return;  // it sleeps longer than the others, and receives less
  doze().advance(now);
  leave_run_with_doze(now);
  filter_for_doze();
}

void TwinChip::compare(Tick at) {
  announce();
  skip_.advance(at);
  if (!twin_) return;
  step_.advance(at);
  if (rtl_) rtl_->compare(at);
  doze().advance(at);
  leave_run_with_doze(at);
  compare_lists(trace_, step_trace_, compared_pins_, "step");
  compare_lists(events_, step_events_, compared_events_, "step");
  compare_lists(unwatched_trace_, doze_trace_, compared_doze_pins_, "doze");
  compare_lists(events_, doze_events_, compared_doze_events_, "doze");
  compare_state();
  compare_late();
  if (++comparisons_ % kEachWay == 0) watch_doze(!late_);
  restorer_.compared({&skip_, &step_, &doze_});
  filter_for_doze();
}

// To look at the dozing chip must not wake it, and what it made up must be what the others did.
void TwinChip::compare_state() const {
  for (const Pin pin : {Pin::kLReq, Pin::kLSta}) ASSERT_EQ(doze_.level(pin), step_.level(pin)) << dsdpv1::name(pin);
  ASSERT_EQ(doze_.status().accesses, step_.status().accesses);
  ASSERT_EQ(doze_.status().telegrams_received, step_.status().telegrams_received);
  ASSERT_EQ(doze_.peek(dsdpv1::regs::kAccessCount), step_.peek(dsdpv1::regs::kAccessCount));
}

void TwinChip::watch_doze(bool late) {
  late_ = late;
  late_since_ = doze_.now();
  doze_.watch({&on_doze_pin, this}, late ? outputs_ : outputs_ & ~kAccessPins, late);
}

// It may leave out changes of L_REQ and L_STA, but invents none, and knows the last ones when it is asked.
void TwinChip::compare_late() {
  const auto is_access = [](const PinChange& change) { return (mask(change.pin) & kAccessPins) != 0; };
  for (; compared_late_ < late_trace_.size(); ++compared_late_) {
    const PinChange& change = late_trace_[compared_late_];
    while (late_place_ < trace_.size() && !(trace_[late_place_] == change)) ++late_place_;
    ASSERT_LT(late_place_, trace_.size()) << "late: " << words(change);
  }
  const auto last = std::find_if(trace_.rbegin(), trace_.rend(), is_access);
  if (late_ && last != trace_.rend() && last->at > late_since_) {
    ASSERT_FALSE(late_trace_.empty()) << "late: without " << words(*last);
    ASSERT_TRUE(late_trace_.back() == *last) << words(late_trace_.back()) << " instead of " << words(*last);
  }
}

void TwinChip::on_skip_pin(void* self, Tick at, Pin pin, Level level) {
  auto& twin = *static_cast<TwinChip*>(self);
  if (twin.twin_) twin.trace_.push_back({at, pin, level});
  if (twin.twin_ && (mask(pin) & kAccessPins) == 0) twin.unwatched_trace_.push_back({at, pin, level});
  if (pin != Pin::kPbtxd && pin != Pin::kPbrts) return;
  twin.segment_.drive(twin.station_, at, twin.skip_.level(Pin::kPbrts) != 0, twin.skip_.level(Pin::kPbtxd) != 0);
}

void TwinChip::on_step_pin(void* self, Tick at, Pin pin, Level level) {
  static_cast<TwinChip*>(self)->step_trace_.push_back({at, pin, level});
}

void TwinChip::on_doze_pin(void* self, Tick at, Pin pin, Level level) {
  auto& twin = *static_cast<TwinChip*>(self);
  const bool access = (mask(pin) & kAccessPins) != 0;
  EXPECT_GE(at, std::exchange(twin.doze_told_, at)) << dsdpv1::name(pin);
  (access ? twin.late_trace_ : twin.doze_trace_).push_back({at, pin, level});
}

void TwinChip::on_doze_event(void* self, const profibus::Event& event) {
  auto& twin = *static_cast<TwinChip*>(self);
  twin.doze_events_.push_back(event);
  twin.doze_.status();  // to ask in the middle of something disturbs nothing
  twin.doze_.level(Pin::kLReq);
}

void TwinChip::on_skip_event(void* self, const profibus::Event& event) {
  static_cast<TwinChip*>(self)->events_.push_back(event);
}

void TwinChip::on_step_event(void* self, const profibus::Event& event) {
  static_cast<TwinChip*>(self)->step_events_.push_back(event);
}

}  // namespace dsdpv1::conformance
