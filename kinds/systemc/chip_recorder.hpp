#pragma once
// The bench's records of a scenario, for a chip in a SystemC platform: checks with margins, summary, verdict and exit
// code, log, wave with the chip's inside, capture of the line, counters of accesses.
//
//   dsdpv1::systemc::ChipRecorder recorder({"demo", "out/demo.fst"});
//   recorder.attach(chip);                // before the simulation starts
//   sc_core::sc_start(10, sc_core::SC_MS);
//   recorder.finish();
//   std::cout << recorder.summary();
//   return recorder.exit_code();
//
// docs/systemc.md has an example.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dsdpv1::tb {
struct RunResult;
}

namespace dsdpv1::systemc {

class PinModule;
class TlmModule;
class Spc3PinModule;
class Spc3TlmModule;

/// The limit of a check (docs/checks.md), or that it is not made.
struct CheckLimit {
  std::string id;               ///< "TIMING_TS"
  std::optional<double> limit;  ///< ns, or a number for a check that counts; absent: the default
  bool on = true;
};

enum class RecorderChecks : std::uint8_t {
  kFail,    ///< a violation fails the run
  kReport,  ///< violations are only listed
  kOff,
};

struct RecorderOptions {
  std::string name;     ///< of the run; empty: that of the module
  std::string wave;     ///< path of an FST or VCD file (its ending); empty: none
  std::string log;      ///< path; .jsonl: for programs
  std::string capture;  ///< path of a pcapng file with the line's telegrams
  /// The wave has the chip's inside; only for a module made with Engine::kStep, where no access is ahead.
  bool inside = false;
  RecorderChecks checks = RecorderChecks::kFail;
  std::vector<CheckLimit> limits = {};
  std::vector<std::string> allowed = {};  ///< ids of checks and codes whose violations do not fail the run
  /// The line's rate, "12M" to "9.6k"; empty: telegrams are read once the chip has found its rate.
  std::string baud;
};

/// A check at the end.
struct CheckOutcome {
  std::string id;
  std::uint64_t count = 0, violations = 0;
  std::optional<std::int64_t> margin,
      measured;                    ///< ticks of 1/12 ns, of the worst case; a number for a check that counts
  std::optional<std::int64_t> at;  ///< the chip's tick
};

/// Records one chip. It changes neither the chip's ticks nor which accesses are ahead of simulation time; with a wave,
/// and with Engine::kStep, the simulation is slower.
class ChipRecorder {
 public:
  /// Throws std::runtime_error, one line, for options that are wrong and files that cannot be created.
  explicit ChipRecorder(RecorderOptions options = {});
  /// Finishes, if finish() was not called; errors of files are then lost.
  ~ChipRecorder();
  ChipRecorder(const ChipRecorder&) = delete;
  ChipRecorder& operator=(const ChipRecorder&) = delete;

  // The modules of the DSDPV1-RSU are among them. Once, before the simulation starts (else std::logic_error). The chip
  // may be destroyed before or after the recorder; in the first case the recording ends there.
  void attach(PinModule& chip);
  void attach(TlmModule& chip);
  void attach(Spc3PinModule& chip);
  void attach(Spc3TlmModule& chip);
  /// Leaves the chip, judges what came until now and completes the files; throws std::runtime_error if one cannot be
  /// written. At any time; again: nothing.
  void finish();

  // After finish().
  /// As `dsdpv1-sim run` prints it; `all_checks`: with a row for each check (--checks-table).
  std::string summary(bool all_checks = false) const;
  /// "PASSED", "FAILED: 2 violations".
  std::string verdict() const;
  /// 0 passed, 1 failed, 3 nothing judged: without data exchange.
  int exit_code() const;
  /// The result file (docs/result.md).
  std::string result_json() const;
  /// The checks of the chip's port that were made.
  std::vector<CheckOutcome> checks() const;
  const tb::RunResult& result() const;

  // At any time.
  std::uint64_t accesses() const;
  /// Those carried out ahead of simulation time.
  std::uint64_t accesses_ahead() const;

 private:
  class Recording;
  template <class Family, class Module>
  void attach_to(Module& chip);

  RecorderOptions options_;
  std::unique_ptr<Recording> recording_;
};

}  // namespace dsdpv1::systemc
