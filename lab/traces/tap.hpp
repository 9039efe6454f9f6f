#pragma once
// All signals of a run while it runs, for writing a trace or comparing with one.
#include <vector>

#include "bus/wire/segment.hpp"
#include "tb/bench/observer.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::traces {

/// The numbers of signals in signals_of: the pins of each slave one after the other, then the line.
class SignalNumbers {
 public:
  explicit SignalNumbers(const scenario::Scenario& scenario);
  std::size_t of(std::size_t slave, PinNumber pin) const { return first_[slave] + pin; }
  std::size_t pins(std::size_t slave) const { return first_[slave + 1] - first_[slave]; }
  std::size_t line() const { return first_.back(); }
  /// The number of slaves for the line.
  std::size_t slave(std::size_t signal) const;
  PinNumber pin(std::size_t signal) const { return static_cast<PinNumber>(signal - first_[slave(signal)]); }

 private:
  std::vector<std::size_t> first_;
};

/// Receives signals, numbered as in signals_of.
class Sink {
 public:
  virtual ~Sink() = default;
  /// In order of time; each signal begins with its level of power-on, at tick 0.
  virtual void change(std::size_t signal, Tick at, Level level) = 0;
};

class Tap : public Observer, private bus::Listener {
 public:
  /// Listens to the line as a separate station. Scenario and sinks must outlive it, and it must outlive the run.
  Tap(const scenario::Scenario& scenario, bus::Segment& segment);
  void add(Sink& sink) { sinks_.push_back(&sink); }

  void begins(std::size_t slave, const ChipView& chip) override;
  void pin(std::size_t slave, Tick at, PinNumber pin, Level level) override {
    tell(numbers_.of(slave, pin), at, level);
  }

 private:
  void line_changed(Tick at, bool level) override { tell(numbers_.line(), at, level ? 1 : 0); }
  void tell(std::size_t signal, Tick at, Level level) const {
    for (Sink* each : sinks_) each->change(signal, at, level);
  }

  bus::Segment& segment_;
  SignalNumbers numbers_;
  std::vector<Sink*> sinks_;
};

}  // namespace dsdpv1::tb::traces
