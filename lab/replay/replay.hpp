#pragma once
// A capture played to the model, which takes the part of one recorded slave; its answers are held against the recorded
// ones.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lab/replay/judge.hpp"
#include "lab/replay/lead_in.hpp"
#include "lab/replay/replayed_line.hpp"
#include "tb/bench/bench.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::replay {

struct ReplayOptions {
  JudgeOptions judge;
  bool lead_in = true;  ///< false: the model has to find the rate, and its parameters, in the capture
  std::string gsd;      ///< absolute path, empty: none
};

/// A scenario with the slave alone, initialised as the capture shows it, or as the GSD says.
scenario::Scenario scenario_of(const Recording& recording, const Firmware& firmware, const std::string& gsd);
/// The scenario with nobody but the slave of this address, or the only one, which gets it. Throws InputError.
scenario::Scenario alone(scenario::Scenario scenario, const Recording& recording);
/// In words, what the slave is initialised with.
std::string describe_station(const scenario::Scenario& scenario);

class Replay {
 public:
  /// All that is given must outlive it; `scenario` has one slave. Throws InputError.
  Replay(const Recording& recording, const Firmware& firmware, const scenario::Scenario& scenario,
         const ReplayOptions& options, RunOptions run, std::unique_ptr<Execution> execution);
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Plays to the end, or until `poll` returns false: called with the share that is done, 0 to 1.
  Result run(const std::function<bool(double share)>& poll);
  /// What the bench says of the run.
  const RunResult& bench_result() const { return run_result_; }
  bool wave_is_empty() const { return bench_.wave_is_empty(); }

 private:
  /// Gives the supplies to the user CPU in time.
  class Supplier : public bus::Agent {
   public:
    Supplier(Bench& bench, const scenario::Scenario& scenario, const std::vector<Supply>& supplies)
        : bench_(bench), slave_(scenario.slaves.front().name.text), supplies_(supplies) {}
    /// `at`: where the capture begins, nothing is given before.
    void begin(Tick shift, Tick at) {
      shift_ = shift;
      begin_ = at;
      announce();
    }
    Tick next() const override;
    void run(Tick now) override;

   private:
    Bench& bench_;
    std::string slave_;
    const std::vector<Supply>& supplies_;
    std::optional<Tick> shift_;
    Tick begin_ = 0;
    std::size_t next_ = 0;
  };

  void prepare_lead_in();
  void begin(Tick free);
  bool over(Tick now) const;
  Result result(bool interrupted);

  const Recording& recording_;
  const Firmware& firmware_;
  const scenario::Scenario& scenario_;
  ReplayOptions options_;
  std::vector<PlacedTelegram> placed_;
  std::vector<Supply> nothing_;
  Listener listener_;
  std::unique_ptr<Execution> made_;
  Execution& execution_;
  std::unique_ptr<ReplayedLine> line_;
  LeadIn lead_in_;
  Bench bench_;
  Supplier supplier_;
  std::optional<Tick> shift_;
  RunResult run_result_;
};

}  // namespace dsdpv1::tb::replay
