#pragma once
// What a class-1 master does with one slave: which request is next, and what its answer means. No I/O, no time.
#include <cstdint>
#include <functional>
#include <string>

#include "bus/master/fdl.hpp"
#include "bus/master/slave_parameters.hpp"

namespace dsdpv1::bus {

enum class SlaveState : std::uint8_t {
  kOffline,   ///< does not answer; tried once a cycle at most
  kDiagnose,  ///< Slave_Diag before the parameters
  kClear,     ///< Global_Control Clear before the parameters (Personality::kClassic)
  kSetPrm,
  kChkCfg,
  kAwaitReady,  ///< Slave_Diag until the slave is ready for data exchange
  kDataExchange,
  kReleasing,  ///< Set_Prm with Unlock is to be sent
  kReleased,   ///< left alone
};
/// "OFFLINE", "DIAGNOSE", ...
const char* name(SlaveState state);

struct SlaveCounters {
  std::uint64_t data_exchanges = 0, diagnoses = 0, parameterisations = 0;
  std::uint64_t retries = 0, timeouts = 0, errors = 0;  ///< repetitions, attempts without answer, wrong answers
  std::uint64_t refusals = 0;                           ///< answers UE, RR, RS
};

/// What the master knows of a slave.
struct SlaveView {
  SlaveState state = SlaveState::kOffline;
  std::string reason = {};       ///< why the last bring-up failed or data exchange ended; empty when all is well
  std::string step_reason = {};  ///< why it went into `state`; empty when that was a step forward
  Bytes inputs = {};             ///< of the last data exchange
  Bytes outputs = {};            ///< sent in Operate
  Bytes diagnosis = {};          ///< data of the last Slave_Diag answer
  SlaveCounters counters = {};
};

class SlaveHandler {
 public:
  /// Throws std::invalid_argument when a value of `parameters` is out of its range.
  SlaveHandler(SlaveParameters parameters, std::uint8_t master, Personality personality);

  const SlaveParameters& parameters() const { return parameters_; }
  const SlaveView& view() const { return view_; }
  bool offline() const { return view_.state == SlaveState::kOffline; }

  /// The request that is due; not in kReleased. FCB and FCV are the data link layer's.
  Telegram next_request();
  /// What came back to the last `next_request`. Only counted when `release` or `restart` came between.
  void done(const FdlResult& result);

  /// As many bytes as output_length, else std::invalid_argument.
  void set_outputs(const Bytes& outputs);
  void set_clear(bool clear) { clear_ = clear; }
  void release();
  /// Begins anew with Slave_Diag; for a released slave too.
  void restart(const std::string& reason);

  std::function<void(SlaveState from, SlaveState to)> on_state;
  std::function<void()> on_inputs;     ///< inputs differ from the earlier ones
  std::function<void()> on_diagnosis;  ///< an answer to Slave_Diag

 private:
  Telegram due_request() const;
  Telegram service(std::uint8_t sap, const Bytes& data) const;
  Telegram data_exchange() const;
  Telegram framed(const Telegram& telegram) const;
  void go(SlaveState state, const std::string& why = {});
  void count(const FdlResult& result);
  void answered(const FdlResult& result);
  void initial_diagnosis(const Telegram& answer);
  void prm_answer(const FdlResult& result);
  void cfg_answer(const FdlResult& result);
  void readiness(const Telegram& answer);
  void exchange_answer(const FdlResult& result);
  void take_inputs(const Telegram& answer);
  void operating_diagnosis(const Telegram& answer);
  bool take_diagnosis(const Telegram& answer);
  bool refused(const Telegram& answer);
  std::string fault() const;

  SlaveParameters parameters_;
  std::uint8_t master_;
  Personality personality_;
  SlaveView view_;
  SlaveState asked_in_ = SlaveState::kOffline;  ///< the state of the last request
  bool clear_ = false, diagnosis_due_ = false, cfg_refused_ = false;
};

}  // namespace dsdpv1::bus
