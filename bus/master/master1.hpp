#pragma once
// A DP master class 1: brings up its slaves, exchanges data cyclically, executes the bench's commands. Layers: fdl.hpp
// (one request with its repetitions), slave.hpp and c1.hpp (one slave), token_ring.hpp (several masters), and here the
// order: commands, slaves, acyclic telegrams, poll slot, token.
//
// With BusParameters::ring the master shares the token: it continues its cycle at each token as far as the token hold
// time allows (the cyclic exchange counts as high priority, acyclic telegrams and the poll slot as low), passes the
// token when a cycle is complete, and leaves the search for new stations to the ring's GAP. Without, it is the only
// master and passes the token to itself.
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/master/c1.hpp"
#include "bus/master/fdl.hpp"
#include "bus/master/slave.hpp"
#include "bus/master/slave_parameters.hpp"
#include "bus/master/token_ring.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"

namespace dsdpv1::bus {

struct MasterConfig {
  std::string name = "master";
  std::uint8_t address = 1;  ///< 0..125
  int baud = 0;              ///< index of bus/baud.hpp
  Personality personality = Personality::kHighAlways;
  BusParameters bus = {};
};

/// Result of the FDL status polls of an address.
enum class LiveState : std::uint8_t { kUnknown, kAbsent, kPassive, kActive };

using AnswerCallback = std::function<void(const FdlResult&)>;

class Master1 : public Agent {
 public:
  /// Attaches to the segment, which must outlive it; add it to the timeline. Silent until `start`.
  Master1(Segment& segment, const MasterConfig& config);
  Master1(const Master1&) = delete;
  Master1& operator=(const Master1&) = delete;

  /// Throws std::invalid_argument for values out of range or an address already used. Before `start` or in operation.
  void add_slave(const SlaveParameters& parameters);

  // --- Operation. All calls take effect between two requests, at the timeline's present time at the earliest.
  // Listens for the timeout T_TO = (6 + 2 x address) x T_SL, claims the token and begins; in a running ring it waits to
  // be admitted. Brings up all slaves from the start.
  void start();
  /// Falls silent at once, even inside a telegram, as if it had died.
  void stop();
  bool running() const { return running_; }
  /// Operate is the initial mode. Clear: empty outputs for fail-safe slaves, zeros for the others; Global_Control
  /// announces both to all.
  void operate() { set_mode(false); }
  void clear() { set_mode(true); }
  bool clearing() const { return clear_; }
  /// Sends all later telegrams at another rate; the states of the slaves are kept.
  void change_baud(int index);
  int baud() const { return baud_; }

  // --- One slave. `address` must have been added, else std::out_of_range.
  // Exactly output_length bytes, else std::invalid_argument.
  void set_outputs(std::uint8_t address, const Bytes& outputs);
  /// Other outputs in each data exchange, until set_outputs.
  void vary_outputs(std::uint8_t address, OutputPattern pattern, std::uint32_t seed);
  /// Sends Set_Prm with Unlock and then ignores the slave until `activate`.
  void release(std::uint8_t address);
  /// Brings a slave up (again).
  void activate(std::uint8_t address);
  const SlaveView& slave(std::uint8_t address) const;
  const SlaveParameters& parameters(std::uint8_t address) const;
  std::vector<std::uint8_t> slave_addresses() const;

  // --- Acyclic requests, executed in the order of the calls; the callback gets the result.
  // SDN to `da` (127 = all); `group` 0 = all groups.
  void global_control(std::uint8_t command, std::uint8_t group = 0, std::uint8_t da = kBroadcast,
                      AnswerCallback done = {});
  void read_inputs(std::uint8_t address, AnswerCallback done = {});
  void read_outputs(std::uint8_t address, AnswerCallback done = {});
  void get_cfg(std::uint8_t address, AnswerCallback done = {});
  void slave_diag(std::uint8_t address, AnswerCallback done = {});
  void fdl_status(std::uint8_t address, AnswerCallback done = {});
  void set_slave_address(std::uint8_t address, std::uint8_t new_address, std::uint16_t ident, bool lock,
                         AnswerCallback done = {});
  /// Any request; FC holds bit 6 and the function, FCB and FCV are added.
  void request(const Telegram& telegram, AnswerCallback done = {});
  /// Any bytes, with faults, once. Afterwards the addressed station's series (FCB) restarts.
  void send_raw(const Bytes& bytes, const WireFaults& faults = {}, bool wants_answer = true, AnswerCallback done = {});

  // --- Acyclic, class 1 (MSAC_C1). Queued for the slave, `address` as above; executed while it is in data exchange:
  // after each pass of the cyclic exchange every slave gets at most one acyclic telegram, the request or one poll. So a
  // cycle grows by at most one short message per slave, and a poll comes once per cycle.
  // SlaveParameters::c1_response_timeout limits the time for an answer.
  // DS_Read of `length` bytes. Reads and writes are also sent to a slave not parameterised for DPV1, to test its
  // refusal.
  void c1_read(std::uint8_t address, std::uint8_t slot, std::uint8_t index, std::uint8_t length,
               AcyclicCallback done = {});
  /// DS_Write; more than 240 bytes: std::invalid_argument.
  void c1_write(std::uint8_t address, std::uint8_t slot, std::uint8_t index, const Bytes& data,
                AcyclicCallback done = {});
  /// Any request PDU header, even an invalid one.
  void c1_request(std::uint8_t address, const AcyclicRequest& request, AcyclicCallback done = {});
  /// Operations queued or in progress.
  std::size_t c1_open(std::uint8_t address) const;

  /// The master's part in the ring; nullptr without BusParameters::ring.
  TokenRing* ring() { return ring_.get(); }
  const TokenRing* ring() const { return ring_.get(); }

  LiveState live(std::uint8_t address) const { return live_.at(address); }
  /// Minimum time from the start of one cycle to the next: from the bus parameters, else the greatest of the slaves'.
  std::int64_t min_slave_interval_us() const;
  std::uint64_t cycles() const { return cycles_; }
  /// Start to start of the last complete cycle, 0 before.
  Tick cycle_time() const { return cycle_time_; }

  std::function<void(Tick at, std::uint8_t address, SlaveState from, SlaveState to)> on_state;
  std::function<void(Tick at, std::uint8_t address)> on_inputs, on_diagnosis;
  /// Called for every finished C1 operation, after its own callback.
  std::function<void(Tick at, std::uint8_t address, const AcyclicResult&)> on_acyclic;
  /// Called for every finished request, including cyclic ones.
  std::function<void(Tick at, const FdlResult&)> on_answer;

  Tick next() const override;
  void run(Tick now) override;

 private:
  /// The next use of the bus in the cycle.
  enum class Phase : std::uint8_t { kListen, kClaim, kSlaves, kAcyclic, kPollSlot, kGap, kToken, kWait };
  struct Command {
    FdlRequest request;
    AnswerCallback done;
  };
  void set_mode(bool clear);
  void service(std::uint8_t address, std::uint8_t sap, const Bytes& data, AnswerCallback done);
  void push(FdlRequest request, AnswerCallback done);
  /// One slave: the cyclic exchange and the acyclic one.
  struct Slave {
    SlaveHandler handler;
    C1Client c1, alarms;  ///< SAP 51 and 50
  };
  Slave& slave_at(std::uint8_t address);
  const Slave& slave_at(std::uint8_t address) const;
  bool has_slave(std::uint8_t address) const;

  void begin_operation();
  bool start_next();
  bool start_in_ring();
  bool start_command();
  bool start_phase();
  bool listen();
  bool start_claim();
  bool start_slave();
  bool start_acyclic();
  bool start_poll_slot();
  bool start_gap_poll();
  bool start_token();
  bool wait();
  void begin_cycle();
  void ask(FdlRequest request, AnswerCallback done);
  void ask_slave(SlaveHandler& slave);
  void ask_c1(C1Client& c1);
  void leave_acyclic(Slave& slave, const std::string& reason);
  AcyclicCallback told(std::uint8_t address, AcyclicCallback done = {});
  void finished(const FdlResult& result);
  void record_live(std::uint8_t address, const FdlResult& result);
  bool work_to_do() const;

  MasterConfig config_;
  MasterFdl fdl_;
  std::unique_ptr<TokenRing> ring_;  ///< none for a single master
  std::vector<std::unique_ptr<Slave>> slaves_;
  std::deque<Command> commands_;
  AnswerCallback current_done_;
  std::optional<int> new_baud_;
  int baud_;
  bool running_ = false, start_requested_ = false, stop_requested_ = false, clear_ = false;

  Phase phase_ = Phase::kListen;
  int claims_ = 0;
  std::size_t slave_position_ = 0, acyclic_position_ = 0, offline_position_ = 0;
  std::uint8_t gap_address_ = 0;
  std::array<LiveState, 128> live_ = {};
  Tick now_ = 0, due_ = 0, listen_from_ = 0, cycle_start_ = 0, cycle_time_ = 0;
  std::uint64_t cycles_ = 0;
};

}  // namespace dsdpv1::bus
