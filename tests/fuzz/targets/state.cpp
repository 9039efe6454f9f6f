// Damaged saved states of chips: either refused, with the chip unchanged, or accepted; then step and skip continue from
// it without a fault. Undamaged, both do the same as the uninterrupted chip.
#include <memory>

#include "model/dsdpv1/chip_state.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/state/recorded.hpp"

namespace dsdpv1 {
namespace {

using state_test::Input;
using state_test::Recorded;
using State = std::vector<std::uint8_t>;

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr std::size_t kHead = 20;  ///< magic, version, size, checksum

/// The chip's reports. Time never decreases, and no pin has an impossible level.
struct Heard {
  std::vector<Input> pins;
  Tick last = 0;

  void add(Tick at, Pin pin, Level level) {
    fuzz::promise(at >= last, "time never decreases");
    fuzz::promise(level >= kLevelX && level <= kHighestLevel, "a level is one");
    last = at;
    pins.push_back({at, pin, level});
  }
  static void call(void* self, Tick at, Pin pin, Level level) { static_cast<Heard*>(self)->add(at, pin, level); }
};

/// A moment of a scenario: the state saved there, the inputs after it, and their results.
struct Moment {
  Config config;
  State state;
  std::vector<Input> inputs;
  Tick at, end;
  std::vector<Input> pins;
};

constexpr Tick kGoesOn = 4'000 * kCycle;

void play(Chip& chip, const std::vector<Input>& inputs, Tick until) {
  for (const Input& each : inputs) chip.set(each.at, each.pin, each.level);
  chip.advance(until);
}

Moment moment_of(const Recorded& slave, Tick at) {
  Moment moment{slave.config, {}, {}, at, at + kGoesOn, {}};
  std::vector<Input> before;
  for (const Input& each : slave.inputs) {
    if (each.at <= at) before.push_back(each);
    if (each.at > at && each.at <= moment.end) moment.inputs.push_back(each);
  }
  Chip chip(slave.config);
  play(chip, before, at);
  moment.state = chip.save();
  Heard heard;
  chip.watch({&Heard::call, &heard}, outputs_of(slave.config.part));
  play(chip, moment.inputs, moment.end);
  moment.pins = heard.pins;
  return moment;
}

/// Short scenarios over each host port, at inputs from begin to end.
const std::vector<Moment>& moments() {
  static const std::vector<Moment> all = [] {
    constexpr std::size_t kOfEach = 12;
    std::vector<Moment> made;
    for (const char* name : {"bus_timing", "violations", "rsu_spi_telegrams", "rsu_uart_1m8432"}) {
      const Recorded slave = state_test::recorded(name).at(0);
      for (std::size_t i = 1; i <= kOfEach; ++i) {
        const Input& near = slave.inputs.at(slave.inputs.size() * i / (kOfEach + 1));
        made.push_back(moment_of(slave, near.at + static_cast<Tick>(i) * 137));
      }
    }
    return made;
  }();
  return all;
}

std::unique_ptr<Chip> restored(const Moment& moment, Engine engine, const State& state, Heard& heard) {
  Config config = moment.config;
  config.engine = engine;
  auto chip = std::make_unique<Chip>(config);
  chip->watch({&Heard::call, &heard}, outputs_of(config.part));
  chip->set(1000, Pin::kReset, 1);
  const State before = chip->save();
  try {
    chip->restore(state.data(), state.size());
  } catch (const StateError& error) {
    const std::string why = error.what();
    fuzz::promise(!why.empty() && why.find('\n') == std::string::npos, "a refusal is one line");
    fuzz::promise(chip->save() == before, "a refusal changes nothing");
    return nullptr;
  }
  return chip;
}

/// Replaces bytes of the state. Returns true if they differ.
bool damage(State& state, fuzz::Input& input) {
  const State whole = state;
  for (int count = static_cast<int>(input.below(8)); count > 0 && !input.empty(); --count) {
    const std::size_t at = kHead + input.number(2) % (state.size() - kHead);
    std::size_t width = std::size_t{1} << input.below(4);
    for (std::size_t i = 0; i < width && at + i < state.size(); ++i) state[at + i] = input.byte();
  }
  return state != whole;
}

void go_on(const Moment& moment, const State& state, bool damaged) {
  for (const Engine engine : {Engine::kSkip, Engine::kStep}) {
    Heard heard;
    const auto chip = restored(moment, engine, state, heard);
    if (!chip) {
      fuzz::promise(damaged, "what was saved can be restored");
      continue;
    }
    if (damaged && (chip->now() > moment.at || chip->now() + kGoesOn < moment.at)) continue;  // step would take long
    play(*chip, moment.inputs, moment.end);
    fuzz::promise(damaged || heard.pins == moment.pins, "a restored chip does what the other one did");
    chip->status();
    chip->save();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const Moment& moment = moments()[input.below(moments().size())];
  State state = moment.state;
  const std::uint8_t how = input.byte();
  const bool damaged = damage(state, input);
  Heard heard;
  if (how % 8 == 0) {  // the checksum is the first one
    if (input.byte() % 2 == 0) state.resize(input.number(2) % (state.size() + 100));
    if (state != moment.state)
      fuzz::promise(restored(moment, Engine::kSkip, state, heard) == nullptr, "a cut or damaged state is refused");
    return 0;
  }
  go_on(moment, profibus::end_frame(std::move(state)), damaged);
  return 0;
}

}  // namespace dsdpv1
