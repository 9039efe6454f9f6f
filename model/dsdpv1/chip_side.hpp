#pragma once
// The rest of the chip as a serial host port sees it at an edge: registers before the edge.
namespace dsdpv1 {

struct ChipSide {
  bool owns = false;       ///< an access of the chip is running
  bool starts_up = false;  ///< the start-up access has not ended
  bool data_exch = false;
};

}  // namespace dsdpv1
