#pragma once
// A fault between a chip and the line: its next answers reach the line damaged, late, twice or not at all. Neither the
// chip nor a master knows of it.
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// Bits are inverted while the chip sends them, so that times stay as they are.
class AnswerFault : public bus::Agent, private bus::Diversion {
 public:
  /// `bit`: the present bit time of the line, in ticks. The segment must outlive it. Add it to the timeline after the
  /// chip.
  AnswerFault(bus::Segment& segment, bus::StationId station, std::function<bus::Tick()> bit)
      : segment_(segment), station_(station), bit_(std::move(bit)) {}

  /// From `now` on, for the next `times` answers with the part that the fault is about (others pass as they are, an
  /// answer under way, too); replaces an earlier fault. `late`: the delay, in ticks.
  void damage(bus::Tick now, scenario::AnswerFaultKind kind, int times, bus::Tick late);

  bus::Tick next() const override;
  void run(bus::Tick now) override;

 private:
  struct Edge {
    bus::Tick at;
    bool enabled, level;
  };
  void driven(bus::Tick at, bool enabled, bool level) override;
  void begin(bus::Tick at);
  void end(bus::Tick at);
  void pass_on(const Edge& edge);
  void emit(bus::Tick at);
  bool apply(bus::Tick at);
  void character(const bus::ReceivedCharacter& heard);
  void plan(bus::Tick start, std::uint16_t inverted);
  std::size_t length() const;
  std::size_t first_address() const { return bytes_[0] == bus::sd::k2 ? 4 : 1; }
  std::size_t wrong_byte() const;
  std::uint16_t inverted_in(std::size_t position) const;
  std::uint16_t corrected_fcs() const;
  void stop_if_done();

  bus::Segment& segment_;
  bus::StationId station_;
  std::function<bus::Tick()> bit_;
  scenario::AnswerFaultKind kind_{};
  int left_ = 0;  ///< answers
  bus::Tick late_ = 0;

  // The present answer.
  bool enabled_ = false, level_ = true;  ///< as the chip drives
  bool damages_ = false, lost_ = false, effective_ = false, inverts_ = false, cut_ = false;
  bus::Tick began_ = 0, cut_at_ = bus::kNever;
  bus::UartReceiver receiver_;
  bus::Bytes bytes_;               ///< so far
  std::deque<bus::Tick> toggles_;  ///< where the inversion begins or ends
  std::vector<Edge> copy_;

  std::deque<Edge> queue_;  ///< edges on their way to the line
};

}  // namespace dsdpv1::tb
