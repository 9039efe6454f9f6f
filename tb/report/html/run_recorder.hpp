#pragma once
// The contents of a report besides the result, gathered during the run in bounded memory: telegrams, distributions of
// times, timing diagrams, and the pins round each violation.
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tb/bench/observer.hpp"
#include "tb/report/html/diagram_watch.hpp"
#include "tb/report/html/distribution.hpp"
#include "tb/report/html/pin_memory.hpp"
#include "tb/report/html/telegram_list.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::html {

/// The pins of a slave round a violation.
struct ViolationPicture {
  std::size_t slave = 0;
  checks::Violation violation;
  Tick from = 0, to = 0;
  std::vector<PinTrace> pins;  ///< those of the rule, then what else has changed
  std::size_t of_rule = 0;     ///< so many of `pins` are those of the rule
};

/// A distribution with its title.
struct TimesOf {
  std::string title;  ///< "Holds of the user"
  std::string whose;  ///< a station
  Distribution times;
  Tick unit = 0;             ///< a bit time where it is counted in these; 0: a time
  std::vector<Tick> limits;  ///< the least and the greatest allowed, or none
};

class RunRecorder : public Observer {
 public:
  static constexpr std::size_t kMostPictures = 200;
  static constexpr std::size_t kMostOfARule = 20;  ///< of one slave

  /// `scenario` must outlive it.
  explicit RunRecorder(const scenario::Scenario& scenario);
  RunRecorder(const RunRecorder&) = delete;
  RunRecorder& operator=(const RunRecorder&) = delete;

  void begins(std::size_t slave, const ChipView& chip) override;
  void pin(std::size_t slave, Tick at, PinNumber pin, Level level) override;
  void read(std::size_t slave, Tick sample) override;
  void telegram(const HeardTelegram& heard) override;
  void host_telegram(std::size_t slave, const HostTelegram& telegram) override {
    telegrams_.add(scenario_.slaves[slave].name.text, telegram);
  }
  void violated(const std::string& slave, const checks::Violation& violation, const char* kind) override;
  /// The run is over: diagrams and pictures that wait for more are taken as they are.
  void finish();

  const scenario::Scenario& scenario() const { return scenario_; }
  const TelegramList& telegrams() const { return telegrams_; }
  std::vector<const TimesOf*> times() const;
  /// By slave, then in the order of the chip's diagrams.
  const std::deque<DiagramWatch>& diagrams(std::size_t slave) const { return slaves_[slave].diagrams; }
  const std::vector<ViolationPicture>& pictures() const { return pictures_; }
  /// Violations without a picture, since there were too many.
  std::uint64_t not_pictured() const { return not_pictured_; }

 private:
  struct Busy {
    std::optional<Tick> since;
    TimesOf times;
  };
  struct Slave {
    explicit Slave(std::size_t pins) : memory(pins) {}
    const ChipView* chip = nullptr;
    PinMemory memory;
    std::deque<DiagramWatch> diagrams;
    std::vector<Busy> busy;
    std::map<std::size_t, std::size_t> pictures_of;  ///< by rule
    std::deque<ViolationPicture> waiting;            ///< for what is after the violation
  };
  struct Station {
    std::optional<Tick> last_exchange;
    std::optional<TimesOf> tsdr, cycle;
  };
  void busy_changed(std::size_t number, Tick at, PinNumber changed);
  void answer(const bus::WireTelegram& wire);
  void take_pictures(Slave& slave, Tick now);
  void take(const Slave& slave, ViolationPicture& picture);

  const scenario::Scenario& scenario_;
  TelegramList telegrams_;
  std::deque<Slave> slaves_;  ///< as in the scenario; the memories stay where they are
  std::map<std::uint8_t, Station> stations_;
  std::vector<ViolationPicture> pictures_;
  std::uint64_t not_pictured_ = 0;
};

}  // namespace dsdpv1::tb::html
