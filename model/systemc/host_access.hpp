#pragma once
// One access of the user CPU to the host port as edges of the pins, for whoever turns transactions into pins.
#include <array>
#include <cstddef>
#include <cstdint>

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::systemc {

/// When the pins move during one access, in ticks of 1/12 ns (table 15, rulings P5 and P11). The strobe is RD or WR.
///
///   A      --<=================>--     address_setup before the strobe falls, address_hold after it rises
///   CSR    ---\_______________/---     cs_lead before, cs_trail after
///   RD/WR  ------\_________/------     rd_low or wr_low
///   D in   ---------------|-------     read: sampled rd_sample after RD fell
///   D out  ---------<==========>--     write: data_setup before WR rises, data_hold after it
///
/// The defaults are those of an STM32F103 at 72 MHz: FSMC mode 1, ADDSET = 1, DATAST = 5. Between accesses A is 0x7FF
/// and D released. From the rise of WR to the next fall of RD 750 ticks must pass before a byte just written may be
/// read (P8).
struct AccessTiming {
  Tick address_setup = 333;  ///< Tc: >= 0
  Tick cs_lead = 333;
  Tick rd_low = 1000;     ///< Tw: >= 375
  Tick rd_sample = 833;   ///< Tw: >= 375
  Tick wr_low = 833;      ///< Ts: >= 150
  Tick data_setup = 833;  ///< Td: >= 150
  Tick data_hold = 167;   ///< Td: >= 150
  Tick address_hold = 167;
  Tick cs_trail = 167;
  Tick recovery = 333;  ///< from the last edge to the next access; >= 0
};

/// The edges of one access in order of time. Ticks count from the first edge.
class HostAccess {
 public:
  static constexpr Level kIdleAddress = 0x7FF;  ///< A between accesses

  struct Edge {
    Tick at = 0;
    Pin pin = Pin::kA;  ///< kDOut: D is sampled
    Level level = 0;
  };

  static HostAccess read(std::uint16_t address, const AccessTiming& timing);
  static HostAccess write(std::uint16_t address, std::uint8_t value, const AccessTiming& timing);

  const Edge* begin() const { return edges_.data(); }
  const Edge* end() const { return edges_.data() + size_; }
  /// From the first edge to the end of the recovery time.
  Tick duration() const { return duration_; }
  /// From the first edge to the sampling of D; of a read.
  Tick sample() const;

 private:
  void frame(Pin strobe, std::uint16_t address, Tick low, const AccessTiming& timing);
  void add(Tick at, Pin pin, Level level) { edges_.at(size_++) = {at, pin, level}; }
  void order(Tick recovery);

  std::array<Edge, 8> edges_{};
  std::size_t size_ = 0;
  Tick duration_ = 0;
};

}  // namespace dsdpv1::systemc
