#include "cosim/random/player.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "bus/monitor/monitor.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"
#include "cosim/random/play_options.hpp"
#include "cosim/random/random_cases.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kAfterwards = 3000 * kCycle;  // so that the effects of the last action are compared as well

/// One lane: takes its next action when the previous one has ended.
class Lane : public bus::Agent {
 public:
  virtual bool takes(Verb verb) const = 0;
  /// The action begins at `at`.
  void begin(Tick at, const Action& action) {
    plan(at, action);
    announce();
  }
  virtual bool idle() const { return next() == bus::kNever; }

 protected:
  virtual void plan(Tick at, const Action& action) = 0;
};

class PinLane;
class Reader;

/// The chip as a station of the segment, model and RTL in one.
class ChipAgent : public bus::Agent, private bus::Listener {
 public:
  ChipAgent(const PlayOptions& options, std::unique_ptr<Rtl> rtl, bus::Segment& segment)
      : lockstep_(make_lockstep(options, std::move(rtl))),
        listeners_(options.listeners),
        places_(options.kind->board_pins()),
        segment_(segment),
        station_(segment.attach("chip", this)) {
    lockstep_->watch({[](void* self, Tick at, tb::PinNumber pin, Level level) {
                        static_cast<ChipAgent*>(self)->drive(at, pin, level);
                      },
                      this},
                     tb::mask_of(places_.txd) | tb::mask_of(places_.rts));
  }
  Tick next() const override { return due_.empty() ? lockstep_->next_event() : due_.front().at; }
  void run(Tick now) override {
    lockstep_->advance(now);
    tell();
    for (PlayListener* each : listeners_) each->evaluated(now, *lockstep_);
    tell_of_accesses(now);
    tell_reader(now);
  }
  /// `lane` receives the items on which the chip's accesses work.
  void tell_of_accesses(PinLane& lane) { aimed_.push_back(&lane); }
  /// `reader` receives each input's level and each evaluation.
  void tell(Reader& reader) { reader_ = &reader; }
  Lockstep& lockstep() { return *lockstep_; }
  const tb::BoardPins& places() const { return places_; }
  Level level(PinNumber pin) const { return lockstep_->level(pin); }
  void set(Tick at, PinNumber pin, Level level) {
    lockstep_->set(at, pin, level);
    tell_reader(at, pin, level);
    announce();
  }

 private:
  struct Drive {
    Tick at;
    bool enabled, level;
  };
  /// The line may react, so it is updated after the call into the chip has returned.
  void drive(Tick at, PinNumber pin, Level level) {
    (pin == places_.txd ? level_ : enabled_) = level != 0;
    due_.push_back({at, enabled_, level_});
  }
  void tell() {
    for (std::size_t i = 0; i < due_.size(); ++i) {  // NOLINT(modernize-loop-convert): the list may grow meanwhile
      const Drive due = due_[i];
      segment_.drive(station_, due.at, due.enabled, due.level);
    }
    due_.clear();
  }
  void tell_of_accesses(Tick now);
  void tell_reader(Tick now);
  void tell_reader(Tick at, PinNumber pin, Level level);
  void line_changed(Tick at, bool level) override { set(at, places_.rxd, level ? 1 : 0); }

  std::unique_ptr<Lockstep> lockstep_;
  const std::vector<PlayListener*>& listeners_;
  const tb::BoardPins& places_;
  std::vector<PinLane*> aimed_;
  Reader* reader_ = nullptr;
  bus::Segment& segment_;
  bus::StationId station_;
  bool enabled_ = false, level_ = true;
  std::vector<Drive> due_;
};

class BusLane : public Lane {
 public:
  BusLane(bus::Segment& segment, const ChipAgent& chip)
      : segment_(segment), sender_(segment, segment.attach("master", nullptr)), chip_(chip) {}

  bool takes(Verb verb) const override { return verb == Verb::kSend || verb == Verb::kSpike; }
  void plan(Tick at, const Action& action) override {
    if (action.verb == Verb::kSpike) {
      spike_ = at;
      spike_end_ = at + action.low;
      return;
    }
    bit_ = bus::baud(static_cast<int>(action.rate)).bit;
    sender_.set_timing(bit_);
    sender_.send(at, bus::characters(action.bytes, action.faults));
    answer_by_ = action.reply_bits == 0 ? -1 : sender_.end() + action.reply_bits * bit_;
    look_ = sender_.end();
  }
  /// A glitch may last longer than the telegram: the line is checked after the sender has finished.
  Tick next() const override { return std::min({sender_.busy() ? sender_.next() : look_, spike_, spike_end_}); }
  void run(Tick now) override {
    if (spike_ <= now)
      segment_.force(std::exchange(spike_, bus::kNever), false);
    else if (spike_end_ <= now)
      segment_.force(std::exchange(spike_end_, bus::kNever), std::nullopt);
    if (sender_.next() <= now) sender_.run(now);
    if (!sender_.busy() && look_ <= now) look(now);
  }

 private:
  /// Checks RTS at each bit time: ends when it has fallen, or if no answer has come in time.
  void look(Tick now) {
    const bool answers = chip_.level(chip_.places().rts) != 0;
    if (answers) answer_by_ = -1;
    look_ = answers || now < answer_by_ ? now + (answers ? kCycle : bit_) : bus::kNever;
  }

  bus::Segment& segment_;
  bus::UartSender sender_;
  const ChipAgent& chip_;
  Tick bit_ = 0, answer_by_ = -1, look_ = bus::kNever, spike_ = bus::kNever, spike_end_ = bus::kNever;
};

/// Actions of the user or the board. An action may be aimed: it waits for a part of a chip access, which the agent that
/// runs the chip reports, so that not every cycle must be checked.
class PinLane : public Lane {
 public:
  /// For the verbs from `first` to `last`; `verbs`: those of the user.
  PinLane(ChipAgent& chip, const std::vector<VerbRow>& verbs, Verb first, Verb last)
      : chip_(chip), verbs_(verbs), first_(first), last_(last) {}

  bool takes(Verb verb) const override { return verb >= first_ && verb <= last_; }
  /// The item on which the chip's access works now.
  void works_on(Tick now, const char* item) {
    item_ = item;
    if (aimed_ != nullptr && std::strcmp(aimed_->during, item) == 0) fire(now);
  }
  Tick next() const override { return paused_ ? bus::kNever : due(); }
  bool idle() const override { return due() == bus::kNever; }
  /// No action is under way or due.
  bool rests(Tick now) const { return due() > now && (edge_ == 0 || idle() || aimed_ != nullptr); }
  /// Nothing is done at the pins up to the next call, which puts off a due action; only where it rests.
  void pause() {
    paused_ = true;
    announce();
  }
  void resume(Tick now) {
    paused_ = false;
    by_ = std::max(by_, now);
    if (aimed_ == nullptr && due() < now) put_off(now - due());
    announce();
  }
  void run(Tick now) override {
    if (aimed_ != nullptr) return fire(now);
    if (edge_ == plan_.edges.size() && look_ <= now) return look(now);
    for (; edge_ < plan_.edges.size() && plan_.edges[edge_].at <= now; ++edge_) {
      const PinEdge edge = plan_.edges[edge_];
      if (edge.until_low == 0)
        chip_.set(edge.at, edge.pin, edge.level);
      else if (any_high(edge.until_low) && ++polls_ < kMostPolls)
        poll_again();
    }
  }

 private:
  static constexpr int kMostPolls = 400;  // after so many polls a user continues anyway
  Tick due() const {
    if (aimed_ != nullptr) return by_;
    return edge_ < plan_.edges.size() ? plan_.edges[edge_].at : look_;
  }
  UserPlan plan_of(const Action& action) const {
    const PinNumber reset = chip_.places().reset;
    if (action.verb == Verb::kReset) return {{{0, reset, 0}, {action.low, reset, 1}}};
    return std::find_if(verbs_.begin(), verbs_.end(), [&](const VerbRow& each) { return each.verb == action.verb; })
        ->plan(action);
  }
  void plan(Tick at, const Action& action) override {
    if (action.during == nullptr) return begin_at(at, action);
    const Tick now = at - action.delay;
    aimed_ = &action;
    by_ = now + action.within;
    if (std::strcmp(action.during, item_) == 0) fire(now);
  }
  void fire(Tick now) {
    const Action& action = *std::exchange(aimed_, nullptr);
    begin_at(now + action.delay, action);
    announce();
  }
  void begin_at(Tick at, const Action& action) {
    plan_ = plan_of(action);
    for (PinEdge& each : plan_.edges) each.at += at;
    edge_ = 0;
    polls_ = 0;
    if (plan_.reply_bits == 0) return;
    const Tick end = plan_.edges.back().at;
    look_ = end + plan_.bit / 2;
    last_low_ = -1;
    reply_by_ = end + plan_.reply_bits * plan_.bit;
  }
  bool any_high(tb::PinMask pins) const {
    for (PinNumber pin = 0; pin < kMostPins; ++pin)
      if ((pins >> pin & 1) != 0 && chip_.level(pin) != 0) return true;
    return false;
  }
  void poll_again() {
    put_off(plan_.poll_every);
    --edge_;
  }
  /// The rest of the action.
  void put_off(Tick ticks) {
    for (std::size_t i = edge_; i < plan_.edges.size(); ++i) plan_.edges[i].at += ticks;
    if (look_ == bus::kNever) return;
    look_ += ticks;
    reply_by_ += ticks;
  }
  /// Checks the reply every half bit.
  void look(Tick now) {
    if (chip_.level(plan_.reply) == 0) last_low_ = now;
    const bool over = last_low_ >= 0 ? now > last_low_ + bus::kCharacterBits * plan_.bit : now > reply_by_;
    look_ = over ? bus::kNever : now + plan_.bit / 2;
  }

  ChipAgent& chip_;
  const std::vector<VerbRow>& verbs_;
  const Verb first_, last_;
  UserPlan plan_;
  std::size_t edge_ = 0;
  Tick look_ = bus::kNever, last_low_ = -1, reply_by_ = 0;
  int polls_ = 0;
  const char* item_ = "";
  const Action* aimed_ = nullptr;  ///< waiting
  Tick by_ = 0;                    ///< ... at most until then
  bool paused_ = false;
};

/// PlayOptions::reads_back: acts where the user rests, who waits meanwhile.
class Reader : public PinLane {
 public:
  Reader(ChipAgent& chip, PinLane& user, const PlayOptions& options)
      : PinLane(chip, options.kind->random()->words().verbs, Verb::kPin, kLastVerb),
        user_(user),
        source_(options.kind->random()->read_back(*options.chip)) {}

  bool busy() const { return next_ < actions_.size() || !idle(); }
  void input(Tick at, PinNumber pin, Level level) { source_->input(at, pin, level); }
  void evaluated(Tick now, const tb::PinDevice& model) {
    source_->works_on(model.works_on());
    if (busy() || !user_.rests(now)) return;
    actions_ = source_->due(now, model);
    next_ = 0;
    if (actions_.empty()) return;
    user_.pause();
    go_on(now);
  }
  void run(Tick now) override {
    PinLane::run(now);
    if (!idle()) return;
    if (next_ < actions_.size()) return go_on(now);
    user_.resume(now);
  }

 private:
  void go_on(Tick now) {
    const Action& action = actions_[next_++];
    begin(now + action.delay, action);
  }

  PinLane& user_;
  const std::unique_ptr<ReadBack> source_;
  Stimulus actions_;
  std::size_t next_ = 0;
};

void ChipAgent::tell_reader(Tick now) {
  if (reader_ != nullptr) reader_->evaluated(now, *lockstep_);
}

void ChipAgent::tell_reader(Tick at, PinNumber pin, Level level) {
  if (reader_ != nullptr) reader_->input(at, pin, level);
}

void ChipAgent::tell_of_accesses(Tick now) {
  if (aimed_.empty()) return;
  const char* item = lockstep_->works_on();
  for (PinLane* each : aimed_) each->works_on(now, item);
}

class Player {
 public:
  Player(const Stimulus& stimulus, const MakeTop& make, const PlayOptions& options)
      : stimulus_(stimulus),
        options_(options),
        chip_(options, make(), segment_),
        bus_(segment_, chip_),
        user_(chip_, options.kind->random()->words().verbs, Verb::kPin, kLastVerb),
        board_(chip_, options.kind->random()->words().verbs, Verb::kReset, Verb::kReset) {
    timeline_.add(chip_);
    if (std::any_of(stimulus.begin(), stimulus.end(), [](const Action& each) { return each.during != nullptr; }))
      for (PinLane* each : {&user_, &board_}) chip_.tell_of_accesses(*each);
    for (Place& place : places_) timeline_.add(*place.lane);
    const auto alone = [](const Action& each) { return each.verb == Verb::kAlone; };
    if (options.reads_back && std::none_of(stimulus.begin(), stimulus.end(), alone)) {
      reader_.emplace(chip_, user_, options);
      chip_.tell(*reader_);
      timeline_.add(*reader_);
    }
    lockstep().on_event({[](void* self, const profibus::Event& event) {
                           auto& player = *static_cast<Player*>(self);
                           player.coverage_.happened(event);
                           for (PlayListener* each : player.options_.listeners) each->event(event);
                         },
                         this});
    if (!options.listeners.empty()) listen();
  }

  PlayResult run() {
    while (!lockstep().difference() && timeline_.now() < options_.limit && (hand_out() || !all_idle()))
      if (!timeline_.step(options_.limit)) break;
    finish();
    for (PlayListener* each : options_.listeners) each->ends(timeline_.now(), lockstep());
    PlayResult result{lockstep().difference(), lockstep().counts(), begun_, coverage_};
    if (result.difference && !options_.wave.empty()) lockstep().write_wave(options_.wave);
    return result;
  }

 private:
  struct Place {
    Lane* lane = nullptr;
    std::size_t next = 0;  ///< index in the stimulus
  };
  Lockstep& lockstep() { return chip_.lockstep(); }
  /// A listener needs the events: pins of all sides, and telegrams, which are not read otherwise.
  void listen() {
    lockstep().on_pin([this](Tick at, Side side, PinNumber pin, Level level) {
      for (PlayListener* each : options_.listeners) each->pin(at, side, pin, level);
    });
    monitor_.emplace(segment_);
    monitor_->on_telegram = [this](const bus::WireTelegram& telegram) {
      for (PlayListener* each : options_.listeners) each->telegram(timeline_.now(), telegram);
    };
    timeline_.add(*monitor_);
    for (PlayListener* each : options_.listeners) each->begins(lockstep());
  }

  /// Gives every idle lane its next action before the next `sync`; if no lane has one, `sync` is complete.
  bool hand_out() {
    bool any = false;
    do {
      for (Place& place : places_) any = hand_out(place) || any;
    } while (!any && all_idle() && pass_sync());
    return any;
  }
  bool hand_out(Place& place) {
    if (!place.lane->idle()) return false;
    for (; place.next < stimulus_.size() && place.next < sync(); ++place.next) {
      const Action& action = stimulus_[place.next];
      if (!place.lane->takes(action.verb)) continue;
      place.lane->begin(timeline_.now() + action.delay, action);
      if (action.verb == Verb::kSend) coverage_.sent(action.bytes, action.faults);
      if (action.verb == Verb::kSend && monitor_ && monitor_->baud() != action.rate)
        monitor_->set_baud(static_cast<int>(action.rate));
      begun_ = std::max(begun_, ++place.next);
      return true;
    }
    return false;
  }
  std::size_t sync() {
    while (sync_ < stimulus_.size() && (sync_ < passed_ || stimulus_[sync_].verb != Verb::kSync)) ++sync_;
    return sync_;
  }
  bool pass_sync() {
    if (sync() >= stimulus_.size()) return false;
    passed_ = sync() + 1;
    for (Place& place : places_) place.next = passed_;
    return true;
  }
  bool all_idle() const {
    return std::all_of(
        std::begin(places_), std::end(places_), [](const Place& place) { return place.lane->idle(); });
  }
  void finish() {
    const Tick end = std::min(options_.limit, timeline_.now() + kAfterwards);
    while (!lockstep().difference() && timeline_.step(end)) {
    }
    while (!lockstep().difference() && reader_ && reader_->busy() && timeline_.step(options_.limit)) {
    }
    if (!lockstep().difference()) lockstep().advance(std::max(end, timeline_.now()));
  }

  const Stimulus& stimulus_;
  const PlayOptions& options_;
  bus::Timeline timeline_;
  bus::Segment segment_;
  ChipAgent chip_;
  BusLane bus_;
  PinLane user_, board_;
  std::optional<Reader> reader_;
  std::optional<bus::Monitor> monitor_;
  Place places_[3] = {{&bus_}, {&user_}, {&board_}};
  std::size_t sync_ = 0, passed_ = 0, begun_ = 0;
  Coverage coverage_;
};

}  // namespace

PlayResult play(const Stimulus& stimulus, const MakeTop& make, const PlayOptions& options) {
  return Player(stimulus, make, options).run();
}

}  // namespace dsdpv1::cosim
