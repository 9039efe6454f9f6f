#pragma once
// The acyclic side of a fake slave: one SAP with a user behind it who answers after some polls.
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "bus/acyclic.hpp"
#include "bus/telegram.hpp"

namespace bus::test {

/// Reads get bytes 0, 1, 2, ...; writes are acknowledged; transports come back inverted.
inline Bytes obliging_user(const Bytes& request) {
  Bytes answer(request.begin(), request.begin() + 4);
  if (request[0] == function_num::kRead) {
    for (int i = 0; i < request[3]; ++i) answer.push_back(static_cast<std::uint8_t>(i));
  }
  if (request[0] == function_num::kTransport) {
    for (std::size_t i = 4; i < request.size(); ++i) answer.push_back(static_cast<std::uint8_t>(~request[i]));
  }
  return answer;
}

inline Telegram short_answer(const Telegram& request, std::uint8_t function) {
  return make_telegram(request.sa, request.da, function);
}

inline Telegram data_answer(const Telegram& request, const Bytes& data) {
  return make_telegram(request.sa, request.da, fc::kDl, data, request.ssap, request.dsap);
}

/// A SAP that takes one request at a time (V1, V8).
class FakeMailbox {
 public:
  int busy_polls = 1;  ///< answered E5 before the answer comes; -1: never answered
  std::function<Bytes(const Bytes&)> user = obliging_user;
  std::vector<Bytes> requests;
  int polls = 0;

  Telegram hear(const Telegram& request) {
    if (request.data.empty()) return poll(request);
    if (open_) return short_answer(request, fc::kRr);
    requests.push_back(request.data);
    open_ = request.data;
    left_ = busy_polls;
    return make_sc();
  }
  void drop() { open_.reset(); }
  bool open() const { return open_.has_value(); }
  void answer_now() { left_ = 0; }

 private:
  Telegram poll(const Telegram& request) {
    ++polls;
    if (!open_ || left_ != 0) {
      if (left_ > 0) --left_;
      return make_sc();
    }
    return data_answer(request, user(*std::exchange(open_, std::nullopt)));
  }

  std::optional<Bytes> open_;
  int left_ = 0;
};

}  // namespace bus::test
