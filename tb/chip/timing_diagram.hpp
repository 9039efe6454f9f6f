#pragma once
// What is worth a timing diagram at a chip's pins: which edges, what is measured between them, which check limits it. A
// kind of chip declares them; who watches a run looks for the instance with the least margin (tb/report/html).
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
  kValue,  ///< to a level that somebody drives and that is known
};

struct PinLevel {
  PinNumber pin = 0;
  Level level = 0;
};

/// A change of a pin; only where the first `conditions` of `where` hold, just before it or at its tick.
struct DiagramEdge {
  PinNumber pin = 0;
  Turn turn = Turn::kChange;
  std::array<PinLevel, 2> where = {};
  std::size_t conditions = 0;
};

/// A moment of an instance, seen from its anchor.
struct Moment {
  enum class Of : std::uint8_t {
    kAnchor,
    kBefore,        ///< the last of `edges` up to the anchor, or up to `until`
    kSince,         ///< the first of `edges` from the last of `begun` to the anchor
    kAfter,         ///< the first of `edges` after it
    kReadSample,    ///< when the user CPU sampled the data of the read that ends at the anchor; else the anchor
    kRequestEnded,  ///< of the request whose answer begins at the anchor
  };
  Of of = Of::kAnchor;
  std::vector<DiagramEdge> edges;
  std::vector<DiagramEdge> begun = {};            ///< the last of them up to the anchor
  bus::Tick (*until)(bus::Tick begun) = nullptr;  ///< of kBefore: not later than this, seen from `begun`
};

/// From one moment to the other.
struct DiagramSpan {
  const char* name = "";
  Moment from, to;
  const char* check = nullptr;   ///< id of the rule whose limit holds for it; null: none
  bool tsdr = false;             ///< min_TSDR and max_TSDR of the baud rate hold for it
  bus::Tick exact = 0;           ///< what the datasheet says that it is; 0: nothing
  const char* clause = nullptr;  ///< and where
};

struct TimingDiagram {
  const char* id = "";
  const char* title = "";
  const char* text = "";  ///< what is shown, one sentence
  std::vector<DiagramEdge>
      anchors;  ///< each tick with one of them is an instance; none: each answer of the slave, as it begins
  std::vector<DiagramSpan> spans;
  bus::Tick patience = 0;       ///< how long moments after the anchor are waited for
  std::vector<PinNumber> pins;  ///< drawn, from above
};

/// As long as one of the pins is high, something is busy.
struct BusyTime {
  const char* title = "";
  PinMask pins = 0;
};

}  // namespace dsdpv1::tb
