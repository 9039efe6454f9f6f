#pragma once
// What a user CPU did last at the pins of its chip, and where its program was meanwhile: enough to name the line that
// broke a rule. The board's processor gives addresses of instructions, a host process numbers of its callers.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "tb/chip/user_cpu/place.hpp"

namespace dsdpv1::user_cpu {

class ActLog {
 public:
  using Tick = bus::Tick;
  static constexpr std::uint32_t kCallBytes = 4;
  /// A place of the program is kept this often: 100 us, for the last 100 ms.
  static constexpr Tick kSamplePeriod = 100 * bus::kTicksPerUs;

  explicit ActLog(Tick start) : sample_at_(start + kSamplePeriod) {}

  /// An access to `count` cells from `cell` on begins, by the instruction at `pc`.
  void access(Tick at, std::uint32_t pc, std::uint32_t cell, unsigned count, bool write) {
    add({at, pc, cell, write ? count : 0, false});
  }
  /// Pins of the chip move, or the program cannot go on; `releases`: R_REQ or R_STA falls.
  void pins(Tick at, std::uint32_t pc, bool releases) { add({at, pc, 0, 0, releases}); }

  /// When the next sample is due.
  Tick sample_at() const { return sample_at_; }
  /// The program has been at `pc` from the last sample's time until `now`, or was not asked. `lr`: its link register.
  void sample(Tick now, std::uint32_t pc, std::uint32_t lr) {
    if (sample_at_ <= now) take_samples(now, pc, lr);
  }

  /// `place_of(pc)`: a Place. An omission that was too short for a sample is where the program acted next, or last.
  template <class PlaceOf>
  std::optional<Place> where(const Act& act, const PlaceOf& place_of) const;

  /// The instruction of an act; absent if it is older than what is kept. Not for an omission.
  std::optional<std::uint32_t> instruction(const Act& act) const;

  /// Where the program was most of the time from `since` to `until`, by the samples: a function, also while it calls
  /// one that calls no other.
  struct Stay {
    std::uint32_t pc = 0;  ///< the last one there
    Tick time = 0;
    Tick itself = 0;  ///< of it in the function itself
  };
  /// `function_of(address)`: a name; empty: none. Absent without a sample.
  template <class FunctionOf>
  std::optional<Stay> longest_stay(Tick since, Tick until, const FunctionOf& function_of) const;

 private:
  struct Entry {
    Tick at = bus::kNever;
    std::uint32_t pc = 0, cell = 0;
    unsigned written = 0;  ///< cells
    bool releases = false;
  };
  struct Sample {
    Tick at = bus::kNever;
    std::uint32_t pc = 0, lr = 0;
  };

  void take_samples(Tick now, std::uint32_t pc, std::uint32_t lr);
  void add(const Entry& entry) { entries_.at(count_++ % entries_.size()) = entry; }
  template <class Is>
  const Entry* last(Tick until, const Is& is) const;

  std::array<Entry, 512> entries_{};  ///< more than a block has cells
  std::size_t count_ = 0;
  std::array<Sample, 1000> samples_{};
  std::size_t samples_taken_ = 0;
  Tick sample_at_;
};

template <class PlaceOf>
std::optional<Place> ActLog::where(const Act& act, const PlaceOf& place_of) const {
  if (act.since) {
    const auto function_of = [&place_of](std::uint32_t pc) { return place_of(pc).function; };
    if (const auto stay = longest_stay(*act.since, act.at, function_of)) {
      Place place = place_of(stay->pc);
      place.stayed = stay->time;
      return place;
    }
  }
  const std::optional<std::uint32_t> pc = instruction(act);
  return pc ? std::optional(place_of(*pc)) : std::nullopt;
}

template <class FunctionOf>
std::optional<ActLog::Stay> ActLog::longest_stay(Tick since, Tick until, const FunctionOf& function_of) const {
  std::map<std::string, Stay> stays;
  const std::size_t kept = std::min(samples_taken_, samples_.size());
  for (std::size_t i = samples_taken_ - kept; i < samples_taken_; ++i) {
    const Sample& sample = samples_.at(i % samples_.size());
    if (sample.at <= since || sample.at > until) continue;
    const std::string function = function_of(sample.pc), caller = function_of(sample.lr);
    const auto stays_in = [&](const std::string& name, std::uint32_t at, Tick itself) {
      Stay& stay = stays[name];
      stay = {at, stay.time + kSamplePeriod, stay.itself + itself};
    };
    stays_in(function, sample.pc, kSamplePeriod);
    if (caller != function && !caller.empty()) stays_in(caller, sample.lr - kCallBytes, 0);
  }
  const auto longest = std::max_element(stays.begin(), stays.end(), [](const auto& a, const auto& b) {
    return std::tie(a.second.time, a.second.itself) < std::tie(b.second.time, b.second.itself);
  });
  if (longest == stays.end()) return std::nullopt;
  Stay stay = longest->second;
  stay.time = std::min(stay.time, until - since);
  return stay;
}

}  // namespace dsdpv1::user_cpu
