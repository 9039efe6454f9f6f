#pragma once
// The SPI port (000 chapter 6; rulings SP1 to SP18; docs/microarchitecture_rsu.md 5): assembles telegrams from frames
// of XSS, judges them and replies; ownership by B014, U_Timer.
#include "model/dsdpv1/chip_side.hpp"
#include "model/dsdpv1/host_commit.hpp"
#include "model/dsdpv1/spi_reply.hpp"
#include "model/dsdpv1/spi_shift.hpp"

namespace dsdpv1 {

class SpiPort {
 public:
  SpiPort(profibus::EventLog& log, dpram::Ram& ram, const Config& config)
      : log_(log), ram_(ram), config_(config), shift_(log, config), commit_(log, ram, false) {}

  void reset();
  /// Called when the straps have chosen this port; this edge is the first to be evaluated.
  void start(int address) { address_ = address; }
  SpiShift& shift() { return shift_; }
  const SpiShift& shift() const { return shift_; }

  /// The edge of `now`.
  void eval(Cycle now, const ChipSide& side);
  Cycle next() const;
  /// The chip must not begin an access; valid after eval().
  bool holds() const { return claimed_ || commit_.busy() || frame_holds_; }
  /// B014, `owns` as before the edge.
  std::uint8_t ownership(bool owns) const {
    return static_cast<std::uint8_t>((claimed_ ? regs::kOwnershipHost : 0) | (owns ? regs::kOwnershipChip : 0));
  }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, ram, config, shift, telegram, commit, reply, address, xss, flip, frame, bytes, gap_until, write_ended,
           request, frame_over, replies, frame_holds, judge_at, load_at, load_slot, load_value, claimed, claimed_at,
           u_at] = *this;
    archive.given(log, ram, config);
    archive(shift, telegram, reply, xss, flip, request, frame_over, replies, frame_holds, load_value, claimed);
    commit.store(archive, telegram.data());
    archive.within(0, 3, address);
    archive.within(Frame::kNone, Frame::kComplete, frame);
    archive.within(0, 1 << 30, bytes, load_slot);
    archive.cycles(gap_until, judge_at, load_at, claimed_at, u_at);
    archive.ticks(write_ended);
  }

 private:
  enum class Frame : std::uint8_t {
    kNone,      // XSS is high
    kDeaf,      // everything is ignored until XSS rises
    kRequest,   // bytes of the request
    kComplete,  // bytes after the request
  };
  void frame_begins(Cycle now);
  void begins_with_wait(Cycle now);
  bool report_gap(Cycle now);
  void hand_over(Cycle now, const ChipSide& side);
  void take_request(Cycle now);
  void frame_ends(Cycle now);
  void judge(Cycle now, const ChipSide& side);
  std::uint8_t judge_right(Cycle now, const ChipSide& side, bool& good);
  bool refused(Cycle now, const ChipSide& side);
  void carry_out(Cycle now);
  void set_claimed(Cycle now, bool claimed);
  void report_no_claim(Cycle now);
  void begin_reply(Cycle now, const ChipSide& side, bool good, std::uint8_t code);
  std::uint8_t next_reply_byte(const ChipSide& side);
  std::uint8_t read(regs::Address address, const ChipSide& side) const;
  void report_cut(Cycle now, int sent);
  void restart_u_timer(Cycle now);
  void end_u_timer(Cycle now);

  profibus::EventLog& log_;
  dpram::Ram& ram_;
  const Config& config_;
  SpiShift shift_;
  HostTelegram telegram_{kSpiRules};
  HostCommit commit_;
  SpiReply reply_;

  int address_ = 0;                 // ADR
  bool xss_ = true, flip_ = false;  // at the edge before
  Frame frame_ = Frame::kNone;
  int bytes_ = 0;  // k
  Cycle gap_until_ = 0;
  Tick write_ended_ = Wire::kLongAgo;  // the last bit of the last write or read-and-write telegram

  // of the telegram that is judged or replied to
  Request request_;
  bool frame_over_ = false, replies_ = false, frame_holds_ = false;
  Cycle judge_at_ = profibus::kNever, load_at_ = profibus::kNever;
  int load_slot_ = 0;
  std::uint8_t load_value_ = 0xFF;

  bool claimed_ = false;  // B014.1
  Cycle claimed_at_ = 0, u_at_ = profibus::kNever;
};

}  // namespace dsdpv1
