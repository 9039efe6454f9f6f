#pragma once
// Plays a capture to the model, which takes the part of one recorded slave, and compares its answers with the recorded
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

/// The first kind of chip that can behave as the recorded slave did.
const ChipKind& kind_for(const Firmware& firmware);
/// A scenario with only the slave, a chip of this kind, initialised from the capture or the GSD.
scenario::Scenario scenario_of(const Recording& recording, const Firmware& firmware, const std::string& gsd,
                               const ChipKind& kind);
/// The scenario with only the slave of this address, or its only slave, which gets the address. Throws InputError.
scenario::Scenario alone(scenario::Scenario scenario, const Recording& recording);
/// Its slave's user CPU begins with the first recorded inputs and makes no others.
void take_inputs_of(const Firmware& firmware, scenario::Scenario& scenario);
/// The slave's initialisation in words.
std::string describe_station(const scenario::Scenario& scenario);

class Replay {
 public:
  /// All arguments must outlive it; `scenario` has one slave. Throws InputError.
  Replay(const Recording& recording, const Firmware& firmware, const scenario::Scenario& scenario,
         const ReplayOptions& options, RunOptions run, std::unique_ptr<Execution> execution);
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Plays to the end, or until `poll` returns false. `poll` gets the progress, 0 to 1.
  Result run(const std::function<bool(double share)>& poll);
  /// The bench's result of the run.
  const RunResult& bench_result() const { return run_result_; }
  bool wave_is_empty() const { return bench_.wave_is_empty(); }

 private:
  /// Gives the supplies to the user CPU in time.
  class Supplier : public bus::Agent {
   public:
    Supplier(Bench& bench, const scenario::Scenario& scenario, const std::vector<Supply>& supplies)
        : bench_(bench), slave_(scenario.slaves.front().name.text), supplies_(supplies) {}
    /// Accepts the parameters or the configuration of the lead-in.
    void accept(Tick at, bool cfg) {
      lead_in_ = Supply{at, user_cpu::command::SendVerdict{cfg}};
      announce();
    }
    /// Nothing is given until the next `begin`.
    void pause() { shift_.reset(); }
    /// `at`: the capture begins or continues; nothing is given before.
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
    std::optional<Supply> lead_in_;
    std::optional<Tick> shift_;
    Tick begin_ = 0;
    std::size_t next_ = 0;
  };

  void prepare_lead_in();
  void judge_lead_in(const bus::Telegram& telegram, Tick end);
  void begin(Tick free);
  bool may_go_on(std::size_t placed);
  bool over(Tick now) const;
  Result result(bool interrupted);

  const Recording& recording_;
  const Firmware& firmware_;
  const scenario::Scenario& scenario_;
  ReplayOptions options_;
  std::vector<PlacedTelegram> placed_;
  user_cpu::StationConfig station_;
  std::vector<Supply> supplies_;
  Listener listener_;
  std::unique_ptr<Execution> made_;
  Execution& execution_;
  std::unique_ptr<ReplayedLine> line_;
  LeadIn lead_in_;
  Bench bench_;
  Supplier supplier_;
  std::optional<Tick> shift_;
  std::size_t next_ = 0;  ///< position in placed_ with which the line begins or continues
  RunResult run_result_;
};

}  // namespace dsdpv1::tb::replay
