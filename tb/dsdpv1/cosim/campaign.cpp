#include "tb/dsdpv1/cosim/campaign.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "tb/dsdpv1/cosim/random_setup.hpp"
#include "tb/dsdpv1/cosim/random_stimulus.hpp"

namespace dsdpv1::cosim {
namespace {

// No case needs longer; the slow rates would make some last for minutes.
constexpr Tick kLongestCase = 2'500'000 * profibus::kTicksPerCycle;

void add(MatchCounts& sum, const MatchCounts& one) {
  sum.cycles += one.cycles;
  sum.pin_changes += one.pin_changes;
  sum.dpram_images += one.dpram_images;
}

/// Hands out case numbers and collects what came of them.
class Campaign {
 public:
  Campaign(const CampaignOptions& options, const MakeTop& make, const CampaignProgress& progress)
      : options_(options), make_(make), progress_(progress) {}

  CampaignResult run() {
    in_parallel(options_.jobs, [this] { return next_case(); });
    return sum();
  }

 private:
  bool next_case() {
    std::size_t number = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (cycles_ >= options_.cycles || differs_) return false;
      number = played_.size();
      played_.emplace_back();
    }
    PlayResult result = play(random_stimulus(case_seed(options_.seed, number), options_.mode), make_, options_.play);
    const std::lock_guard<std::mutex> lock(mutex_);
    cycles_ += result.counts.cycles;
    differs_ = differs_ || result.difference;
    played_[number] = std::move(result);
    if (progress_) progress_(played_.size(), cycles_);
    return true;
  }
  /// Every case before the first with a difference was begun before it, and all that were begun have ended.
  CampaignResult sum() const {
    CampaignResult result;
    for (const PlayResult& each : played_) {
      if (result.counts.cycles >= options_.cycles || result.difference) break;
      add(result.counts, each.counts);
      result.coverage.add(each.coverage);
      result.difference = each.difference;
      result.failed_seed = case_seed(options_.seed, result.cases++);
    }
    return result;
  }

  const CampaignOptions& options_;
  const MakeTop& make_;
  const CampaignProgress& progress_;
  std::mutex mutex_;
  std::vector<PlayResult> played_;
  std::uint64_t cycles_ = 0;
  bool differs_ = false;
};

}  // namespace

PlayOptions quick_options(dsdpv1::Part part) {
  PlayOptions options;
  options.config = quick_config(part);
  options.limit = kLongestCase;
  return options;
}

void in_parallel(unsigned jobs, const std::function<bool()>& work) {
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto run = [&] {
    try {
      while (work()) {
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < jobs; ++i) threads.emplace_back(run);
  run();
  for (std::thread& each : threads) each.join();
  if (thrown) std::rethrow_exception(thrown);
}

std::uint64_t case_seed(std::uint64_t campaign, std::uint64_t number) {
  // splitmix64: neighbouring numbers give unrelated seeds.
  std::uint64_t z = campaign * 0x9E3779B97F4A7C15ULL + number + 1;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ z >> 27) * 0x94D049BB133111EBULL;
  return z ^ z >> 31;
}

CampaignResult run_campaign(const CampaignOptions& options, const MakeTop& make, const CampaignProgress& progress) {
  return Campaign(options, make, progress).run();
}

}  // namespace dsdpv1::cosim
