#pragma once
// Looks in one chip's pins for the instance of a timing diagram that is closest to its limits, and keeps its picture.
#include <deque>
#include <optional>
#include <vector>

#include "tb/bench/record.hpp"
#include "tb/chip/timing_diagram.hpp"
#include "tb/report/html/pin_memory.hpp"

namespace dsdpv1::tb::html {

/// The least and the greatest allowed, where there are any, ticks.
struct SpanLimits {
  std::optional<Tick> least, greatest;
};

/// Measured times of one span of an instance; absent moments were not seen.
struct MeasuredSpan {
  std::optional<Tick> from, to;
  SpanLimits limits;

  bool seen() const { return from && to; }
  Tick measured() const { return *to - *from; }
  /// To the nearer limit; absent without one.
  std::optional<Tick> margin() const;
};

struct Instance {
  Tick anchor = 0;
  std::vector<MeasuredSpan> spans;  ///< in the order of the diagram's

  /// The least of all spans; absent when none has a limit.
  std::optional<Tick> margin() const;
  Tick first() const, last() const;
};

/// An instance with its pins.
struct DiagramPicture {
  Instance instance;
  Tick from = 0, to = 0;  ///< what is shown
  std::vector<PinTrace> pins;
};

class DiagramWatch {
 public:
  /// `limits`: of the diagram's spans. Diagram and memory must outlive it; memory is given each change before this.
  DiagramWatch(const TimingDiagram& diagram, std::vector<SpanLimits> limits, const PinMemory& memory)
      : diagram_(diagram), limits_(std::move(limits)), memory_(memory) {}

  void pin(Tick at, PinNumber pin, Level level);
  void read(Tick sample) { sample_ = sample; }
  /// An answer of this chip has been heard; `bit` in ticks.
  void answered(Tick request_end, Tick answer_start, const SpanLimits& tsdr);
  void finish();

  const TimingDiagram& diagram() const { return diagram_; }
  const std::optional<DiagramPicture>& worst() const { return worst_; }
  std::uint64_t instances() const { return instances_; }

 private:
  template <class Done>
  void close(const Done& done);
  void anchored(Tick at);
  std::optional<Tick> resolved(const Moment& moment, Tick anchor, std::optional<Tick> request_end) const;
  std::optional<Tick> last_of(const std::vector<DiagramEdge>& edges, Tick until) const;
  std::optional<Tick> first_of(const std::vector<DiagramEdge>& edges, Tick from, Tick to) const;
  void resolve_later(Instance& instance, Tick at, PinNumber pin, Level level) const;
  bool is_complete(const Instance& instance) const;
  void judge(const Instance& instance);
  bool is_worse(const Instance& instance) const;
  void take_picture();

  const TimingDiagram& diagram_;
  std::vector<SpanLimits> limits_;
  const PinMemory& memory_;
  std::optional<Tick> sample_, anchored_;
  std::deque<Instance> open_;          ///< wait for moments after their anchor
  std::optional<Instance> candidate_;  ///< waits for what its picture shows after it
  std::optional<DiagramPicture> worst_;
  std::uint64_t instances_ = 0;
};

}  // namespace dsdpv1::tb::html
