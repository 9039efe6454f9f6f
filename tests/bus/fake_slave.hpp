#pragma once
// Stations of the tests: a scripted one, and based on it a small DP slave.
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/telegram/telegram.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::bus::test {

struct Reply {
  Bytes bytes = {};
  int tsdr_millibits = kMinTsdrBits * 1000;
  WireFaults faults = {};
};

/// Answers every valid telegram with `script`; nullopt = silence.
class FakeStation : public Listener, public Agent {
 public:
  using Script = std::function<std::optional<Reply>(const Telegram&)>;

  FakeStation(Segment& segment, Timeline& timeline, std::string name = "slave")
      : station(segment.attach(std::move(name), this)), sender_(segment, station) {
    receiver_.on_character = [this](const ReceivedCharacter& received) { character(received); };
    timeline.check_announcements();
    timeline.add(*this);
  }

  void set_baud(int index) {
    bit_ = baud(index).bit;
    sender_.set_timing(bit_);
    receiver_.set_bit(bit_);
    announce();
  }

  void line_changed(Tick at, bool level) override {
    if (!sending_ && receiver_.line_changed(at, level)) announce();
  }
  Tick next() const override { return sending_ ? sender_.next() : receiver_.next(); }
  void run(Tick now) override {
    if (sending_) {
      sender_.run(now);
      sending_ = sender_.busy();
      return;
    }
    receiver_.run(now);
  }

  StationId station;
  Script script;
  std::vector<Telegram> heard;
  std::vector<Tick> starts, ends;  ///< of the received telegrams

 private:
  void character(const ReceivedCharacter& received) {
    if (received.start - last_end_ > 30 * bit_) decoder_ = {};
    if (!decoder_.begun()) start_ = received.start;
    last_end_ = received.end;
    const auto decoded = received.ok() ? decoder_.feed(received.byte) : std::nullopt;
    if (!decoded || decoded->error != DecodeError::kNone) return;
    heard.push_back(decoded->telegram);
    starts.push_back(start_);
    ends.push_back(received.end);
    if (const auto reply = script ? script(decoded->telegram) : std::nullopt) answer(received.end, *reply);
  }

  void answer(Tick end, const Reply& reply) {
    sending_ = true;
    sender_.send(end + bit_ * reply.tsdr_millibits / 1000, characters(reply.bytes, reply.faults));
  }

  UartSender sender_;
  UartReceiver receiver_;
  TelegramDecoder decoder_;
  Tick bit_ = baud(0).bit, last_end_ = 0, start_ = 0;
  bool sending_ = false;
};

/// Just enough of a DP slave: two bytes in, two bytes out, ident 0x0B9A.
class FakeDpSlave {
 public:
  FakeDpSlave(Segment& segment, Timeline& timeline, std::uint8_t address)
      : station(segment, timeline, "slave " + std::to_string(address)), address_(address) {
    station.script = [this](const Telegram& telegram) { return hear(telegram); };
  }

  enum class State { kWaitPrm, kJudging, kWaitCfg, kDataExchange };
  State state = State::kWaitPrm;
  int judge_requests = 0;           ///< Slave_Diag answers with Station_Not_Ready after Set_Prm
  bool cfg_fault = false;           ///< refuses the next configuration
  std::uint8_t extra_status_2 = 0;  ///< Stat_Diag
  std::uint16_t ident = 0x0B9A;
  Bytes blocks;                ///< of Slave_Diag, after the standard bytes
  bool high_priority = false;  ///< until Slave_Diag
  int silent_for = 0;          ///< so many requests are not answered
  int broken_for = 0;          ///< so many answers have a wrong FCS
  Bytes inputs = {0x11, 0x22}, outputs = {0, 0};
  std::function<Telegram(const Telegram&)> acyclic;  ///< answers SAPs 47 to 51; without it they are refused with RS
  std::function<void(const Telegram&)> unanswered;   ///< receives SDN
  bool acyclic_silent = false;                       ///< requests to these SAPs are not answered
  std::vector<Telegram> requests;                    ///< to this station, repetitions included
  int executed = 0, repetitions = 0, empty_outputs = 0;
  Bytes prm, cfg;
  FakeStation station;

 private:
  std::optional<Reply> hear(const Telegram& telegram) {
    if (!telegram.is_request() || (telegram.da != address_ && telegram.da != kBroadcast)) return std::nullopt;
    requests.push_back(telegram);
    if (!telegram.wants_answer()) {
      if (unanswered) unanswered(telegram);
      return std::nullopt;
    }
    if (acyclic_silent && telegram.dsap && *telegram.dsap <= sap::kMs1) return std::nullopt;
    if (!repetition(telegram)) answer_ = execute(telegram);
    if (silent_for > 0) {
      --silent_for;
      return std::nullopt;
    }
    Reply reply{encode(answer_)};
    if (broken_for > 0) {
      --broken_for;
      ++reply.bytes.back();
    }
    return reply;
  }

  bool repetition(const Telegram& telegram) {
    const bool fcb = (telegram.fc & fc::kFcb) != 0;
    const bool same = (telegram.fc & fc::kFcv) != 0 && fcb == fcb_ && telegram.sa == fcb_master_;
    fcb_ = fcb;
    fcb_master_ = telegram.sa;
    repetitions += same ? 1 : 0;
    return same;
  }

  Telegram answer(std::uint8_t function, const Bytes& data, const Telegram& to) const {
    return make_telegram(to.sa, address_, function, data, to.ssap, to.dsap);
  }

  Telegram execute(const Telegram& request) {
    ++executed;
    if (request.function() == fc::kFdlStatus) return make_telegram(request.sa, address_, fc::kOk);
    if (!request.dsap) return exchange(request);
    switch (*request.dsap) {
      case sap::kSlaveDiag: return diagnosis(request);
      case sap::kSetPrm: return set_prm(request);
      case sap::kChkCfg: return chk_cfg(request);
      case sap::kReadInputs: return answer(fc::kDl, inputs, request);
      case sap::kReadOutputs: return answer(fc::kDl, outputs, request);
      case sap::kGetCfg: return answer(fc::kDl, cfg, request);
      default: return acyclic ? acyclic(request) : make_telegram(request.sa, address_, fc::kRs);
    }
  }

  Telegram exchange(const Telegram& request) {
    if (state != State::kDataExchange) return make_telegram(request.sa, address_, fc::kRs);
    if (request.data.empty()) ++empty_outputs;
    outputs = request.data;
    return make_telegram(request.sa, address_, high_priority ? fc::kDh : fc::kDl, inputs);
  }

  Telegram diagnosis(const Telegram& request) {
    high_priority = false;
    const bool exchanging = state == State::kDataExchange, waiting = state == State::kWaitPrm;
    const unsigned status_1 = (exchanging ? 0U : 0x02U) | (cfg_fault_ ? 0x04U : 0U);
    const unsigned status_2 = 0x04U | (waiting ? 0x01U : 0U) | extra_status_2;
    if (state == State::kJudging && --judge_requests <= 0) state = State::kWaitCfg;
    Bytes data = {static_cast<std::uint8_t>(status_1),
                  static_cast<std::uint8_t>(status_2),
                  0,
                  static_cast<std::uint8_t>(waiting ? 255 : request.sa),
                  static_cast<std::uint8_t>(ident >> 8),
                  static_cast<std::uint8_t>(ident & 0xFF)};
    data.insert(data.end(), blocks.begin(), blocks.end());
    return answer(fc::kDl, data, request);
  }

  Telegram set_prm(const Telegram& request) {
    prm = request.data;
    cfg_fault_ = false;
    const bool unlock = (prm[0] & 0x40U) != 0;
    state = unlock ? State::kWaitPrm : judge_requests > 0 ? State::kJudging : State::kWaitCfg;
    return make_sc();
  }

  Telegram chk_cfg(const Telegram& request) {
    if (state != State::kWaitCfg) return make_telegram(request.sa, address_, fc::kRs);
    cfg = request.data;
    cfg_fault_ = std::exchange(cfg_fault, false);
    state = cfg_fault_ ? State::kWaitPrm : State::kDataExchange;
    return make_sc();
  }

  std::uint8_t address_;
  bool fcb_ = false, cfg_fault_ = false;
  std::uint8_t fcb_master_ = 255;
  Telegram answer_;
};

}  // namespace dsdpv1::bus::test
