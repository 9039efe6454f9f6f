#pragma once
// One access of the user CPU to the host port as edges of the pins: for user CPUs of the bench and for adapters that
// turn transactions into pins.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "model/dsdpv1/pins.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1 {

/// Table 15 in ticks.
constexpr Tick kTs = 150;  ///< 12.5 ns, WR low
constexpr Tick kTd = 150;  ///< 12.5 ns, A and D stable before and after WR rises
constexpr Tick kTw = 375;  ///< 31.25 ns, RD's fall to certain data

/// When the pins move during one access, in ticks of 1/12 ns (table 15, rulings P5 and P11). The strobe is RD or WR.
///
///   A      --<=================>--     address_setup before the strobe falls, address_hold after it rises
///   CSR    ---\_______________/---     cs_lead before, cs_trail after
///   RD/WR  ------\_________/------     rd_low or wr_low
///   D in   ---------------|-------     read: sampled rd_sample after RD fell
///   D out  ---------<==========>--     write: data_setup before WR rises, data_hold after it
///
/// Values may be negative where that makes sense, so that each limit can be kept exactly, kept with margin, or
/// violated. The defaults model a CPU at 72 MHz (HCLK 13.9 ns) such as an STM32F103. Writes are those of its FSMC with
/// ADDSET = 1, DATAST = 5: 2 HCLK of address phase, WR low for 5 HCLK, 1 HCLK of hold. Reads have the same frame, RD
/// low for 6 HCLK and sampled 1 HCLK before its rise, which no setting of the FSMC gives. Between accesses A is 0x7FF
/// and D released, so that a bus which holds its value cannot mask an address removed too early. A byte just written
/// may be read after 750 ticks from the rise of WR to the next fall of RD (P8).
struct AccessTiming {
  Tick address_setup = 333;  ///< Tc: >= 0; negative: A arrives after the strobe fell
  Tick cs_lead = 333;        ///< CSR falls before the strobe
  Tick rd_low = 1000;        ///< > 0
  Tick rd_sample = 833;      ///< Tw: >= 375 (31.25 ns) to be certain of the data
  Tick wr_low = 833;         ///< Ts: >= 150 (12.5 ns)
  Tick data_setup = 833;     ///< Td: >= 150; negative: D arrives after WR rose
  Tick data_hold = 167;      ///< Td: >= 150; 0: D is released together with WR
  Tick address_hold = 167;   ///< after the strobe rose; Td for writes
  Tick cs_trail = 167;       ///< CSR rises after the strobe
  Tick recovery = 333;       ///< from the last edge to the next access; >= 0
};
bool operator==(const AccessTiming& a, const AccessTiming& b);

/// The edges of one access in order of time. Ticks count from the first edge.
class HostAccess {
 public:
  static constexpr Level kIdleAddress = 0x7FF;  ///< A between accesses

  struct Edge {
    Tick at = 0;
    Pin pin = Pin::kA;  ///< kDOut: D is sampled
    Level level = 0;
  };

  HostAccess() = default;  ///< no edges
  static HostAccess read(std::uint16_t address, const AccessTiming& timing);
  static HostAccess write(std::uint16_t address, std::uint8_t value, const AccessTiming& timing);

  /// Changes the cell; `value` is used in a write only.
  void aim(std::uint16_t address, std::uint8_t value);

  std::size_t size() const { return size_; }
  const Edge& operator[](std::size_t number) const { return edges_.at(number); }
  const Edge* begin() const { return edges_.data(); }
  const Edge* end() const { return edges_.data() + size_; }
  /// From the first edge to the last.
  Tick last() const { return edges_[size_ - 1].at; }
  /// From the first edge to the end of the recovery time.
  Tick duration() const { return duration_; }
  /// From the first edge to the sample of D; for a read.
  Tick sample() const { return times_.data; }

  /// When, from the first edge on, each pin is set and released. D of a read: when it is sampled.
  struct Times {
    Tick address, address_end, select, select_end, strobe, strobe_end, data, data_end;
  };
  const Times& times() const { return times_; }
  bool is_write() const { return write_; }
  std::uint16_t address() const { return static_cast<std::uint16_t>(edges_[address_].level); }
  std::uint8_t value() const { return static_cast<std::uint8_t>(edges_[value_].level); }
  /// The access keeps table 15, and A, D and CSR are stable as long as needed: alone it violates nothing.
  bool is_right() const { return right_; }

 private:
  void frame(Pin strobe, Tick low, const AccessTiming& timing);
  void add(Tick at, Pin pin, Level level) { edges_.at(size_++) = {at, pin, level}; }
  void order(Tick recovery);
  std::size_t edge_of(Pin pin, Level level) const;
  Times find_times() const;
  bool keeps_limits() const;

  std::array<Edge, 8> edges_{};
  std::size_t size_ = 0;
  std::size_t address_ = 0, value_ = 0;  ///< the edges that set them; a read has no second one: size_
  Tick duration_ = 0;
  Times times_ = {};
  bool write_ = false, right_ = false;
};

constexpr std::size_t kMostChanges = 11;  ///< of the pins in an access: 8, or 7 and 4 of D

/// Writes the changes of the pins, in order of time, of an access that keeps all limits and that the chip carries out
/// as a whole: the host's, and of a read those of D, which the chip drives at a falling edge of its clock (P5). The
/// first edge is at `begin`, a tick of the chip; `read`: the byte read. `Change{at, number(pin), level}`. Returns their
/// end.
template <class Change, class Number>
Change* changes_of_whole(const HostAccess& access, Tick begin, Level read, const Number& number,
                         std::array<Change, kMostChanges>& changes) {
  Change* last = changes.data();
  for (const HostAccess::Edge& edge : access)
    if (edge.pin != Pin::kDOut) *last++ = {begin + edge.at, number(edge.pin), edge.level};
  if (access.is_write()) return last;
  const auto insert = [&](Tick at, Level level) {
    Change* place = last++;
    for (; place != changes.data() && place[-1].at > at; --place) *place = place[-1];
    *place = {at, number(Pin::kDOut), level};
  };
  const HostAccess::Times& times = access.times();
  const Tick fall = begin + std::max(times.select, times.strobe);
  insert(fall, kLevelX);
  insert(profibus::first_edge_after(fall) * profibus::kTicksPerCycle + profibus::kTicksPerCycle / 2, read);
  insert(begin + std::min(times.select_end, times.strobe_end), kLevelZ);
  return last;
}

/// Makes accesses one after another. Accesses with the same timing differ in address and value only, so their edges are
/// sorted once.
class HostAccessMaker {
 public:
  /// Valid until the next call. `value` of a write.
  const HostAccess& make(bool write, std::uint16_t address, std::uint8_t value, const AccessTiming& timing);

 private:
  struct Shape {
    AccessTiming timing;
    HostAccess access;
  };
  std::array<Shape, 2> shapes_;  ///< of reads, of writes
};

}  // namespace dsdpv1
