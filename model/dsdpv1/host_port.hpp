#pragma once
// The asynchronous 8-bit user port (5.2, figure 6, table 15; rulings P5, P6, P8, P11, P12): CSR, RD, WR, A and D with
// tick resolution, the DPRAM with cycle resolution.
#include <algorithm>
#include <array>

#include "model/dpram/ram.hpp"
#include "model/dsdpv1/host_access.hpp"
#include "model/dsdpv1/pins.hpp"
#include "model/profibus/event_log.hpp"

namespace dsdpv1 {

using dpram::Ram;

class HostPort {
 public:
  HostPort(profibus::EventLog& log, Ram& ram) : log_(log), ram_(ram) {}

  /// In reset the port neither reads nor writes; `release` ends the reset.
  void reset();
  void release() { enabled_ = true; }
  /// A change of CSR, RD, WR, A or D_IN at `at`.
  void set(Tick at, Pin pin, Level level);
  void set_handshake(bool r_req, bool r_sta) {
    r_req_ = r_req;
    r_sta_ = r_sta;
  }
  Level level(Pin pin) const;
  /// An access with its first edge at `begin` is certain to report nothing and is not affected by an earlier one, as
  /// long as the user keeps R_REQ and R_STA.
  bool is_plain(Tick begin, const HostAccess& access) const { return holds() && is_plain_but_for_hold(begin, access); }
  /// Executes a whole plain access, replacing its edges; a read returns `sampled`. Returns false, without any effect,
  /// if the access is not plain.
  bool carry_out(Tick begin, const HostAccess& access, Level& sampled);
  /// True for a read that would be plain with a hold. Its edges are replaced by tell_unheld() at the fall of CSR and RD
  /// and read_unheld() with the level that it samples; `unreadable` as in eval().
  bool is_plain_unheld(Tick begin, const HostAccess& access) const {
    return !holds() && !access.is_write() && is_plain_but_for_hold(begin, access);
  }
  void tell_unheld(Tick fall, const HostAccess& access);
  Level read_unheld(Tick begin, const HostAccess& access, bool unreadable);

  /// The rising edge of `now`: writes that settle, the address of a read. As before the edge, `owned`: L_STA is high
  /// (P12), `started_up`: the start-up access has begun (H6).
  void eval(Cycle now, bool owned, bool started_up);
  /// Writes up to the edge of `cycle` settle, as eval() does it, also before the present time.
  void settle_until(Cycle cycle, bool started_up);
  Cycle next() const;
  /// As next(), without writes that settle while the user owns the DPRAM, except those that may be reported then.
  Cycle next_seen() const { return holds() ? std::min(sample_at_, next_judged()) : next(); }
  /// The falling edge at which D is driven.
  Tick drive_at() const { return drive_at_; }
  void drive();

  /// D as the chip drives it now.
  Level d_out() const { return d_out_; }
  /// The level of D that a user gets who samples at `at`: X before Tw (P5).
  Level user_samples(Tick at);

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, ram, enabled, csr, rd, wr, r_req, r_sta, a, d_in, wr_fell, lines_changed, captured, hold_reported,
           writes, first_write, write_count, reading, read_spoilt, tw_reported, read_began, sample_at, drive_at,
           sampled, d_out, captured_address] = *this;
    archive.given(log, ram);
    archive(enabled, csr, rd, wr, r_req, r_sta, hold_reported, writes, reading, read_spoilt, tw_reported);
    archive.within(0, kHighestLevel, a, captured_address);
    archive.within(kLevelX, kHighestLevel, d_in, sampled, d_out);
    archive.ticks(wr_fell, lines_changed, captured, read_began, drive_at);
    archive.within(0U, kWritesInFlight - 1, first_write);
    archive.within(0U, kWritesInFlight, write_count);
    archive.cycles(sample_at);
  }

 private:
  static constexpr unsigned kWritesInFlight = 4;
  struct Write {
    Cycle settles = 0;
    regs::Address address = 0;
    std::uint8_t value = 0;
    bool good = true;

    template <class Archive>
    void store(Archive& archive) {
      auto& [at, cell, byte, right] = *this;
      archive.cycles(at);
      archive(cell, byte, right);
    }
  };
  bool holds() const { return r_req_ && r_sta_; }
  bool is_plain_but_for_hold(Tick begin, const HostAccess& access) const;
  void chip_select(Tick at, bool level);
  void read_strobe(Tick at, bool level);
  void write_strobe(Tick at, bool level);
  void lines_changed(Tick at);
  void begin_read(Tick at);
  void end_read(Tick at);
  void check_tw(Tick at);
  void capture(Tick at);
  bool check_capture(Tick at);
  void settle(const Write& write, bool started_up);
  Cycle next_judged() const;
  Level sample(Cycle now, bool unreadable);
  bool in_flight(regs::Address address) const;
  bool may_set_bits(const HostAccess& access) const;
  void write_at_once(Tick begin, const HostAccess& access);
  void read_at_once(Tick begin, const HostAccess& access);
  void check_owner(Tick at);
  Write& write_at(unsigned i) { return writes_[(first_write_ + i) % kWritesInFlight]; }
  const Write& write_at(unsigned i) const { return writes_[(first_write_ + i) % kWritesInFlight]; }

  profibus::EventLog& log_;
  Ram& ram_;
  bool enabled_ = false;
  bool csr_ = true, rd_ = true, wr_ = true;
  bool r_req_ = false, r_sta_ = false;
  regs::Address a_ = 0;
  Level d_in_ = kLevelZ;
  Tick wr_fell_ = 0, lines_changed_ = -kTd, captured_ = -kTd;
  bool hold_reported_ = true;  // or nothing has been captured yet

  std::array<Write, kWritesInFlight> writes_{};
  unsigned first_write_ = 0, write_count_ = 0;

  bool reading_ = false, read_spoilt_ = false;
  bool tw_reported_ = false;  ///< for the running read, to report it only once
  Tick read_began_ = 0;
  Cycle sample_at_ = profibus::kNever;
  Tick drive_at_ = profibus::kNever;
  Level sampled_ = kLevelX, d_out_ = kLevelZ;
  regs::Address captured_address_ = 0;
};

}  // namespace dsdpv1
