#pragma once
// The UART port (000 chapter 7; rulings UA1 to UA16; docs/microarchitecture_rsu.md 6): assembles telegrams from
// characters, judges them, executes exchanges and replies.
#include "model/dsdpv1/chip_side.hpp"
#include "model/dsdpv1/config.hpp"
#include "model/dsdpv1/host_commit.hpp"
#include "model/profibus/uart_rx.hpp"
#include "model/profibus/uart_tx.hpp"

namespace dsdpv1 {

class HostUart {
 public:
  HostUart(profibus::EventLog& log, dpram::Ram& ram, const Config& config)
      : log_(log), ram_(ram), config_(config), commit_(log, ram, config.uart_cfg_length != 0) {}

  void reset();
  /// Called when the straps have chosen this port; this edge is the first to be evaluated. `rate`, `interval`: UBR,
  /// UIV.
  void start(Cycle now, int address, int rate, int interval);
  /// RXD changes at `at`.
  void set_rxd(Tick at, bool level);
  bool rxd() const { return rx_.input(); }
  bool txd() const { return tx_.txd(); }

  /// The edge of `now`.
  void eval(Cycle now, const ChipSide& side);
  Cycle next() const;
  /// The chip must not begin an access; valid after eval().
  bool holds() const { return commit_.busy(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, ram, config, rx, tx, telegram, commit, state, address, interval, bit, gap, judge_at, judged, earliest,
           request_end, fall_reported, request, reply, size] = *this;
    archive.given(log, ram, config);
    archive(rx, telegram, fall_reported, request, reply);
    tx.store(archive, reply.data(), kMostReply);
    commit.store(archive, telegram.data());
    archive.within(State::kOff, State::kReply, state);
    archive.within(0, 3, address);
    archive.within(0, 7, interval);
    archive.within(0, kUbrCycles[0], bit);
    archive.lengths(gap);
    archive.cycles(judge_at, judged, earliest, request_end);
    archive.within(0, kMostReply, size);
    archive.check(!commit.busy() || (state == State::kReply && size == 0 && commit.is_of(request)));
  }

 private:
  enum class State : std::uint8_t {
    kOff,
    kWait,   // for the first character
    kIn,     // receiving a telegram
    kDeaf,   // until silence
    kReply,  // judged, not replied yet: RXD is ignored
  };
  void receive(Cycle now);
  void hand_over(Cycle now);
  void spoil(Cycle now, profibus::Reason reason);
  void take_interval(int code);
  Cycle silence_at() const;
  void silence(Cycle now);
  void judge(Cycle now, const ChipSide& side);
  void carry_out(Cycle now);
  void report_falls(Cycle now);
  void reply_error(Cycle now, std::uint8_t code, bool data_exch);
  void reply_done(Cycle now);
  void add(std::uint8_t byte) { reply_.at(static_cast<std::size_t>(size_++)) = byte; }
  void add(const std::uint8_t* bytes, int size) {
    for (int i = 0; i < size; ++i) add(bytes[i]);
  }
  void send(Cycle ready);

  profibus::EventLog& log_;
  dpram::Ram& ram_;
  const Config& config_;
  profibus::UartRx rx_;
  profibus::UartTx tx_;
  HostTelegram telegram_{kUartRules};
  HostCommit commit_;

  State state_ = State::kOff;
  int address_ = 0, interval_ = 0, bit_ = 0;
  Cycle gap_ = 0;  // G
  Cycle judge_at_ = profibus::kNever, judged_ = 0;
  Cycle earliest_ = 0;  // T
  Cycle request_end_ = 0;
  bool fall_reported_ = false;
  Request request_;
  static constexpr int kMostReply = 264;
  std::array<std::uint8_t, kMostReply> reply_{};
  int size_ = 0;
};

}  // namespace dsdpv1
