#pragma once
// A run of a scenario from its file to the verdict: of run and traces as it is asked for, of cosim with the user's RTL.
#include <optional>

#include "apps/options/run_arguments.hpp"
#include "cosim/lockstep_execution.hpp"
#include "tb/bench/bench.hpp"
#include "tb/saved/saved_run.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {

/// Carries it out, with the engine rtl by RTL that `own` makes, if it is given; returns the exit code. Throws
/// tb::InputError.
int run(const RunArguments& given, const cosim::MakeRtl& own = {});

/// The run to execute.
struct RunRequest {
  RunArguments arguments;
  tb::scenario::Scenario scenario;
  tb::RunOptions options;
  tb::SavedRun described;                ///< for --save-at
  std::optional<tb::SavedRun> restored;  ///< of --restore
};

/// Throws tb::InputError if no slave has a processor for `--gdb` of this program.
void check_has_board(const std::string& program, const tb::scenario::Scenario& scenario);

/// The options except the wave's. Throws tb::InputError.
tb::RunOptions options_of(const RunArguments& arguments);

struct LockstepOutcome {
  int status = 0;  ///< exit code
  std::optional<cosim::Difference> difference;
  std::vector<cosim::InputChange> inputs;  ///< of the chip that differs, if LockstepOptions::keeps_inputs
};

/// Model and the RTL that `make` makes side by side.
LockstepOutcome run_lockstep(const RunRequest& request, cosim::MakeRtl make,
                             const cosim::LockstepOptions& lockstep = {});

}  // namespace dsdpv1::app
