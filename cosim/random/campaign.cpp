#include "cosim/random/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "cosim/random/random_cases.hpp"

namespace dsdpv1::cosim {
namespace {

struct Played {
  PlayResult result;
  Situations situations;
  std::vector<std::string> settings;
};

/// Hands out case numbers and collects their results.
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
      const std::scoped_lock lock(mutex_);
      if (cycles_ >= options_.cycles || differs_) return false;
      number = played_.size();
      played_.emplace_back();
    }
    Played played = play_case(seed_of(number));
    const std::scoped_lock lock(mutex_);
    cycles_ += played.result.counts.cycles;
    differs_ = differs_ || played.result.difference;
    played_[number] = std::move(played);
    if (progress_) progress_(played_.size(), cycles_);
    return true;
  }
  std::uint64_t seed_of(std::uint64_t number) const { return case_seed(options_.seed, options_.first_case + number); }
  Played play_case(std::uint64_t seed) {
    const RandomCases& cases = *options_.play.kind->random();
    PlayOptions options = options_.play;
    Played played;
    if (options_.make_for) played.settings = cases.case_settings(seed);
    if (!played.settings.empty()) {
      const std::scoped_lock lock(mutex_);  // the keys' descriptions are made at first use
      set_parameters(options, played.settings);
    }
    const std::unique_ptr<PlayListener> watch = cases.watch(*options.chip, played.situations);
    if (options_.counts_situations) options.listeners.push_back(watch.get());
    played.result = play(random_case(seed, options), options_.make_for ? options_.make_for(options) : make_, options);
    return played;
  }
  /// Every case before the first with a difference was begun before it, and all begun cases have ended.
  CampaignResult sum() const {
    CampaignResult result;
    for (const Played& each : played_) {
      if (result.counts.cycles >= options_.cycles || result.difference) break;
      result.counts.add(each.result.counts);
      result.coverage.add(each.result.coverage);
      result.situations.add(each.situations);
      result.difference = each.result.difference;
      result.failed_seed = seed_of(result.cases++);
      result.failed_settings = each.settings;
    }
    return result;
  }

  const CampaignOptions& options_;
  const MakeTop& make_;
  const CampaignProgress& progress_;
  std::mutex mutex_;
  std::vector<Played> played_;
  std::uint64_t cycles_ = 0;
  bool differs_ = false;
};

}  // namespace

void in_parallel(unsigned jobs, const std::function<bool()>& work) {
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto run = [&] {
    try {
      while (work()) {
      }
    } catch (...) {
      const std::scoped_lock lock(mutex);
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
  z ^= z >> 31;
  return z - z % kLedCases + (number + 1 < kLedCases ? number + 1 : 0);
}

CampaignResult run_campaign(const CampaignOptions& options, const MakeTop& make, const CampaignProgress& progress) {
  return Campaign(options, make, progress).run();
}

}  // namespace dsdpv1::cosim
