#include "lab/replay/replay.hpp"

#include <algorithm>
#include <utility>

#include "bus/baud.hpp"
#include "lab/replay/start_up.hpp"
#include "tb/bench/setup.hpp"

namespace dsdpv1::tb::replay {
namespace {

RunOptions open_ended(RunOptions options) {
  options.open_ended = true;
  return options;
}

}  // namespace

Tick Replay::Supplier::next() const {
  if (lead_in_) return lead_in_->at;
  return shift_ && next_ < supplies_.size() ? std::max(supplies_[next_].at + *shift_, begin_) : bus::kNever;
}

void Replay::Supplier::run(Tick now) {
  if (lead_in_) {
    bench_.command(slave_, lead_in_->command);
    return lead_in_.reset();
  }
  while (next() <= now) bench_.command(slave_, supplies_[next_++].command);
}

Replay::Replay(const Recording& recording, const Firmware& firmware, const scenario::Scenario& scenario,
               const ReplayOptions& options, RunOptions run, std::unique_ptr<Execution> execution)
    : recording_(recording),
      firmware_(firmware),
      scenario_(scenario),
      options_(options),
      placed_(place(recording)),
      station_(Setup(scenario).station(scenario.slaves.front())),
      supplies_(supplies_for(firmware.supplies, scenario.slaves.front().user_cpu, station_, options.judge.supplied)),
      listener_(recording, placed_),
      made_(std::move(execution)),
      execution_(*made_),
      line_(make_line(execution_.segment(), recording, placed_)),
      lead_in_(execution_.segment(), recording.baud, recording.slave,
               [this](int baud) { return listener_.model_has_rate(baud); }),
      bench_(scenario_, open_ended(std::move(run)), std::move(made_)),
      supplier_(bench_, scenario_, supplies_) {
  options_.judge.user_cycle = scenario_.slaves.front().user_cpu.cycle;
  prepare_lead_in();
  lead_in_.on_sent = [this](const bus::Telegram& telegram, Tick end) { judge_lead_in(telegram, end); };
  lead_in_.on_end = [this](Tick free) { begin(free); };
  line_->on_baud = [this](int baud) { bench_.set_line_baud(baud); };
  line_->may_go_on = [this](std::size_t placed) { return may_go_on(placed); };
  bench_.add_observer(listener_);
  bus::Timeline& timeline = execution_.timeline();
  timeline.add(lead_in_);
  timeline.add(*line_);
  timeline.add(supplier_);
}

void Replay::prepare_lead_in() {
  if (!options_.lead_in) return lead_in_.leave_out();
  std::vector<bus::Telegram> telegrams = start_up_of(recording_, station_);
  options_.judge.started = !telegrams.empty();
  lead_in_.then_send(std::move(telegrams));
}

void Replay::judge_lead_in(const bus::Telegram& telegram, Tick end) {
  const bool cfg = telegram.dsap == bus::sap::kChkCfg;
  const bool judged = cfg || telegram.dsap == bus::sap::kSetPrm;
  if (judged && leaves_verdict(scenario_.slaves.front().user_cpu, station_, cfg))
    supplier_.accept(end + bus::kTicksPerMs, cfg);
}

/// The line is idle for the lead-in's pause, because the capture may begin with an answer.
void Replay::begin(Tick free) {
  constexpr int kIdle = 2 * bus::kSynBits;
  const Tick first = placed_.empty() ? 0 : placed_[next_].start;
  const int baud = placed_.empty() ? recording_.baud : recording_.telegrams[placed_[next_].telegram].baud;
  const Tick at = free + kIdle * bus::baud(baud).bit;
  shift_ = at - first;
  listener_.begin(*shift_);
  supplier_.begin(*shift_, at);
  line_->begin(first, at);
}

/// The recorded slave has found another rate. The capture waits until the model has.
bool Replay::may_go_on(std::size_t placed) {
  const int baud = recording_.telegrams[placed_[placed].telegram].baud;
  if (!options_.lead_in || listener_.model_has_rate(baud)) return true;
  next_ = placed;
  shift_.reset();
  listener_.pause();
  supplier_.pause();
  lead_in_.search(baud, execution_.timeline().now());
  return false;
}

/// Leaves time for a last answer.
bool Replay::over(Tick now) const {
  const bus::Baud& rate = bus::baud(recording_.telegrams.back().baud);
  constexpr int kLongestAnswer = 256 * bus::kCharacterBits;
  return shift_ && now > recording_.end() + *shift_ + (rate.slot_bits + kLongestAnswer) * rate.bit;
}

Result Replay::run(const std::function<bool(double)>& poll) {
  bool stopped = false;
  const Tick begin = recording_.telegrams.front().start, length = std::max<Tick>(recording_.end() - begin, 1);
  run_result_ = bench_.run([&](Tick now) {
    const Tick done = shift_ ? now - *shift_ - begin : 0;
    stopped = !poll(std::clamp(static_cast<double>(done) / static_cast<double>(length), 0.0, 1.0));
    return !stopped && !over(now);
  });
  return result(stopped);
}

Result Replay::result(bool interrupted) {
  Result result;
  result.capture = recording_.name;
  result.form = recording_.levels.empty() ? "telegrams" : "levels";
  result.slave = recording_.slave;
  result.bauds = recording_.bauds();
  result.resolution = recording_.resolution;
  result.telegrams = recording_.telegrams.size();
  result.left_out = recording_.left_out;
  result.begin = recording_.telegrams.front().start;
  result.end = recording_.end();
  result.lead_in = shift_ ? *shift_ + result.begin : 0;
  result.station = describe_station(scenario_);
  result.started = options_.judge.started;
  result.inputs_recorded = options_.judge.supplied;
  result.diagnoses_recorded = result.inputs_recorded && scenario_.slaves.front().kind->hands_over_diagnoses();
  result.rule = options_.judge.tsdr;
  result.requests = Judge(recording_, firmware_, supplies_, options_.judge).judge(listener_);
  result.unasked = listener_.unasked();
  result.interrupted = interrupted;
  return result;
}

}  // namespace dsdpv1::tb::replay
