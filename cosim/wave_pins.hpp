#pragma once
// The chip's pins in waves that are compared: which of a simulator's signals they are, and what they show.
#include <string>
#include <vector>

#include "cosim/line_history.hpp"
#include "cosim/pin_map.hpp"
#include "kinds/dsdpv1/random/access_watch.hpp"
#include "lab/compare/options.hpp"
#include "lab/compare/surroundings.hpp"

namespace dsdpv1::cosim {

/// A pair for each pin of table 1, A with table 1's names as the model's waves have them, B with those of the map. D of
/// the model is the bus: of B it is D_OUT while D_OE says that the chip drives, else D_IN. What a wave lacks is left
/// out.
std::vector<tb::compare::NamedPair> pairs_of(const PinMap& map);

/// The last telegrams on both lines, the user's last access and the chip's.
class PinSurroundings : public tb::compare::Surroundings {
 public:
  const std::vector<std::string>& pins() const override;
  void change(Tick at, std::size_t number, std::string_view value) override;
  std::vector<tb::compare::Line> lines(Tick now) const override;

 private:
  AccessWatch watch_;
  LineHistory received_, sent_;
};

}  // namespace dsdpv1::cosim
