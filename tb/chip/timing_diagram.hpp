#pragma once
// Declares a timing diagram at a chip's pins: the edges, the measurements between them, and the checks that limit
// these. A kind of chip declares them; the observer of a run looks for the instance with the least margin
// (tb/report/html).
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bus/time.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::tb {

enum class Turn : std::uint8_t {
  kRise,
  kFall,
  kChange,
  kValue,  ///< to a driven, known level
};

struct PinLevel {
  PinNumber pin = 0;
  Level level = 0;
};

/// A change of a pin, if the first `conditions` of `where` hold just before it or at its tick.
struct DiagramEdge {
  PinNumber pin = 0;
  Turn turn = Turn::kChange;
  std::array<PinLevel, 2> where = {};
  std::size_t conditions = 0;
};

/// A moment of an instance, relative to its anchor.
struct Moment {
  enum class Of : std::uint8_t {
    kAnchor,
    kBefore,        ///< the last of `edges` up to the anchor, or up to `until`
    kSince,         ///< the first of `edges` from the last of `begun` to the anchor
    kAfter,         ///< the first of `edges` after it
    kReadSample,    ///< the user CPU's sample of the data in the read that ends at the anchor; else the anchor
    kRequestEnded,  ///< end of the request whose answer begins at the anchor
  };
  Of of = Of::kAnchor;
  std::vector<DiagramEdge> edges;
  std::vector<DiagramEdge> begun = {};            ///< the last of them up to the anchor
  bus::Tick (*until)(bus::Tick begun) = nullptr;  ///< for kBefore: the latest time, depending on `begun`
};

/// From one moment to the other.
struct DiagramSpan {
  const char* name = "";
  Moment from, to;
  const char* check = nullptr;   ///< id of the rule with its limit; null: none
  bool tsdr = false;             ///< min_TSDR and max_TSDR of the baud rate are its limits
  bus::Tick exact = 0;           ///< its value by the datasheet; 0: none
  const char* clause = nullptr;  ///< clause of that value
};

struct TimingDiagram {
  const char* id = "";
  const char* title = "";
  const char* text = "";  ///< caption, one sentence
  std::vector<DiagramEdge>
      anchors;  ///< each tick with one of them is an instance; none: the begin of each answer of the slave
  std::vector<DiagramSpan> spans;
  bus::Tick patience = 0;       ///< maximum wait for moments after the anchor
  std::vector<PinNumber> pins;  ///< drawn, from above
};

/// The time during which one of the pins is high.
struct BusyTime {
  const char* title = "";
  PinMask pins = 0;
};

}  // namespace dsdpv1::tb
