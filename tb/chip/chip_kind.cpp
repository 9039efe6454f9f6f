#include "tb/chip/chip_kind.hpp"

#include <algorithm>

namespace dsdpv1::tb {
namespace {

std::vector<const ChipKind*>& all_kinds() {
  static std::vector<const ChipKind*> kinds = built_in_chip_kinds();
  return kinds;
}

}  // namespace

const std::vector<Order>& ChipKind::orders() const {
  static const std::vector<Order> none;
  return none;
}

const std::vector<keys::Word>& ChipKind::blocks() const {
  static const std::vector<keys::Word> none;
  return none;
}

const std::vector<PinGroup>& ChipKind::pin_groups() const {
  static const std::vector<PinGroup> none;
  return none;
}

const std::vector<InnerSignal>& ChipKind::inner_signals() const {
  static const std::vector<InnerSignal> none;
  return none;
}

const checks::RuleTable& ChipKind::rules() const {
  static const checks::RuleTable none;
  return none;
}

const std::vector<TimingDiagram>& ChipKind::timing_diagrams() const {
  static const std::vector<TimingDiagram> none;
  return none;
}

const std::vector<BusyTime>& ChipKind::busy_times() const {
  static const std::vector<BusyTime> none;
  return none;
}

const ChipKinds& chip_kinds() { return all_kinds(); }

const ChipKind* find_chip_kind(const std::string& name) {
  const auto& kinds = all_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&name](const ChipKind* kind) { return name == kind->name(); });
  return found == kinds.end() ? nullptr : *found;
}

const Order* order_of(const ChipKind& kind, const std::string& word) {
  const auto& orders = kind.orders();
  const auto found =
      std::find_if(orders.begin(), orders.end(), [&word](const Order& each) { return each.choice.word == word; });
  return found == orders.end() ? nullptr : &*found;
}

void add_chip_kind(const ChipKind& kind) { all_kinds().push_back(&kind); }

}  // namespace dsdpv1::tb
