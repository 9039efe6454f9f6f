#pragma once
// The acyclic side of a fake slave: one SAP whose user answers after some polls.
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "bus/master/acyclic.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1::bus::test {

/// Reads get bytes 0, 1, 2, ...; writes are acknowledged; transports come back inverted.
inline Bytes obliging_user(const Bytes& request) {
  Bytes answer(request.begin(), request.begin() + 4);
  if (request[0] == function_num::kRead)
    for (int i = 0; i < request[3]; ++i) answer.push_back(static_cast<std::uint8_t>(i));
  if (request[0] == function_num::kTransport)
    for (std::size_t i = 4; i < request.size(); ++i) answer.push_back(static_cast<std::uint8_t>(~request[i]));
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

/// Two channels of MSAC_C2 by V2, V3, V8 and V10 to V12; timers are checked when the next telegram comes.
class FakeC2 {
 public:
  explicit FakeC2(std::function<Tick()> clock) : clock_(std::move(clock)) {}

  struct Channel {
    std::uint8_t sap = 0, master = 0;
    enum class State { kFree, kInitiated, kOpen, kBusy } state = State::kFree;
    Tick deadline = kNever;
    bool idle = false;
    Bytes initiate = {};
    FakeMailbox mailbox = {};
  };
  std::array<Channel, 2> channels = {Channel{0x30}, Channel{0x2F}};
  int immediate_polls = 0;    ///< Initiate is acknowledged, the immediate answer comes at a poll of SAP 49
  Bytes initiate_answer;      ///< instead of the right one
  Bytes abort_next;           ///< the next answer of any channel
  std::vector<Bytes> aborts;  ///< of the master
  int idles = 0;
  std::uint16_t send_timeout = 0;

  Telegram hear(const Telegram& request) {
    if (request.ssap != sap::kMs2Master) return short_answer(request, fc::kRs);
    if (request.dsap == sap::kMs2Rm) return manager(request);
    for (Channel& channel : channels)
      if (request.dsap == channel.sap && channel.state != Channel::State::kFree && channel.master == request.sa)
        return serve(channel, request);
    return short_answer(request, fc::kRs);
  }
  /// SDN: only the abort counts.
  void hear_unanswered(const Telegram& request) {
    if (!request.data.empty() && request.data[0] == function_num::kAbort) hear(request);
  }

 private:
  using State = Channel::State;
  Tick units(int count) const { return clock_() + count * send_timeout * kTimeUnit10ms; }

  Telegram manager(const Telegram& request) {
    if (request.data.empty()) return given_ != nullptr ? immediate(request) : make_sc();
    for (Channel& channel : channels) {
      if (channel.state != State::kFree) continue;
      channel.state = State::kInitiated;
      channel.master = request.sa;
      channel.initiate = request.data;
      send_timeout = static_cast<std::uint16_t>((request.data[4] << 8) | request.data[5]);
      channel.deadline = units(1);
      given_ = &channel;
      return immediate_polls > 0 ? make_sc() : immediate(request);
    }
    return short_answer(request, fc::kRs);
  }

  Telegram immediate(const Telegram& request) {
    if (request.data.empty() && --immediate_polls > 0) return make_sc();
    const Channel& channel = *std::exchange(given_, nullptr);
    return data_answer(request, {0x56, channel.sap, static_cast<std::uint8_t>(send_timeout >> 8),
                                 static_cast<std::uint8_t>(send_timeout & 0xFF)});
  }

  Telegram serve(Channel& channel, const Telegram& request) {
    const bool poll = request.data.empty();
    if (!poll && request.data[0] == function_num::kAbort) {
      aborts.push_back(request.data);
      return free(channel, make_sc());
    }
    if (clock_() > channel.deadline) {
      const std::uint8_t detail = channel.state == State::kOpen ? 2 : 1;
      return free(channel, data_answer(request, {0x58, 0, 0x13, detail}));
    }
    if (!abort_next.empty()) return free(channel, data_answer(request, std::exchange(abort_next, {})));
    if (channel.state == State::kInitiated) return connect(channel, request);
    if (poll && channel.idle) return idle_answer(channel, request);
    Telegram answer = !poll && request.data[0] == function_num::kIdle ? idle(channel) : channel.mailbox.hear(request);
    if (!poll || channel.state == State::kBusy) {
      channel.state = channel.mailbox.open() || channel.idle ? State::kBusy : State::kOpen;
      channel.deadline = units(channel.state == State::kOpen ? 2 : 1);
    }
    return answer;
  }

  Telegram connect(Channel& channel, const Telegram& request) {
    if (!request.data.empty()) return free(channel, data_answer(request, {0x58, 0, 0x11, 0}));
    channel.state = State::kOpen;
    channel.deadline = units(2);
    if (!initiate_answer.empty()) return data_answer(request, initiate_answer);
    Bytes answer = {0x57, 0xF0, 1, 0, 0, 0, 0, 0};
    answer.insert(answer.end(), channel.initiate.begin() + 12, channel.initiate.end());
    return data_answer(request, answer);
  }

  Telegram idle(Channel& channel) {
    ++idles;
    channel.idle = true;
    return make_sc();
  }

  Telegram idle_answer(Channel& channel, const Telegram& request) {
    channel.idle = false;
    channel.state = State::kOpen;
    channel.deadline = units(2);
    return data_answer(request, {0x48});
  }

  static Telegram free(Channel& channel, const Telegram& answer) {
    channel.state = State::kFree;
    channel.idle = false;
    channel.deadline = kNever;
    channel.mailbox.drop();
    return answer;
  }

  std::function<Tick()> clock_;
  Channel* given_ = nullptr;
};

}  // namespace dsdpv1::bus::test
