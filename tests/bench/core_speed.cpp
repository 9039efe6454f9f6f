// Measures the speed of the core alone, and its memory. Speeds are simulated time divided by CPU time.
#include <array>
#include <chrono>
#include <cstdlib>
#include <new>

#include "model/dsdpv1/chip.hpp"
#include "tests/bench/programs.hpp"
#include "tests/bench/saturated_bus.hpp"
#include "tests/bench/saturated_spc3.hpp"
#include "tests/bench/stopwatch.hpp"

namespace {

std::size_t allocated = 0;  // by operator new below

using dsdpv1::Chip;
using dsdpv1::speed::Failure;
using dsdpv1::speed::kTicksPerSecond;
using dsdpv1::speed::Stopwatch;
using Bus = dsdpv1::speed::SaturatedBus<Chip>;

using dsdpv1::profibus::Tick;

constexpr Tick kSlice = 12'000'000;  // a millisecond
constexpr double kMeasured = 0.3;    // seconds

/// A chip that gets every change of the line.
struct EdgeChip : Chip {
  static bool hear(Tick /*at*/, const dsdpv1::profibus::CharacterRun& /*run*/) { return false; }
};

template <class Device = Chip, class Bus = dsdpv1::speed::SaturatedBus<Device>,
          class Counter = dsdpv1::speed::PinCounter>
double saturated(int io, double seconds = kMeasured, std::uint32_t watched = Counter::kWatched) {
  Device chip;
  Bus bus(chip, io);
  bus.start();
  Counter counter;
  chip.watch(counter.sink(), watched);
  const Tick begin = bus.now();
  const Stopwatch watch;
  while (watch.seconds() < seconds) bus.exchange_for(kSlice);
  const double taken = watch.seconds();
  if (chip.status().data_exchanges != bus.exchanges()) throw Failure("exchanges were lost");
  if (!counter.has_seen()) throw Failure("nothing was seen at the pins");
  return static_cast<double>(bus.now() - begin) / kTicksPerSecond / taken;
}

double spc3_saturated(int io) {
  return saturated<dsdpv1::spc3::Chip, dsdpv1::speed::SaturatedSpc3, dsdpv1::speed::Spc3PinCounter>(io);
}

/// S1: the windows from 12 Mbit/s down to 9.6 kbit/s, 50 ms or 4000 bit times each.
double search_to_9k6() {
  constexpr Tick kSearch = 1'063 * kSlice;
  constexpr int kTimes = 20;
  double taken = 0;
  for (int i = 0; i < kTimes; ++i) {
    Chip chip;
    Bus bus(chip, 2);
    bus.reset();
    bus.initialise();
    const Stopwatch watch;
    chip.advance(bus.now() + kSearch);
    taken += watch.seconds();
    if (chip.status().baud_index.known()) throw Failure("a baud rate was found on a silent line");
  }
  return kTimes * static_cast<double>(kSearch) / kTicksPerSecond / taken;
}

/// The memory of a chip: it allocates nothing after construction.
double chip_kilobytes() {
  const std::size_t before = allocated;
  const Chip chip;
  return static_cast<double>(sizeof chip + allocated - before) / 1024;
}

/// A measure of the machine, in milliseconds of wall time: work unrelated to the project. Six parallel xorshift64 use
/// more than a core can execute per cycle, which shows whether another thread shares the core; a single one, each step
/// of which waits for the last, takes the same time with such a thread.
double calibration() {
  constexpr int kTurns = 8'000'000;
  const auto begin = std::chrono::steady_clock::now();
  std::array<std::uint64_t, 6> states = {1, 2, 3, 4, 5, 6};
  for (int i = 0; i < kTurns; ++i)
    for (std::uint64_t& state : states) {
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
      // Keeps the compiler from putting two of them into a vector, which would wait as a single one does.
      asm volatile("" : "+r"(state));  // NOLINT(portability-no-assembler)
    }
  for (const std::uint64_t state : states)
    if (state == 0) throw Failure("xorshift has come to 0");  // impossible, but keeps the loop
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void* operator new(std::size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  allocated += size;
  return block;
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

int main(int argc, char** argv) {
  return dsdpv1::speed::run_rows(argc, argv,
                                 {{"core_2", [] { return saturated(2); }},
                                  {"core_16", [] { return saturated(16); }},
                                  {"core_64", [] { return saturated(64); }},
                                  {"core_244", [] { return saturated(244); }},
                                  {"core_spc3_16", [] { return spc3_saturated(16); }},
                                  {"core_pins", [] { return saturated<EdgeChip>(16, kMeasured, dsdpv1::kOutputPins); }},
                                  {"search_9k6", search_to_9k6},
                                  {"chip", chip_kilobytes},
                                  {"calibration", calibration},
                                  {"profile", [] { return saturated(16, 3); }}});
}
