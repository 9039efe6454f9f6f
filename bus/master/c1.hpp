#pragma once
// MSAC_C1 of a class-1 master for one slave (7.2, rulings V1, V8, V9): a queue of reads, writes and acknowledgements of
// alarms, one of them in progress. No I/O; the master asks for the next telegram after each pass of the cyclic
// exchange.
#include <cstdint>
#include <deque>
#include <string>

#include "bus/master/acyclic.hpp"
#include "bus/master/fdl.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1::bus {

class C1Client {
 public:
  /// `response_timeout`: C1_Response_Timeout of the GSD file in ticks, from the acknowledgement of the request to its
  /// answer.
  /// `sap`: of the slave, 51, or 50 for Alarm_Ack alone.
  C1Client(std::uint8_t slave, std::uint8_t master, Tick response_timeout, std::uint8_t sap = sap::kMs1)
      : slave_(slave), master_(master), sap_(sap), response_timeout_(response_timeout) {}

  /// Queues an operation; it is sent when the slave is in data exchange and all earlier ones are complete.
  void push(Tick now, AcyclicRequest request, AcyclicCallback done);
  /// Whether a telegram is due: the request of the next operation, or a poll for the present one. Ends the present one,
  /// with its callback, when its time has expired. Only call it in data exchange.
  bool due(Tick now);
  /// The telegram that is due; SRD low, from SAP 51.
  Telegram next_request();
  /// The result of that telegram. FdlOutcome::kAborted: it is sent again.
  void done(Tick now, const FdlResult& result);
  /// The present operation is lost, and Alarm_Acks that wait; others stay queued.
  void leave(Tick now, const std::string& reason);

  /// Operations queued or in progress.
  std::size_t open() const { return operations_.size(); }

 private:
  void drop_acknowledgements(Tick now, const std::string& reason);
  void requested(Tick now, const FdlResult& result);
  void polled(Tick now, const Telegram& answer);
  void finish(Tick now, AcyclicOutcome outcome);
  AcyclicResult& current() { return operations_.front().result; }

  std::uint8_t slave_, master_, sap_;
  Tick response_timeout_;
  std::deque<AcyclicOperation> operations_;
  bool at_work_ = false;       ///< the request of the first operation has been sent
  bool acknowledged_ = false;  ///< ... and acknowledged: waiting for its answer
  bool stale_ = false;  ///< the slave may still hold the answer to an abandoned operation: a poll fetches it before the
                        ///< next request
  bool polling_ = false;  ///< the present telegram is a poll
};

}  // namespace dsdpv1::bus
