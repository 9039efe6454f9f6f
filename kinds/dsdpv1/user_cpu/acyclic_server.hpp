#pragma once
// The DPV1 side of the standard user program: objects by slot and index with their memory, I&M0, and answers that come
// at once, late, never, or as an error.
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bus/time.hpp"
#include "driver/dsdpv1_acyclic.h"
#include "tb/chip/user_cpu/acyclic.hpp"

namespace dsdpv1::user_cpu {

struct AcyclicCounters {
  std::uint64_t requests = 0;  ///< fetched with the right CRC
  std::uint64_t answers = 0;   ///< passed to the chip, the next two included
  std::uint64_t refusals = 0;  ///< negative ones
  std::uint64_t repeated = 0;  ///< written again: the chip had found the CRC wrong
  std::uint64_t dropped = 0;   ///< answers or requests that were abandoned
};

/// Not copied or moved: the driver points into it.
class AcyclicServer {
 public:
  explicit AcyclicServer(AcyclicOptions options);
  AcyclicServer(const AcyclicServer&) = delete;
  AcyclicServer& operator=(const AcyclicServer&) = delete;

  /// Once, for an opened device.
  dsdpv1_error open(dsdpv1_device& device);
  /// Fetches and answers waiting requests; `now` starts the delay of those that arrive.
  dsdpv1_error poll(Tick now);

  /// A request of a master of class 1 or 2 as a PDU, for a chip that hands it over whole: the answer, nothing for
  /// Answering::kNever. At once: the options' delay is not waited for.
  std::optional<std::vector<std::uint8_t>> answer(unsigned master_class, const std::vector<std::uint8_t>& pdu);

  void set_answering(Answering answering) { options_.answering = answering; }
  const AcyclicCounters& counters() const { return counters_; }
  const std::vector<AcyclicObject>& objects() const { return options_.objects; }

 private:
  struct Later {
    Tick due = 0;
    std::uint16_t ticket = 0;
    bool refuse = false;
    std::vector<std::uint8_t> data;
  };
  struct Entry {  // a handler's context
    AcyclicServer* server = nullptr;
    AcyclicObject* object = nullptr;
  };
  static dsdpv1_outcome handle(void* ctx, const dsdpv1_request* request, dsdpv1_reply* reply);
  dsdpv1_outcome serve(AcyclicObject& object, const dsdpv1_request& request, dsdpv1_reply& reply);
  dsdpv1_error answer_due(Tick now);
  void fill_table();
  void fill_im0(const Nameplate& nameplate);
  void count(const dsdpv1_acyclic_result& result);

  AcyclicOptions options_;
  std::vector<Entry> entries_;
  std::vector<dsdpv1_object> table_;
  dsdpv1_im0 im0_{};
  dsdpv1_acyclic acyclic_{};
  std::deque<Later> later_;  ///< in order of their times
  Tick now_ = 0;
  AcyclicCounters counters_;
};

}  // namespace dsdpv1::user_cpu
