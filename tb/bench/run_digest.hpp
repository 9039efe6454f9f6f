#pragma once
// A run up to a tick as one number: two runs that have the same did the same up to there.
#include <cstdint>
#include <map>
#include <string>

#include "io/input/hash.hpp"
#include "tb/bench/observer.hpp"

namespace dsdpv1::tb {

/// Sums up what the bench tells. What happens at one tick is told in another order where nobody wants each change of
/// each pin, and some of it later: the sum is the same.
class RunDigest : public Observer {
 public:
  void event(std::size_t slave, const profibus::Event& event) override;
  void telegram(const HeardTelegram& heard) override;
  void violated(const std::string& slave, const checks::Violation& violation, const char* kind) override;
  void flag(const bus::Flag& flag) override;
  void master_state(Tick now, const std::string& master, const std::string& member, const std::string& state) override;

  /// Of all before `now`; nothing comes for a time before it any more.
  std::uint64_t before(Tick now);

 private:
  void add(Tick at, const Hash& hash) { waiting_[at] += hash.value(); }

  std::map<Tick, std::uint64_t> waiting_;
  std::uint64_t sum_ = 0;
};

}  // namespace dsdpv1::tb
