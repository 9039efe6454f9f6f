#include "tests/state/life.hpp"

#include <algorithm>
#include <sstream>

namespace dsdpv1::state_test {
namespace {

using profibus::Event;

constexpr std::uint32_t kAccessPins = mask(Pin::kLReq) | mask(Pin::kLSta);

bool same(const Event& a, const Event& b) {
  return a.at == b.at && a.reason == b.reason && a.a == b.a && a.b == b.b && a.c == b.c;
}

}  // namespace

const char* words(Way way) { return way == Way::kSkip ? "Skip" : way == Way::kDoze ? "Doze" : "Step"; }

bool operator==(const Heard& a, const Heard& b) {
  return a.pins == b.pins && std::equal(a.events.begin(), a.events.end(), b.events.begin(), b.events.end(), same);
}

std::unique_ptr<Chip> make_chip(Config config, Way way, Heard& heard) {
  config.engine = way == Way::kStep ? Engine::kStep : Engine::kSkip;
  auto chip = std::make_unique<Chip>(config);
  const auto on_pin = [](void* self, Tick at, Pin pin, Level level) {
    static_cast<Heard*>(self)->pins.push_back({at, pin, level});
  };
  const auto on_event = [](void* self, const Event& event) { static_cast<Heard*>(self)->events.push_back(event); };
  chip->watch({on_pin, &heard}, outputs_of(config.part) & (way == Way::kDoze ? ~kAccessPins : ~0U));
  chip->on_event({on_event, &heard});
  return chip;
}

std::string asked(const Chip& chip, const Config& config, Way way) {
  const Status status = chip.status();
  std::ostringstream out;
  out << status.telegrams_received << ' ' << status.telegrams_answered << ' ' << status.data_exchanges << ' '
      << status.outputs_missed << ' ' << status.accesses << ' ' << status.longest_wait << ' ' << +status.address << ' '
      << +status.master;
  for (int pin = 0; pin < pin_count(config.part); ++pin) out << ' ' << chip.level(static_cast<Pin>(pin));
  const profibus::Unconcerned unconcerned = chip.unconcerned();
  out << ' ' << unconcerned.from << ' ' << unconcerned.bit << ' ' << +unconcerned.address << ' ' << chip.left_run();
  if (way != Way::kStep) return out.str();
  const dpram::Inside access = chip.inside().access;
  out << ' ' << access.item << ' ' << access.moves << ' ' << access.address << ' ' << +access.byte << ' '
      << access.writes << ' ' << access.crc_of << ' ' << access.crc_right;
  return out.str();
}

void play(Chip& chip, const Recorded& slave, std::size_t from, Tick until) {
  for (; from < slave.inputs.size() && slave.inputs[from].at <= until; ++from)
    chip.set(slave.inputs[from].at, slave.inputs[from].pin, slave.inputs[from].level);
  chip.advance(until);
}

}  // namespace dsdpv1::state_test
