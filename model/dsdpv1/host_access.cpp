#include "model/dsdpv1/host_access.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace dsdpv1 {
namespace {

/// Order of edges at one tick: preparation of a strobe, strobe, sample of D, end of an access.
int rank(const HostAccess::Edge& edge) {
  switch (edge.pin) {
    case Pin::kA: return edge.level == HostAccess::kIdleAddress ? 8 : 0;
    case Pin::kCsr: return edge.level == 0 ? 1 : 7;
    case Pin::kDIn: return edge.level == kLevelZ ? 6 : 2;
    case Pin::kDOut: return 4;
    default: return edge.level == 0 ? 3 : 5;
  }
}

}  // namespace

// Compared at each access.
bool operator==(const AccessTiming& a, const AccessTiming& b) {
  static_assert(std::has_unique_object_representations_v<AccessTiming>);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

HostAccess HostAccess::read(std::uint16_t address, const AccessTiming& timing) {
  HostAccess access;
  access.frame(Pin::kRd, timing.rd_low, timing);
  // D cannot be sampled before RD and CSR are low.
  access.add(std::max({timing.rd_sample, Tick{0}, -timing.cs_lead}), Pin::kDOut, 0);
  access.order(timing.recovery);
  access.aim(address, 0);
  return access;
}

HostAccess HostAccess::write(std::uint16_t address, std::uint8_t value, const AccessTiming& timing) {
  HostAccess access;
  access.frame(Pin::kWr, timing.wr_low, timing);
  access.write_ = true;
  access.add(timing.wr_low - timing.data_setup, Pin::kDIn, 0);
  access.add(timing.wr_low + timing.data_hold, Pin::kDIn, kLevelZ);
  access.order(timing.recovery);
  access.aim(address, value);
  return access;
}

const HostAccess& HostAccessMaker::make(bool write, std::uint16_t address, std::uint8_t value,
                                        const AccessTiming& timing) {
  Shape& shape = shapes_.at(write ? 1 : 0);
  if (shape.access.size() == 0 || !(shape.timing == timing))
    shape = {timing, write ? HostAccess::write(0, 0, timing) : HostAccess::read(0, timing)};
  shape.access.aim(address, value);
  return shape.access;
}

/// The edges common to reads and writes, counted from the fall of the strobe.
void HostAccess::frame(Pin strobe, Tick low, const AccessTiming& timing) {
  add(-timing.address_setup, Pin::kA, 0);
  add(-timing.cs_lead, Pin::kCsr, 0);
  add(0, strobe, 0);
  add(low, strobe, 1);
  add(low + timing.cs_trail, Pin::kCsr, 1);
  add(low + timing.address_hold, Pin::kA, kIdleAddress);
}

void HostAccess::aim(std::uint16_t address, std::uint8_t value) {
  edges_[address_].level = static_cast<Level>(address);
  if (value_ < size_) edges_[value_].level = value;
}

/// The index of this edge; the number of edges if there is no such edge.
std::size_t HostAccess::edge_of(Pin pin, Level level) const {
  const auto searched = [pin, level](const Edge& edge) { return edge.pin == pin && edge.level == level; };
  return static_cast<std::size_t>(std::find_if(begin(), end(), searched) - begin());
}

void HostAccess::order(Tick recovery) {
  const auto last = edges_.begin() + static_cast<std::ptrdiff_t>(size_);
  std::sort(edges_.begin(), last,
            [](const Edge& a, const Edge& b) { return a.at != b.at ? a.at < b.at : rank(a) < rank(b); });
  const Tick first = edges_.front().at;
  std::for_each(edges_.begin(), last, [first](Edge& edge) { edge.at -= first; });
  duration_ = (last - 1)->at + std::max<Tick>(recovery, 0);
  address_ = edge_of(Pin::kA, 0);
  value_ = edge_of(Pin::kDIn, 0);
  times_ = find_times();
  right_ = keeps_limits();
}

HostAccess::Times HostAccess::find_times() const {
  const auto time = [this](Pin pin, Level level) { return edges_[edge_of(pin, level)].at; };
  const Pin strobe = write_ ? Pin::kWr : Pin::kRd;
  return {time(Pin::kA, 0),
          time(Pin::kA, kIdleAddress),
          time(Pin::kCsr, 0),
          time(Pin::kCsr, 1),
          time(strobe, 0),
          time(strobe, 1),
          write_ ? time(Pin::kDIn, 0) : time(Pin::kDOut, 0),
          write_ ? time(Pin::kDIn, kLevelZ) : time(Pin::kDOut, 0)};
}

// A read needs A from the fall of the later strobe to the next rising edge of CLK.
bool HostAccess::keeps_limits() const {
  const Times& t = times_;
  if (write_)
    return t.strobe_end - t.strobe >= kTs && t.select <= t.strobe_end && t.select_end >= t.strobe_end &&
           std::max(t.address, t.data) <= t.strobe_end - kTd &&
           std::min(t.address_end, t.data_end) >= t.strobe_end + kTd;
  const Tick begin = std::max(t.select, t.strobe);
  return t.address <= begin && t.address_end >= begin + profibus::kTicksPerCycle && t.data >= begin + kTw &&
         std::min(t.select_end, t.strobe_end) >= t.data;
}

}  // namespace dsdpv1
