// The core compared with the Verilated reference RTL, and their lockstep with that RTL alone. Both sides of a ratio are
// measured in turns, in CPU time.
#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "cosim/random/campaign.hpp"
#include "cosim/random/play_options.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tests/bench/programs.hpp"
#include "tests/bench/rtl_alone.hpp"
#include "tests/bench/saturated_bus.hpp"
#include "tests/bench/stopwatch.hpp"

namespace dsdpv1 {
namespace {

using profibus::Tick;
using speed::Failure;
using speed::Stopwatch;

constexpr Tick kMillisecond = 12'000'000;
constexpr int kTurns = 5;

// ------------------------------------------------------------------------------------------------------- core and RTL
/// CPU seconds for exchanges of this much simulated time.
template <class Device>
double time_exchanges(speed::SaturatedBus<Device>& bus, Tick duration) {
  const Stopwatch watch;
  bus.exchange_for(duration);
  return watch.seconds();
}

/// Both sides must make the same exchanges and the same changes of L_REQ and PBTXD, or one has not done its work.
double core_vs_rtl() {
  constexpr int kIo = 16;
  constexpr Tick kRtlSlice = 2 * kMillisecond, kCoreSlice = 20 * kMillisecond;
  dsdpv1::Chip chip;
  speed::RtlAlone rtl;
  speed::PinCounter counter;
  chip.watch(counter.sink(), speed::PinCounter::kWatched);
  speed::SaturatedBus<dsdpv1::Chip> core_bus(chip, kIo);
  speed::SaturatedBus<speed::RtlAlone> rtl_bus(rtl, kIo);
  core_bus.start();
  rtl_bus.start();
  const speed::PinCounter after_start = counter;
  if (!(after_start == speed::PinCounter{rtl.line_changes(), rtl.request_changes()}))
    throw Failure("core and RTL differ in the bring-up");
  double core = 0, reference = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    reference += time_exchanges(rtl_bus, kRtlSlice);
    core += time_exchanges(core_bus, kCoreSlice);
  }
  if (chip.status().data_exchanges != core_bus.exchanges()) throw Failure("exchanges were lost");
  const double line_per_exchange =
      static_cast<double>(counter.line - after_start.line) / static_cast<double>(core_bus.exchanges());
  const double of_rtl =
      static_cast<double>(rtl.line_changes() - after_start.line) / static_cast<double>(rtl_bus.exchanges());
  if (line_per_exchange < of_rtl || line_per_exchange > of_rtl) throw Failure("the RTL's answers are not the core's");
  return (reference / kRtlSlice) / (core / kCoreSlice);
}

// ----------------------------------------------------------------------------------------------------------- lockstep
constexpr std::uint64_t kSeed = 1, kCycles = 1'000'000;

using Levels = std::array<Level, dsdpv1::kPinCount>;

/// A recording of one RTL's inputs: a number of evaluations with only the clock changing, then other levels.
struct Recording {
  struct Span {
    bool clk = false;
    Levels levels{};  ///< at the first evaluation
    std::uint64_t evaluations = 0;
  };
  std::vector<Span> spans;
};

/// The RTL with a recording of its inputs.
class RecordingRtl : public cosim::Rtl {
 public:
  RecordingRtl(std::unique_ptr<cosim::Rtl> rtl, Recording& recording) : rtl_(std::move(rtl)), recording_(recording) {}

  void eval(bool clk, Level* levels) override {
    const bool same = std::equal(last_.begin(), last_.end(), levels);  // outputs have the values of the last evaluation
    if (same && clk != clk_ && !recording_.spans.empty()) {
      ++recording_.spans.back().evaluations;
    } else {
      recording_.spans.push_back({clk, {}, 1});
      std::copy_n(levels, last_.size(), recording_.spans.back().levels.begin());
    }
    clk_ = clk;
    rtl_->eval(clk, levels);
    std::copy_n(levels, last_.size(), last_.begin());
  }
  bool memory(std::uint8_t* image) const override { return rtl_->memory(image); }

 private:
  std::unique_ptr<cosim::Rtl> rtl_;
  Recording& recording_;
  bool clk_ = false;
  Levels last_{};
};

std::unique_ptr<cosim::Rtl> make_rtl() { return cosim::reference_top(cosim::quick_options(), 0, kSeed)(); }

/// A case, played as in the campaign of rtl-random.
std::uint64_t play_case(std::uint64_t number, const cosim::MakeTop& make) {
  const cosim::PlayOptions options = cosim::quick_options();
  const cosim::Stimulus stimulus = cosim::random_case(cosim::case_seed(kSeed, number), options);
  const cosim::PlayResult result = cosim::play(stimulus, make, options);
  if (result.difference) throw Failure("model and RTL differ: " + result.difference->what);
  return result.counts.cycles;
}

Recording record_case(std::uint64_t number) {
  Recording recording;
  play_case(number, [&recording] { return std::make_unique<RecordingRtl>(make_rtl(), recording); });
  return recording;
}

void play_alone(const Recording& recording) {
  const std::unique_ptr<cosim::Rtl> rtl = make_rtl();
  for (const Recording::Span& span : recording.spans) {
    Levels levels = span.levels;
    bool clk = span.clk;
    for (std::uint64_t i = 0; i < span.evaluations; ++i, clk = !clk) rtl->eval(clk, levels.data());
  }
}

/// The sides take turns with each case, and the first one alternates.
double lockstep() {
  double alone = 0, together = 0;
  std::uint64_t cycles = 0;
  const auto play_together = [&](std::uint64_t number) {
    const Stopwatch watch;
    cycles += play_case(number, make_rtl);
    together += watch.seconds();
  };
  for (std::uint64_t number = 0; cycles < kCycles; ++number) {
    const Recording recording = record_case(number);
    if (number % 2 == 0) play_together(number);
    const Stopwatch watch;
    play_alone(recording);
    alone += watch.seconds();
    if (number % 2 != 0) play_together(number);
  }
  return 100 * alone / together;
}

}  // namespace
}  // namespace dsdpv1

int main(int argc, char** argv) {
  return dsdpv1::speed::run_rows(argc, argv, {{"core_vs_rtl", dsdpv1::core_vs_rtl}, {"lockstep", dsdpv1::lockstep}});
}
