#pragma once
// Functional coverage of lockstep runs: which states, transitions, services, refusals and situations at the host port
// have occurred, how often, and which known ones have not.
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dsdpv1::cosim {

/// A group ("services") and one of its situations ("Get_Cfg in WAIT_PRM: data").
using Situation = std::pair<std::string, std::string>;

class Situations {
 public:
  void count(const char* group, std::string item) { ++counts_[{group, std::move(item)}]; }
  void add(const Situation& situation, std::uint64_t times) { counts_[situation] += times; }
  void add(const Situations& other) {
    for (const auto& [situation, times] : other.counts_) counts_[situation] += times;
  }
  std::uint64_t of(const Situation& situation) const {
    const auto found = counts_.find(situation);
    return found == counts_.end() ? 0 : found->second;
  }
  const std::map<Situation, std::uint64_t>& counts() const { return counts_; }

 private:
  std::map<Situation, std::uint64_t> counts_;  ///< those that occurred
};

/// A line per group: how many known ones occurred, then the others by name.
std::string text(const Situations& situations, const std::vector<Situation>& known);
/// One line each: group, situation, count, separated by tabs; includes those that did not occur.
std::string table(const Situations& situations, const std::vector<Situation>& known);

}  // namespace dsdpv1::cosim
