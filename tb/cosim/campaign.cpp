#include "tb/cosim/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tb/cosim/random_setup.hpp"
#include "tb/cosim/random_stimulus.hpp"
#include "tb/cosim/reference_rtl.hpp"
#include "tb/scenario/input_error.hpp"

namespace cosim {
namespace {

// No case needs longer; the slow rates would make some last for minutes.
constexpr Tick kLongestCase = 2'500'000 * profibus::kTicksPerCycle;

PlayOptions quick_options() {
  PlayOptions options;
  options.config = quick_config();
  options.limit = kLongestCase;
  return options;
}

void add(MatchCounts& sum, const MatchCounts& one) {
  sum.cycles += one.cycles;
  sum.pin_changes += one.pin_changes;
  sum.dpram_images += one.dpram_images;
}

}  // namespace

std::uint64_t case_seed(std::uint64_t campaign, std::uint64_t number) {
  // splitmix64: neighbouring numbers give unrelated seeds.
  std::uint64_t z = campaign * 0x9E3779B97F4A7C15ULL + number + 1;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ z >> 27) * 0x94D049BB133111EBULL;
  return z ^ z >> 31;
}

CampaignResult run_campaign(std::uint64_t seed, std::uint64_t cycles, const MakeTop& make,
                            const std::function<void(const CampaignResult&)>& progress) {
  CampaignResult result;
  const PlayOptions options = quick_options();
  while (result.counts.cycles < cycles && !result.difference) {
    const std::uint64_t number = case_seed(seed, result.cases++);
    const PlayResult played = play(random_stimulus(number), make, options);
    add(result.counts, played.counts);
    result.difference = played.difference;
    result.failed_seed = number;
    if (progress) progress(result);
  }
  return result;
}

// --- shrinking ----------------------------------------------------------------------------------------------------------

namespace {

class Shrinker {
 public:
  Shrinker(Stimulus stimulus, const MakeTop& make, int runs)
      : best_(std::move(stimulus)), make_(make), options_(quick_options()), runs_(runs) {
    cut_behind_difference();
  }

  Stimulus run() {
    for (bool shorter = true; shorter && runs_ > 0;) shorter = leave_out();
    simplify();
    return std::move(best_);
  }

 private:
  void cut_behind_difference() {
    const PlayResult result = play(best_, make_, options_);
    if (!result.difference) return;
    Stimulus cut(best_.begin(),
                 best_.begin() + static_cast<std::ptrdiff_t>(std::min(result.actions_begun, best_.size())));
    try_it(cut);
    options_.limit = result.difference->at * 2;
  }
  bool try_it(const Stimulus& candidate) {
    if (runs_-- <= 0 || !play(candidate, make_, options_).difference) return false;
    best_ = candidate;
    return true;
  }
  /// Blocks of actions, from halves down to single ones, from the end to the beginning.
  bool leave_out() {
    const std::size_t before = best_.size();
    for (std::size_t size = std::max<std::size_t>(1, best_.size() / 2); size > 0 && runs_ > 0; size /= 2) {
      for (std::size_t end = best_.size(); end > 0 && runs_ > 0; end -= std::min(end, size)) {
        Stimulus candidate = best_;
        const std::size_t last = std::min(end, best_.size()), first = last - std::min(last, size);
        candidate.erase(candidate.begin() + static_cast<std::ptrdiff_t>(first),
                        candidate.begin() + static_cast<std::ptrdiff_t>(last));
        try_it(candidate);
      }
    }
    return best_.size() < before;
  }
  /// Faults of the wire and odd delays that do not matter.
  void simplify() {
    for (std::size_t i = 0; i < best_.size() && runs_ > 0; ++i) {
      Stimulus candidate = best_;
      candidate[i].faults = {};
      candidate[i].delay = candidate[i].delay / 1000 * 1000;
      try_it(candidate);
    }
  }

  Stimulus best_;
  const MakeTop& make_;
  PlayOptions options_;
  int runs_;
};

}  // namespace

Stimulus shrink(Stimulus stimulus, const MakeTop& make, int runs) {
  return Shrinker(std::move(stimulus), make, runs).run();
}

// --- faults -------------------------------------------------------------------------------------------------------------

std::vector<Fault> read_faults(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw tb::InputError(path, 0, "cannot be opened, allowed is the list of faults of the RTL");
  std::vector<Fault> faults;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    Fault fault;
    if (!(words >> fault.number >> fault.block) || !std::getline(words >> std::ws, fault.text))
      throw tb::InputError(path, number, "is no fault, allowed is: number, block, what is wrong");
    faults.push_back(std::move(fault));
  }
  return faults;
}

Kill hunt(const Fault& fault, const std::vector<NamedStimulus>& directed, std::uint64_t seed, std::uint64_t cycles) {
  Kill kill{fault, false, "", 0, ""};
  const MakeTop make = [&fault] { return make_faulty_rtl(quick_config(), fault.number); };
  const auto take = [&kill](const std::string& name, const Difference& difference) {
    kill.found = true;
    kill.stimulus = name;
    kill.what = difference.what;
  };
  for (const NamedStimulus& each : directed) {
    const PlayResult result = play(each.stimulus, make, quick_options());
    kill.cycles += result.counts.cycles;
    if (result.difference) {
      take(each.name, *result.difference);
      return kill;
    }
  }
  const CampaignResult random = run_campaign(seed, cycles, make, {});
  kill.cycles += random.counts.cycles;
  if (random.difference) take(fmt::format("random, case {}", random.cases), *random.difference);
  return kill;
}

std::string line_of(const Kill& kill) {
  return fmt::format("{:>3}  {:<5}  {:<16} {:<62} {:>9}  {}\n", kill.fault.number, kill.found ? "found" : "ALIVE",
                     kill.fault.block, kill.fault.text, kill.cycles,
                     kill.found ? fmt::format("{}: {}", kill.stimulus, kill.what) : "");
}

}  // namespace cosim
