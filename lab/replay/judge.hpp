#pragma once
// Compares the model's answers with the recorded ones.
#include <string>
#include <vector>

#include "lab/replay/firmware.hpp"
#include "lab/replay/listener.hpp"
#include "lab/replay/min_tsdr.hpp"
#include "lab/replay/result.hpp"

namespace dsdpv1::tb::replay {

struct JudgeOptions {
  TsdrRule tsdr;
  std::optional<Tick> from = {};  ///< time of the capture
  bool started = false;           ///< the model was brought into the data exchange in which the capture begins
  bool supplied = true;           ///< the user CPU gives the recorded inputs and diagnoses
  Tick user_cycle = 0;            ///< of its exchanges with the chip
};

class Judge {
 public:
  /// All arguments must outlive it.
  Judge(const Recording& recording, const Firmware& firmware, const std::vector<Supply>& supplies,
        const JudgeOptions& options);
  std::vector<RequestResult> judge(const Listener& listener);

 private:
  struct Supplied {
    std::optional<Tick> inputs, diagnosis, verdict;  ///< time of the last one
    bus::Bytes before;                               ///< the inputs before that change
    bus::Bytes now;
  };
  RequestResult result_of(const RecordedRequest& request, const Heard* heard) const;
  Verdict verdict(std::size_t index, RequestResult& result, const Heard* heard);
  /// Before the slave could answer, or inside of its answer.
  bool capture_ends_after(const RecordedRequest& request) const;
  Verdict compare(RequestResult& result);
  Verdict compare_bytes(RequestResult& result);
  Verdict compare_tsdr(RequestResult& result) const;
  bool slave_restarts() const;
  bool user_was_late(const RequestResult& result) const;
  bool only_old_faults_differ(const RequestResult& result) const;
  void follow_set_up(const RequestResult& result);
  bool is_users_dpv1(const RequestResult& result);
  void follow_supplies(Tick until);
  void follow_dpv1(const RequestResult& result);
  std::string difference_words(const RequestResult& result) const;

  const Recording& recording_;
  const Firmware& firmware_;
  const std::vector<Supply>& supplies_;  ///< given to the user CPU
  const JudgeOptions& options_;
  Beginning beginning_;
  std::size_t next_supply_ = 0;
  Supplied supplied_;
  Tick request_end_ = 0;  ///< of the request being judged
  MinTsdr min_tsdr_;
  std::optional<bool> dpv1_;
  bool dpv1_out_of_step_ = false;
  bool judging_ = false;     ///< a Set_Prm was taken, and no data exchanged since: the user CPU may still judge
  std::uint8_t old_faults_;  ///< bits of Slave_Diag that may come from before the capture
};

}  // namespace dsdpv1::tb::replay
