#pragma once
// The rules of commands, answers and /INT, by UART and SPI alike.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "kinds/xgate/check.hpp"
#include "kinds/xgate/pin_frames.hpp"
#include "tb/chip/checks/duty.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::xgate_checks {

using bus::Tick;

class LinkRules {
 public:
  /// Both must outlive it.
  LinkRules(checks::Recorder& recorder, const xgate::Config& config) : recorder_(recorder), config_(config) {}

  /// /Rst changes.
  void reset(Tick at, bool low);
  void interrupt(Tick at, bool low);
  /// The longest time within a frame (X4); half a bit.
  void set_times(Tick gap, Tick half_bit) {
    gap_ = gap;
    half_bit_ = half_bit;
  }
  /// A byte of a frame that has begun, and the end of the byte before it.
  void byte(Tick end, Tick last_end);
  void frame(const xgate::HostFrame& frame) { frame.answer ? answer(frame) : command(frame); }
  void pass(Tick now);

 private:
  bool by_uart() const { return config_.port == xgate::Port::kUart; }
  void first(Tick start);
  void command(const xgate::HostFrame& frame);
  void judge_form(const xgate::HostFrame& frame);
  void unheard(Tick start);
  void fulfil(const xgate::HostFrame& frame);
  void answer(const xgate::HostFrame& frame);
  void requests(const xgate::HostFrame& frame);
  void early(Tick start, Tick answered);

  checks::Recorder& recorder_;
  const xgate::Config& config_;
  std::optional<Tick> released_;  ///< /Rst rose; nothing has come since
  Tick opens_ = bus::kNever;      ///< the module hears
  Tick gap_ = 0, half_bit_ = 0;
  std::optional<Tick> early_;     ///< begin of what came before the answer's end
  std::optional<Tick> answered_;  ///< end of the last answer; no command since
  Tick last_answer_ = -1;         ///< its end
  checks::Duty int_, parameters_, alarm_;
  std::map<std::uint8_t, checks::Duty> queue_;  ///< by the id of a request
  xgate::HostFrame given_;                      ///< the last command 30
};

}  // namespace dsdpv1::xgate_checks
