#include "cosim/random/player.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "bus/monitor/monitor.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"
#include "cosim/random/play_options.hpp"
#include "kinds/dsdpv1/random/serial_edges.hpp"
#include "model/dpram/crc16.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kAfterwards = 3000 * kCycle;  // so that what the last action has caused is compared as well

/// One lane: takes its next action when the one before has ended.
class Lane : public bus::Agent {
 public:
  virtual bool takes(Verb verb) const = 0;
  /// The action begins at `at`.
  void begin(Tick at, const Action& action) {
    plan(at, action);
    announce();
  }
  bool idle() const { return next() == bus::kNever; }

 protected:
  virtual void plan(Tick at, const Action& action) = 0;
};

/// A lane whose actions may be aimed: they wait for a part of an access of the chip, which whoever runs the chip tells
/// about, so that nobody looks at every cycle.
class AimedLane : public Lane {
 public:
  /// What the chip's access works on now.
  void works_on(Tick now, const char* item) {
    item_ = item;
    if (aimed_ != nullptr && is_of(aimed_->during, item)) fire(now);
  }
  Tick next() const final { return aimed_ != nullptr ? by_ : planned(); }
  void run(Tick now) final {
    if (aimed_ != nullptr)
      fire(now);
    else
      act(now);
  }

 protected:
  virtual void begin_at(Tick at, const Action& action) = 0;
  virtual Tick planned() const = 0;
  virtual void act(Tick now) = 0;

 private:
  void plan(Tick at, const Action& action) override {
    if (action.during == AccessPart::kNone) return begin_at(at, action);
    const Tick now = at - action.delay;
    aimed_ = &action;
    by_ = now + action.within;
    if (is_of(action.during, item_)) fire(now);
  }
  void fire(Tick now) {
    const Action& action = *std::exchange(aimed_, nullptr);
    begin_at(now + action.delay, action);
    announce();
  }

  const char* item_ = "";
  const Action* aimed_ = nullptr;  ///< waits
  Tick by_ = 0;                    ///< ... until then at most
};

/// The chip as a station of the segment, model and RTL in one.
class ChipAgent : public bus::Agent, private bus::Listener {
 public:
  ChipAgent(const PlayOptions& options, std::unique_ptr<Rtl> rtl, bus::Segment& segment)
      : lockstep_(make_lockstep(options, std::move(rtl))),
        listeners_(options.listeners),
        segment_(segment),
        station_(segment.attach("chip", this)) {
    lockstep_->watch({[](void* self, Tick at, tb::PinNumber pin, Level level) {
                        static_cast<ChipAgent*>(self)->drive(at, static_cast<Pin>(pin), level);
                      },
                      this},
                     dsdpv1::mask(Pin::kPbtxd) | dsdpv1::mask(Pin::kPbrts));
  }
  Tick next() const override { return due_.empty() ? lockstep_->next_event() : due_.front().at; }
  void run(Tick now) override {
    lockstep_->advance(now);
    tell();
    for (PlayListener* each : listeners_) each->evaluated(now, *lockstep_);
    if (aimed_.empty()) return;
    const char* item = lockstep_->works_on();
    for (AimedLane* each : aimed_) each->works_on(now, item);
  }
  /// `lane` wants to know what the chip's accesses work on.
  void tell_of_accesses(AimedLane& lane) { aimed_.push_back(&lane); }
  Lockstep& lockstep() { return *lockstep_; }
  Level level(Pin pin) const { return lockstep_->level(number(pin)); }
  void set(Tick at, Pin pin, Level level) {
    lockstep_->set(at, number(pin), level);
    announce();
  }

 private:
  struct Drive {
    Tick at;
    bool enabled, level;
  };
  /// The line answers, so it is told when the call into the chip is over.
  void drive(Tick at, Pin pin, Level level) {
    (pin == Pin::kPbtxd ? level_ : enabled_) = level != 0;
    due_.push_back({at, enabled_, level_});
  }
  void tell() {
    for (std::size_t i = 0; i < due_.size(); ++i) {  // NOLINT(modernize-loop-convert): the list may grow meanwhile
      const Drive due = due_[i];
      segment_.drive(station_, due.at, due.enabled, due.level);
    }
    due_.clear();
  }
  void line_changed(Tick at, bool level) override { set(at, Pin::kPbrxd, level ? 1 : 0); }

  std::unique_ptr<Lockstep> lockstep_;
  const std::vector<PlayListener*>& listeners_;
  std::vector<AimedLane*> aimed_;
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
    bit_ = bus::baud(action.rate).bit;
    sender_.set_timing(bit_);
    sender_.send(at, bus::characters(action.bytes, action.faults));
    answer_by_ = action.reply_bits == 0 ? -1 : sender_.end() + action.reply_bits * bit_;
    look_ = sender_.end();
  }
  /// A glitch may last longer than the telegram: the line is looked at when the sender is through.
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
  /// Looks at PBRTS each bit time: ends when it has fallen, or when no answer has come in time.
  void look(Tick now) {
    const bool answers = chip_.level(Pin::kPbrts) != 0;
    if (answers) answer_by_ = -1;
    look_ = answers || now < answer_by_ ? now + (answers ? kCycle : bit_) : bus::kNever;
  }

  bus::Segment& segment_;
  bus::UartSender sender_;
  const ChipAgent& chip_;
  Tick bit_ = 0, answer_by_ = -1, look_ = bus::kNever, spike_ = bus::kNever, spike_end_ = bus::kNever;
};

class UserLane : public AimedLane {
 public:
  explicit UserLane(ChipAgent& chip) : chip_(chip) {}

  bool takes(Verb verb) const override { return verb >= Verb::kTake && verb <= Verb::kUart; }
  void begin_at(Tick at, const Action& action) override {
    edges_.clear();
    edge_ = 0;
    end_ = at;
    polls_ = 0;
    switch (action.verb) {
      case Verb::kTake: return take(action);
      case Verb::kGive: return add({{0, Pin::kRSta, 0}, {0, Pin::kRReq, 0}}, 0);
      case Verb::kWrite: return write(action, action.address, action.value);
      case Verb::kRead: return read(action);
      case Verb::kBlock: return block(action);
      case Verb::kSpi: return serial(spi_edges(action));
      case Verb::kUart: return uart(action);
      default: return add({{0, action.pin, static_cast<Level>(action.value)}}, 0);
    }
  }
  Tick planned() const override { return edge_ < edges_.size() ? edges_[edge_].at : look_; }
  void act(Tick now) override {
    if (edge_ == edges_.size() && look_ <= now) return look(now);
    for (; edge_ < edges_.size() && edges_[edge_].at <= now; ++edge_) {
      const Edge edge = edges_[edge_];
      if (!edge.poll) {
        chip_.set(edge.at, edge.pin, edge.level);
      } else if ((chip_.level(Pin::kLReq) != 0 || chip_.level(Pin::kLSta) != 0) && ++polls_ < kMostPolls) {
        for (std::size_t i = edge_; i < edges_.size(); ++i) edges_[i].at += poll_every_;
        --edge_;
      }
    }
  }

 private:
  static constexpr int kLastCell = 0x7FF;
  static constexpr int kMostPolls = 400;  // a user who was patient for so long takes it all the same
  struct Edge {
    Tick at;
    Pin pin;
    Level level;
    bool poll = false;
  };
  void add(const std::vector<Edge>& edges, Tick length) {
    for (Edge edge : edges) {
      edge.at += end_;
      edges_.push_back(edge);
    }
    end_ += length;
  }
  void serial(const std::vector<PinEdge>& edges) {
    for (const PinEdge& each : edges) edges_.push_back({end_ + each.at, each.pin, each.level});
    if (!edges.empty()) end_ += edges.back().at;
  }
  void uart(const Action& action) {
    serial(uart_edges(action));
    if (action.reply_bits == 0) return;
    bit_ = uart_bit(action.rate);
    look_ = end_ + bit_ / 2;
    last_low_ = -1;
    reply_by_ = end_ + action.reply_bits * bit_;
  }
  /// Looks at TXD every half bit: ends when it has been high for a character, or when no reply has come in time.
  void look(Tick now) {
    if (chip_.level(Pin::kTxd) == 0) last_low_ = now;
    const bool over = last_low_ >= 0 ? now > last_low_ + bus::kCharacterBits * bit_ : now > reply_by_;
    look_ = over ? bus::kNever : now + bit_ / 2;
  }
  void take(const Action& action) {
    poll_every_ = action.low;
    add({{0, Pin::kRReq, 1}, {4 * kCycle, Pin::kRSta, 0, true}, {4 * kCycle + action.low, Pin::kRSta, 1}}, 0);
  }
  void write(const Action& action, int address, int value) {
    const Tick rise = action.setup + action.low, end = rise + action.hold;
    add({{0, Pin::kA, static_cast<Level>(address & kLastCell)},
         {0, Pin::kDIn, static_cast<Level>(value)},
         {0, Pin::kCsr, 0},
         {action.setup, Pin::kWr, 0},
         {rise, Pin::kWr, 1},
         {end, Pin::kCsr, 1},
         {end, Pin::kDIn, dsdpv1::kLevelZ}},
        end);
  }
  void read(const Action& action) {
    const Tick rise = action.setup + action.low, end = rise + action.hold;
    add({{0, Pin::kA, static_cast<Level>(action.address)},
         {0, Pin::kCsr, 0},
         {action.setup, Pin::kRd, 0},
         {rise, Pin::kRd, 1},
         {end, Pin::kCsr, 1}},
        end);
  }
  void block(const Action& action) {
    const int crc = dpram::crc16(action.bytes.data(), static_cast<int>(action.bytes.size())) ^ action.value;
    for (std::size_t i = 0; i < action.bytes.size(); ++i)
      write(action, action.address + static_cast<int>(i), action.bytes[i]);
    write(action, action.crc_address, crc >> 8);
    write(action, action.crc_address + 1, crc & 0xFF);
  }

  ChipAgent& chip_;
  std::vector<Edge> edges_;
  std::size_t edge_ = 0;
  Tick end_ = 0, poll_every_ = 0;
  Tick bit_ = 0, look_ = bus::kNever, last_low_ = -1, reply_by_ = 0;
  int polls_ = 0;
};

class BoardLane : public AimedLane {
 public:
  explicit BoardLane(ChipAgent& chip) : chip_(chip) {}
  bool takes(Verb verb) const override { return verb == Verb::kReset; }
  void begin_at(Tick at, const Action& action) override {
    fall_ = at;
    rise_ = at + action.low;
  }
  Tick planned() const override { return std::min(fall_, rise_); }
  void act(Tick now) override {
    if (fall_ <= now) {
      chip_.set(fall_, Pin::kReset, 0);
      fall_ = bus::kNever;
    } else {
      chip_.set(rise_, Pin::kReset, 1);
      rise_ = bus::kNever;
    }
  }

 private:
  ChipAgent& chip_;
  Tick fall_ = bus::kNever, rise_ = bus::kNever;
};

class Player {
 public:
  Player(const Stimulus& stimulus, const MakeTop& make, const PlayOptions& options)
      : stimulus_(stimulus),
        options_(options),
        chip_(options, make(), segment_),
        bus_(segment_, chip_),
        user_(chip_),
        board_(chip_) {
    timeline_.add(chip_);
    if (std::any_of(stimulus.begin(), stimulus.end(),
                    [](const Action& each) { return each.during != AccessPart::kNone; }))
      for (AimedLane* each : {static_cast<AimedLane*>(&user_), static_cast<AimedLane*>(&board_)})
        chip_.tell_of_accesses(*each);
    for (Place& place : places_) timeline_.add(*place.lane);
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
    std::size_t next = 0;  ///< of the stimulus
  };
  Lockstep& lockstep() { return chip_.lockstep(); }
  /// Somebody wants to know what happens: pins of all sides, and telegrams, which nobody else here reads.
  void listen() {
    lockstep().on_pin([this](Tick at, Side side, PinNumber pin, Level level) {
      for (PlayListener* each : options_.listeners) each->pin(at, side, static_cast<Pin>(pin), level);
    });
    monitor_.emplace(segment_);
    monitor_->on_telegram = [this](const bus::WireTelegram& telegram) {
      for (PlayListener* each : options_.listeners) each->telegram(timeline_.now(), telegram);
    };
    timeline_.add(*monitor_);
    for (PlayListener* each : options_.listeners) each->begins(lockstep());
  }

  /// Gives every idle lane its next action before the next `sync`; when there is none for any, `sync` is over.
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
      if (action.verb == Verb::kSend && monitor_ && monitor_->baud() != action.rate) monitor_->set_baud(action.rate);
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
    if (!lockstep().difference()) lockstep().advance(std::max(end, timeline_.now()));
  }

  const Stimulus& stimulus_;
  const PlayOptions& options_;
  bus::Timeline timeline_;
  bus::Segment segment_;
  ChipAgent chip_;
  BusLane bus_;
  UserLane user_;
  BoardLane board_;
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
