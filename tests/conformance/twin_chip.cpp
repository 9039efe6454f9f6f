#include "tests/conformance/twin_chip.hpp"

#include <gtest/gtest.h>

namespace conformance {
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
void compare_lists(const std::vector<T>& skip, const std::vector<T>& step, std::size_t& compared) {
  for (; compared < skip.size() && compared < step.size(); ++compared) {
    ASSERT_TRUE(same(skip[compared], step[compared]))
        << "skip: " << words(skip[compared]) << "\nstep: " << words(step[compared]);
  }
  ASSERT_EQ(skip.size(), step.size()) << "one engine did more, first: "
                                      << words(skip.size() > step.size() ? skip[compared] : step[compared]);
}

}  // namespace

TwinChip::TwinChip(bus::Segment& segment, dsdpv1::Config config, Engines engines)
    : segment_(segment),
      station_(segment.attach("chip", this)),
      twin_(engines == Engines::kStepAndSkip),
      skip_(with_engine(config, dsdpv1::Engine::kSkip)),
      step_(with_engine(config, dsdpv1::Engine::kStep)) {
  skip_.watch({&on_skip_pin, this}, twin_ ? dsdpv1::kOutputPins : mask(Pin::kPbtxd) | mask(Pin::kPbrts));
  step_.watch({&on_step_pin, this}, dsdpv1::kOutputPins);
  skip_.on_event({&on_skip_event, this});
  step_.on_event({&on_step_event, this});
}

void TwinChip::set(Tick at, Pin pin, Level level) {
  announce();
  skip_.set(at, pin, level);
  if (twin_) step_.set(at, pin, level);
}

Level TwinChip::sample(Tick at) {
  announce();
  const Level level = skip_.sample(at);
  if (twin_) EXPECT_EQ(step_.sample(at), level) << "at tick " << at;
  return level;
}

void TwinChip::run(Tick now) { skip_.advance(now); }

void TwinChip::compare(Tick at) {
  announce();
  skip_.advance(at);
  if (!twin_) return;
  step_.advance(at);
  compare_lists(trace_, step_trace_, compared_pins_);
  compare_lists(events_, step_events_, compared_events_);
}

void TwinChip::on_skip_pin(void* self, Tick at, Pin pin, Level level) {
  auto& twin = *static_cast<TwinChip*>(self);
  if (twin.twin_) twin.trace_.push_back({at, pin, level});
  if (pin != Pin::kPbtxd && pin != Pin::kPbrts) return;
  twin.segment_.drive(twin.station_, at, twin.skip_.level(Pin::kPbrts) != 0, twin.skip_.level(Pin::kPbtxd) != 0);
}

void TwinChip::on_step_pin(void* self, Tick at, Pin pin, Level level) {
  static_cast<TwinChip*>(self)->step_trace_.push_back({at, pin, level});
}

void TwinChip::on_skip_event(void* self, const profibus::Event& event) {
  static_cast<TwinChip*>(self)->events_.push_back(event);
}

void TwinChip::on_step_event(void* self, const profibus::Event& event) {
  static_cast<TwinChip*>(self)->step_events_.push_back(event);
}

}  // namespace conformance
