#pragma once
// What a serial host port sees of the rest of the chip at an edge: registers as they are before it.
namespace dsdpv1 {

struct ChipSide {
  bool owns = false;       ///< an access of the chip runs
  bool starts_up = false;  ///< the start-up access has not ended
  bool data_exch = false;
};

}  // namespace dsdpv1
