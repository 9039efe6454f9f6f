#pragma once
// A run up to a tick as one number: runs with the same number did the same up to there.
#include <cstdint>
#include <map>
#include <string>

#include "io/input/hash.hpp"
#include "tb/bench/observer.hpp"

namespace dsdpv1::tb {

/// Sums up the bench's events. Events at one tick come in another order if not every change of every pin is needed, and
/// some come later: the sum is the same.
class RunDigest : public Observer {
 public:
  void event(std::size_t slave, const profibus::Event& event) override;
  void telegram(const HeardTelegram& heard) override;
  void violated(const std::string& slave, const checks::Violation& violation, const char* kind) override;
  void flag(const bus::Flag& flag) override;
  void master_state(Tick now, const std::string& master, const std::string& member, const std::string& state) override;

  /// Digest of everything before `now`; no later event may have an earlier time.
  std::uint64_t before(Tick now);

 private:
  void add(Tick at, const Hash& hash) { waiting_[at] += hash.value(); }

  std::map<Tick, std::uint64_t> waiting_;
  std::uint64_t sum_ = 0;
};

}  // namespace dsdpv1::tb
