#pragma once
// A class-1 master's handling of one slave: the next request, and the effect of its answer. No I/O, no time.
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "bus/master/fdl.hpp"
#include "bus/master/slave_parameters.hpp"

namespace dsdpv1::bus {

enum class SlaveState : std::uint8_t {
  kOffline,   ///< does not answer; tried at most once per cycle
  kDiagnose,  ///< Slave_Diag before the parameters
  kClear,     ///< Global_Control Clear before the parameters (Personality::kClassic)
  kSetPrm,
  kChkCfg,
  kAwaitReady,  ///< Slave_Diag until the slave is ready for data exchange
  kDataExchange,
  kReleasing,  ///< Set_Prm with Unlock is to be sent
  kReleased,   ///< ignored
};
/// "OFFLINE", "DIAGNOSE", ...
const char* name(SlaveState state);

struct SlaveCounters {
  std::uint64_t data_exchanges = 0, diagnoses = 0, parameterisations = 0;
  std::uint64_t retries = 0, timeouts = 0, errors = 0;  ///< repetitions, attempts without answer, wrong answers
  std::uint64_t refusals = 0;                           ///< answers UE, RR, RS
};

/// The master's knowledge of a slave.
struct SlaveView {
  SlaveState state = SlaveState::kOffline;
  std::string reason = {};       ///< why the last bring-up failed or data exchange ended; else empty
  std::string step_reason = {};  ///< why it entered `state`; empty for a step forward
  Bytes inputs = {};             ///< of the last data exchange
  Bytes outputs = {};            ///< sent in Operate
  Bytes diagnosis = {};          ///< data of the last Slave_Diag answer
  SlaveCounters counters = {};
};

class SlaveHandler {
 public:
  /// Throws std::invalid_argument for a value of `parameters` out of range.
  SlaveHandler(SlaveParameters parameters, std::uint8_t master, Personality personality);

  const SlaveParameters& parameters() const { return parameters_; }
  const SlaveView& view() const { return view_; }
  bool offline() const { return view_.state == SlaveState::kOffline; }

  /// The request that is due; not in kReleased. The data link layer adds FCB and FCV.
  Telegram next_request();
  /// The result of the last `next_request`. Only counted if `release` or `restart` came in between.
  void done(const FdlResult& result);

  /// Exactly output_length bytes, else std::invalid_argument. They stay until the next call.
  void set_outputs(const Bytes& outputs);
  /// Other outputs in each exchange from now on. A repetition of a request has those of the request.
  void vary_outputs(OutputPattern pattern, std::uint32_t seed);
  void set_clear(bool clear) { clear_ = clear; }
  void release();
  /// Restarts with Slave_Diag, also for a released slave.
  void restart(const std::string& reason);

  std::function<void(SlaveState from, SlaveState to)> on_state;
  std::function<void()> on_inputs;                      ///< inputs differ from the earlier ones
  std::function<void()> on_diagnosis;                   ///< called for an answer to Slave_Diag
  std::function<void(const AcyclicRequest&)> on_alarm;  ///< one to acknowledge

 private:
  void renew_outputs();
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
  void take_alarm();
  bool refused(const Telegram& answer);
  std::string fault() const;

  SlaveParameters parameters_;
  std::uint8_t master_;
  Personality personality_;
  SlaveView view_;
  SlaveState asked_in_ = SlaveState::kOffline;  ///< the state of the last request
  OutputPattern pattern_ = OutputPattern::kFixed;
  std::uint8_t exchange_ = 0;  ///< OutputPattern::kCount
  std::minstd_rand random_;    ///< OutputPattern::kRandom
  bool clear_ = false, diagnosis_due_ = false, announced_ = false, cfg_refused_ = false;
  Bytes alarm_;  ///< Alarm_Ack of the last diagnosis, empty without an alarm
};

}  // namespace dsdpv1::bus
