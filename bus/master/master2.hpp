#pragma once
// A DP master class 2: any number of acyclic connections (MSAC_C2), beside class-1 masters on the same segment. Always
// takes part in the token ring. At each token every connection may send one telegram (low priority), longest waiting
// first, as long as the token hold time lasts.
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "bus/master/fdl.hpp"
#include "bus/master/master1.hpp"
#include "bus/master/master2_connection.hpp"
#include "bus/master/token_ring.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"

namespace dsdpv1::bus {

using ConnectionId = std::size_t;  ///< 0, 1, ... in the order of `add_connection`

class Master2 : public Agent {
 public:
  /// Attaches to the segment, which must outlive it; add it to the timeline. Silent until `start`. `config.personality`
  /// and `config.bus.ring` are ignored. Throws std::invalid_argument for an address above 125.
  Master2(Segment& segment, const MasterConfig& config);
  Master2(const Master2&) = delete;
  Master2& operator=(const Master2&) = delete;

  // --- Operation. All calls take effect between two requests, at the timeline's present time at the earliest.
  // Learns the ring and waits to be admitted, or claims the token of a dead bus.
  void start();
  /// Falls silent at once, as if it had died. Its connections are closed on this side without a telegram.
  void stop();
  bool running() const { return running_; }
  /// Sends all later telegrams at another rate, 0..9 (std::out_of_range).
  void change_baud(int index);
  int baud() const { return baud_; }

  // --- Connections. `id` must exist, else std::out_of_range.
  // Adds a connection without opening it; throws std::invalid_argument for values out of range.
  ConnectionId add_connection(const ConnectionParameters& parameters);
  std::size_t connections() const { return connections_.size(); }
  const Connection& connection(ConnectionId id) const { return *connections_.at(id); }
  /// Initiate. Does nothing unless it is closed.
  void connect(ConnectionId id) { connections_.at(id)->open(); }
  /// DS_Read, DS_Write, DS_Transport: in sequence in each connection. Throw std::logic_error if it is closed,
  /// std::invalid_argument for more than 240 bytes of data.
  void read(ConnectionId id, std::uint8_t slot, std::uint8_t index, std::uint8_t length, AcyclicCallback done = {});
  void write(ConnectionId id, std::uint8_t slot, std::uint8_t index, const Bytes& data, AcyclicCallback done = {});
  void transport(ConnectionId id, std::uint8_t slot, std::uint8_t index, const Bytes& data, AcyclicCallback done = {});
  void request(ConnectionId id, const AcyclicRequest& request, AcyclicCallback done = {});
  void abort(ConnectionId id, const AbortReason& reason = {}) { connections_.at(id)->abort(now_, reason); }

  // --- Faults.
  void set_behaviour(ConnectionId id, Behaviour behaviour) { connections_.at(id)->set_behaviour(behaviour); }
  /// Sends any bytes to any SAP of the connection's slave, at the next opportunity.
  void inject(ConnectionId id, RawAcyclic raw) { connections_.at(id)->inject(std::move(raw)); }

  TokenRing& ring() { return ring_; }
  const TokenRing& ring() const { return ring_; }

  std::function<void(Tick at, ConnectionId id, ConnectionState from, ConnectionState to)> on_state;
  std::function<void(Tick at, ConnectionId id, const ConnectionEnd&)> on_end;
  /// Called for every finished operation, after its own callback.
  std::function<void(Tick at, ConnectionId id, const AcyclicResult&)> on_acyclic;
  /// Called for every finished request, including those of the ring.
  std::function<void(Tick at, const FdlResult&)> on_answer;

  Tick next() const override;
  void run(Tick now) override;

 private:
  bool start_next();
  bool use_token();
  void ask(Connection& connection);
  void finished(const FdlResult& result);

  MasterConfig config_;
  MasterFdl fdl_;
  TokenRing ring_;
  std::vector<std::unique_ptr<Connection>> connections_;
  Connection* asking_ = nullptr;  ///< the connection whose telegram is being sent
  int baud_;
  std::optional<int> new_baud_;
  bool running_ = false, start_requested_ = false, stop_requested_ = false;
  std::size_t position_ = 0;  ///< the connection whose turn is next
  std::size_t turns_ = 0;     ///< connections left for this token
  bool had_token_ = false;
  Tick now_ = 0;
};

}  // namespace dsdpv1::bus
