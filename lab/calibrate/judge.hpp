#pragma once
// The verdict of a capture on a claim of the rulings, over all places where it shows.
#include <map>
#include <string>
#include <vector>

#include "lab/calibrate/wires.hpp"

namespace dsdpv1::calibrate {

/// One claim of a ruling that pins can show.
struct Claim {
  std::string ruling;  ///< "S3"; "facts": those at the end of docs/chip.md
  std::string says;
  std::vector<Wire> needs;  ///< wires that must be seen
};

struct Contradiction {
  Tick at = 0;
  std::string how;
};

struct Tally {
  std::size_t holds = 0, fails = 0, coarse = 0;
  std::vector<Contradiction> contradictions;  ///< the first kMostTold of them
};
constexpr std::size_t kMostTold = 20;

/// Counts. Claims are known by their address.
class Judge {
 public:
  void holds(const Claim& claim) { ++tallies_[&claim].holds; }
  /// The claim occurred, but the samples are too far apart to decide.
  void coarse(const Claim& claim) { ++tallies_[&claim].coarse; }
  void fails(const Claim& claim, Tick at, std::string how) {
    Tally& tally = tallies_[&claim];
    ++tally.fails;
    if (tally.contradictions.size() < kMostTold) tally.contradictions.push_back({at, std::move(how)});
  }
  void judge(const Claim& claim, bool right, Tick at, const char* how) {
    if (right)
      holds(claim);
    else
      fails(claim, at, how);
  }
  const Tally& tally(const Claim& claim) const {
    static const Tally none;
    const auto found = tallies_.find(&claim);
    return found == tallies_.end() ? none : found->second;
  }

 private:
  std::map<const Claim*, Tally> tallies_;
};

}  // namespace dsdpv1::calibrate
