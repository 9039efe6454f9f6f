// The chip through the C API compared with the core, on the stimulus of core_16: both in turns, in CPU time.
#include <array>

#include "dsdpv1/dsdpv1.h"
#include "model/dsdpv1/chip.hpp"
#include "tests/bench/programs.hpp"
#include "tests/bench/saturated_bus.hpp"
#include "tests/bench/stopwatch.hpp"

namespace dsdpv1 {
namespace {

using profibus::Tick;
using speed::Failure;
using speed::Stopwatch;

constexpr Tick kMillisecond = 12'000'000;
constexpr int kIo = 16, kTurns = 150;

/// The core; its requests are passed as runs of characters or as edges.
class Core {
 public:
  explicit Core(bool receives) : receives_(receives) { chip_.watch(counter.sink(), speed::PinCounter::kWatched); }
  void set(Tick at, Pin pin, Level level) { chip_.set(at, pin, level); }
  bool hear(Tick at, const profibus::CharacterRun& run) { return receives_ && chip_.hear(at, run); }
  void advance(Tick to) { chip_.advance(to); }
  Level level(Pin pin) const { return chip_.level(pin); }
  std::uint64_t exchanges() const { return chip_.status().data_exchanges; }

  speed::PinCounter counter;

 private:
  bool receives_;
  dsdpv1::Chip chip_;
};

/// The parts of the C API in use.
struct Use {
  bool receives = true;  ///< requests are passed by dpsim_chip_receive, else one call per edge
  bool keeps = false;    ///< all pin changes are kept and taken after each advance; else PinCounter counts
};

/// The same through the C API.
class Capi {
 public:
  explicit Capi(const Use& use) : use_(use) {
    check(dpsim_chip_create(nullptr, &chip_));
    check(use.keeps ? dpsim_chip_watch(chip_, DPSIM_ALL_PINS, nullptr, nullptr)
                    : dpsim_chip_watch(chip_, speed::PinCounter::kWatched, count, this));
  }
  ~Capi() { dpsim_chip_destroy(chip_); }
  Capi(const Capi&) = delete;
  Capi& operator=(const Capi&) = delete;

  void set(Tick at, Pin pin, Level level) {
    check(dpsim_chip_set(chip_, static_cast<std::uint64_t>(at), static_cast<std::uint16_t>(pin), level));
  }
  bool hear(Tick at, const profibus::CharacterRun& run) {
    if (!use_.receives) return false;
    check(dpsim_chip_receive(chip_, static_cast<std::uint64_t>(at),
                             static_cast<std::uint32_t>(run.bit * profibus::kTicksPerCycle), run.bytes,
                             static_cast<std::size_t>(run.size), nullptr));
    return true;
  }
  void advance(Tick to) {
    check(dpsim_chip_advance(chip_, static_cast<std::uint64_t>(to)));
    if (use_.keeps) take();
  }
  Level level(Pin pin) const {
    Level level = 0;
    check(dpsim_chip_level(chip_, static_cast<std::uint16_t>(pin), &level));
    return level;
  }
  std::uint64_t exchanges() const {
    dpsim_chip_status status{};
    status.size = sizeof status;
    check(dpsim_chip_get_status(chip_, &status));
    return status.data_exchanges;
  }

  speed::PinCounter counter;
  std::uint64_t taken = 0;  ///< changes

 private:
  static void check(dpsim_status status) {
    if (status != DPSIM_OK) throw Failure(dpsim_error_message());
  }
  static void count(void* self, const dpsim_change* change) {
    static_cast<Capi*>(self)->counter.count(static_cast<Pin>(change->pin));
  }
  void take() {
    std::size_t count = buffer_.size();
    while (count == buffer_.size()) {
      check(dpsim_chip_read_changes(chip_, buffer_.data(), buffer_.size(), &count));
      taken += count;
    }
  }

  dpsim_chip* chip_ = nullptr;
  Use use_;
  std::array<dpsim_change, 4096> buffer_{};
};

template <class Device>
double time_exchanges(speed::SaturatedBus<Device>& bus) {
  const Stopwatch watch;
  bus.exchange_for(20 * kMillisecond);
  return watch.seconds();
}

/// The speed of the chip through the C API as a share of the core's.
double share_of_core(bool receives) {
  Core core(receives);
  Capi capi({receives, false});
  speed::SaturatedBus<Core> core_bus(core, kIo);
  speed::SaturatedBus<Capi> capi_bus(capi, kIo);
  core_bus.start();
  capi_bus.start();
  double of_core = 0, of_capi = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    of_core += time_exchanges(core_bus);
    of_capi += time_exchanges(capi_bus);
  }
  if (capi.exchanges() != capi_bus.exchanges()) throw Failure("exchanges were lost");
  if (!(core.counter == capi.counter)) throw Failure("core and C API have not changed the same pins");
  return 100 * of_core / of_capi;
}

/// Millions of changes of all pins per second that reach the caller's buffer.
double changes_a_second() {
  Capi capi({true, true});
  speed::SaturatedBus<Capi> bus(capi, kIo);
  bus.start();
  const std::uint64_t before = capi.taken;
  double taken = 0;
  for (int turn = 0; turn < kTurns; ++turn) taken += time_exchanges(bus);
  return static_cast<double>(capi.taken - before) / taken / 1e6;
}

}  // namespace
}  // namespace dsdpv1

int main(int argc, char** argv) {
  return dsdpv1::speed::run_rows(argc, argv,
                                 {{"c_api", [] { return dsdpv1::share_of_core(true); }},
                                  {"c_api_edges", [] { return dsdpv1::share_of_core(false); }},
                                  {"c_api_changes", dsdpv1::changes_a_second}});
}
