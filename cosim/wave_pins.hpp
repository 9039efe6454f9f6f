#pragma once
// The chip's pins in compared waves: maps them to a simulator's signals and converts their values.
#include <string>
#include <vector>

#include "cosim/line_history.hpp"
#include "cosim/pin_map.hpp"
#include "lab/compare/options.hpp"
#include "lab/compare/surroundings.hpp"

namespace dsdpv1::cosim {

/// A pair for each pin, A with the datasheet's names as in the model's waves, B with those of the map. A bus has one
/// signal in the model's waves: in B it is the output while its enable is active, else the input. Inputs missing in a
/// wave are left out; outputs must be there, a bus under its own name or that of its output.
std::vector<tb::compare::NamedPair> pairs_of(const PinMap& map, const tb::PinTable& pins);

/// The last telegrams on both lines, and the last accesses of user and chip if an RtlOf of the kind watches them.
class PinSurroundings : public tb::compare::Surroundings {
 public:
  explicit PinSurroundings(const tb::ChipKind& kind);
  const std::vector<std::string>& pins() const override { return names_; }
  void change(Tick at, std::size_t number, std::string_view value) override;
  std::vector<tb::compare::Line> lines(Tick now) const override;

 private:
  const tb::ChipKind& kind_;
  std::vector<PinNumber> pins_;  ///< all except the outputs on a bus, by place in names_
  std::vector<std::string> names_;
  std::unique_ptr<MemoryWatch> watch_;  ///< null without RtlOf
  LineHistory received_, sent_;
};

}  // namespace dsdpv1::cosim
