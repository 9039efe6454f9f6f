#pragma once
// The user's accesses to the host port, derived from CSR, RD, WR, A and D, checked against table 15 with rulings P5, P8
// and P11.
//
// Pins that change at the same tick may be reported in any order. A write transfers D at WR's rise; a read transfers D
// as the chip drove it until RD or CSR rose. The pins do not show when the user sampled it; a user CPU of the bench
// reports that.
// of the bench tells.
#include <array>
#include <cstdint>
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

/// One byte transferred by the user.
struct Access {
  bool write = false;
  std::uint16_t address = 0;          ///< 0..0x7FF
  std::optional<std::uint8_t> value;  ///< absent if D was not driven or unknown
  Tick began = 0;                     ///< CSR and the strobe are low
  Tick at = 0;                        ///< WR's rise, end of the read
};

class AccessSink {
 public:
  virtual ~AccessSink() = default;
  /// CSR and RD or WR are low; the end of that.
  virtual void access_began(Tick at) = 0;
  virtual void access_ended(Tick at) = 0;
  /// After `access_ended` of a read, before that of a write.
  virtual void accessed(const Access& access) = 0;
};

class PortTiming {
 public:
  PortTiming(Recorder& recorder, AccessSink& sink) : recorder_(recorder), sink_(sink) {}

  /// RESET falls or rises: the chip drops an access that has begun, and takes none while it is low. Levels are kept.
  void reset(bool low);
  /// A change of CSR, RD, WR, A, D_IN or D_OUT.
  void pin(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  /// The next read samples D at `sample`.
  void read(Tick sample) { sample_ = sample; }

 private:
  struct Write {
    std::uint16_t address = 0;
    Tick settles = -1;  ///< CLK edge at which it takes effect; none when negative
  };
  void chip_select(Tick at, bool level);
  void read_strobe(Tick at, bool level);
  void write_strobe(Tick at, bool level);
  void address_changed(Tick at, dsdpv1::Level level);
  void data_changed(Tick at, dsdpv1::Level level);
  void chip_data_changed(Tick at, dsdpv1::Level level);
  void strobes_changed(Tick at);
  void begin_read(Tick at);
  void end_read(Tick at);
  void capture(Tick at);
  void end_holds(Tick at);
  void check_read_back();
  std::optional<std::uint8_t> chip_data(Tick at) const;

  Recorder& recorder_;
  AccessSink& sink_;
  bool in_reset_ = false;
  bool csr_ = true, rd_ = true, wr_ = true, accessing_ = false;
  dsdpv1::Level a_ = 0, d_in_ = dsdpv1::kLevelZ, d_out_ = dsdpv1::kLevelZ;
  Tick a_changed_ = 0, d_changed_ = 0;
  dsdpv1::Level d_out_before_ = dsdpv1::kLevelZ;  ///< before the tick d_out_changed_
  Tick d_out_changed_ = 0;
  Tick began_ = 0;  ///< of the running access

  Tick wr_fell_ = 0;
  std::optional<Tick> csr_early_;        ///< CSR rose while WR was low
  std::optional<Tick> csr_due_;          ///< WR rose, CSR has not yet
  std::optional<Tick> a_hold_, d_hold_;  ///< WR rose, A or D have not changed since
  std::uint16_t written_ = 0;            ///< the address of that write
  std::array<Write, 4> writes_{};        ///< the last ones
  std::size_t write_count_ = 0;

  bool reading_ = false, read_spoilt_ = false;
  std::optional<Tick> sample_;  ///< of D by the user, if known
  Tick sample_edge_ = 0;
  dsdpv1::Level a_read_ = 0;  ///< the address that the chip samples
  Tick a_valid_since_ = 0;    ///< since when it has been valid
};

}  // namespace dsdpv1::checks
