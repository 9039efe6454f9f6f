#include <algorithm>
#include <utility>

#include "cosim/random/campaign.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr std::uint64_t kMostCycles = 20'000'000;  // of all runs together: about a minute

class Shrinker {
 public:
  Shrinker(Stimulus stimulus, const MakeTop& make, int runs, PlayOptions options)
      : best_(std::move(stimulus)), make_(make), options_(std::move(options)), runs_(runs) {
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
    if (runs_-- <= 0) return false;
    const PlayResult result = play(candidate, make_, options_);
    cycles_ += result.counts.cycles;
    if (cycles_ >= kMostCycles) runs_ = 0;
    if (!result.difference) return false;
    best_ = candidate;
    return true;
  }
  /// Where actions begin that are not joined to the one before, and the end.
  std::vector<std::ptrdiff_t> begins() const {
    std::vector<std::ptrdiff_t> all;
    for (std::size_t i = 0; i < best_.size(); ++i)
      if (!best_[i].joined) all.push_back(static_cast<std::ptrdiff_t>(i));
    all.push_back(static_cast<std::ptrdiff_t>(best_.size()));
    return all;
  }
  /// Removes blocks of actions, from halves down to single ones, from the end to the beginning.
  bool leave_out() {
    const std::size_t before = best_.size();
    std::vector<std::ptrdiff_t> at = begins();
    for (std::size_t size = std::max<std::size_t>(1, (at.size() - 1) / 2); size > 0 && runs_ > 0; size /= 2) {
      for (std::size_t end = at.size() - 1; end > 0 && runs_ > 0; end -= std::min(end, size)) {
        Stimulus candidate = best_;
        const std::size_t last = std::min(end, at.size() - 1), first = last - std::min(last, size);
        candidate.erase(candidate.begin() + at[first], candidate.begin() + at[last]);
        if (try_it(candidate)) at = begins();
      }
    }
    return best_.size() < before;
  }
  /// Removes wire faults and odd delays that have no effect.
  void simplify() {
    for (std::size_t i = 0; i < best_.size() && runs_ > 0; ++i) {
      if (best_[i].joined) continue;
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
  std::uint64_t cycles_ = 0;
};

}  // namespace

Stimulus shrink(Stimulus stimulus, const MakeTop& make, int runs, const PlayOptions& options) {
  return Shrinker(std::move(stimulus), make, runs, options).run();
}

}  // namespace dsdpv1::cosim
