#pragma once
// The chip's pins in waves that are compared: which of a simulator's signals they are, and what they show.
#include <string>
#include <vector>

#include "cosim/line_history.hpp"
#include "cosim/pin_map.hpp"
#include "lab/compare/options.hpp"
#include "lab/compare/surroundings.hpp"

namespace dsdpv1::cosim {

/// A pair for each pin, A with the datasheet's names as the model's waves have them, B with those of the map. Of a bus
/// the model's waves have one signal: of B it is the output while its enable says that the chip drives, else the input.
/// What a wave lacks is left out.
std::vector<tb::compare::NamedPair> pairs_of(const PinMap& map, const tb::PinTable& pins);

/// The last telegrams on both lines, the user's last access and the chip's.
class PinSurroundings : public tb::compare::Surroundings {
 public:
  /// A kind that has an RtlOf.
  explicit PinSurroundings(const tb::ChipKind& kind);
  const std::vector<std::string>& pins() const override { return names_; }
  void change(Tick at, std::size_t number, std::string_view value) override;
  std::vector<tb::compare::Line> lines(Tick now) const override;

 private:
  const tb::ChipKind& kind_;
  std::vector<PinNumber> pins_;  ///< all but the outputs on a bus, by place in names_
  std::vector<std::string> names_;
  std::unique_ptr<MemoryWatch> watch_;
  LineHistory received_, sent_;
};

}  // namespace dsdpv1::cosim
