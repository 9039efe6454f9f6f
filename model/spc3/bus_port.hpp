#pragma once
// The CPU's bus at the pins (M tables 2.1 and 6.1; rulings A16, A42): strobes and DB with tick resolution, ready and
// the answer of a read at rising edges; or SPI.
#include <algorithm>

#include "model/profibus/event_log.hpp"
#include "model/spc3/address_map.hpp"
#include "model/spc3/bus_lines.hpp"
#include "model/spc3/spi_port.hpp"

namespace dsdpv1::spc3 {

class BusPort {
 public:
  BusPort(profibus::EventLog& log, const Config& config, AddressMap& map)
      : log_(log), config_(config), map_(map), spi_(log, config, map) {}

  /// RESET is high: accesses that end before release() are reported and do nothing.
  void reset();
  /// At the edge of `now`. An access under way begins.
  void release(Cycle now);
  /// A change of an input that is neither RESET nor of the line. Returns false if no access begins or ends by it:
  /// outputs and plans are as before.
  bool set(Tick at, Pin pin, Level level);
  Level level(Pin pin) const { return lines_.level(pin); }
  /// DB as a user gets it who samples at `at`. A read that has not been ready is served then, or X (A42).
  Level user_samples(Tick at);

  /// The rising edge of `now`, after all other blocks: XREADY, and the answer of a read.
  void eval(Cycle now);
  Cycle next() const { return std::min({ready_at_, fall_at_, release_at_}); }
  bool xready() const { return xready_; }
  /// DB as the chip drives it.
  Level db_out() const { return db_out_; }
  Level miso() const { return spi_.miso(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, config, map, lines, spi, enabled, access, acted, early, both, xready, db_out, ready_at, fall_at,
           release_at] = *this;
    archive.given(log, config, map);
    archive.within(kLevelX, Level{0xFF}, db_out);
    archive.within(Access::kNone, Access::kWrite, access);
    archive(lines, spi, enabled, acted, early, both, xready);
    archive.cycles(ready_at, fall_at, release_at);
  }

 private:
  enum class Access : std::uint8_t { kNone, kRead, kWrite };

  bool set_spi(Tick at, Pin pin, Level level);
  bool follow_strobes(Tick at);
  void begin(Tick at, Access access);
  void await_answer(Tick at);
  unsigned shown_address() const { return static_cast<unsigned>(lines_.address()); }
  void end(Tick at);
  bool is_early(Tick at, Access access);
  void read(Tick at);
  void write(Tick at);
  bool knows_address(Tick at);

  profibus::EventLog& log_;
  const Config& config_;
  AddressMap& map_;
  BusLines lines_;
  SpiPort spi_;
  bool enabled_ = false;
  Access access_ = Access::kNone;
  bool acted_ = false;                           ///< the running read has its answer
  bool told_early_ = false, told_both_ = false;  ///< reported for the running access
  bool xready_ = true;
  Level db_out_ = kLevelZ;
  Cycle ready_at_ = profibus::kNever;  ///< the edge at which a read has its answer, and a write may end
  Cycle fall_at_ = profibus::kNever, release_at_ = profibus::kNever;  ///< edges of XREADY, if the bus has it
};

}  // namespace dsdpv1::spc3
