#pragma once
// The bench's interface to one chip of any kind in any execution (pins of the core, TLM module, RTL).
#include <cstdint>
#include <optional>
#include <string>

#include "bus/wire/segment.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/event.hpp"
#include "model/profibus/rm_registry.hpp"
#include "tb/chip/pins/pins.hpp"
#include "tb/chip/user_cpu/user_side.hpp"

namespace dsdpv1::tb {

using bus::Tick;

/// Status values of every slave chip.
struct ChipStatus {
  profibus::DpState dp_state = profibus::DpState::kOffline;
  std::optional<int> baud;               ///< index of bus/baud.hpp, absent while it searches
  std::uint8_t address = 0;              ///< the station's present address, 0 before the initialisation
  std::uint8_t master = 255;             ///< the parameterising master, 255 = none
  std::uint64_t telegrams_received = 0;  ///< error-free telegrams of all stations
  std::uint64_t telegrams_answered = 0;  ///< answers sent
  std::uint64_t data_exchanges = 0;      ///< executed data exchanges, repetitions not counted
  std::uint64_t outputs_missed = 0;      ///< outputs that newer ones replaced before the user fetched them
  profibus::RmRegistry c2 = {};          ///< table 30: the masters that hold the C2 channels
  std::uint64_t accesses = 0;            ///< of the chip to the memory shared with the user, if any
  Tick longest_wait = 0;                 ///< longest wait there for the user
};

/// The common part of the status of all chips with the blocks of model/profibus.
template <class Status>
ChipStatus common_status(const Status& own) {
  ChipStatus status;
  status.dp_state = own.dp_state;
  if (own.baud_index.known()) status.baud = own.baud_index.code();
  status.address = own.address;
  status.master = own.master;
  status.telegrams_received = own.telegrams_received;
  status.telegrams_answered = own.telegrams_answered;
  status.data_exchanges = own.data_exchanges;
  status.outputs_missed = own.outputs_missed;
  return status;
}

/// Receives the events of chips; derived classes override the calls that they need. `slave`: the number given to
/// listen().
class ChipListener {
 public:
  virtual ~ChipListener() = default;

  /// Changes of the watched pins, in order of time.
  virtual void pin(std::size_t /*slave*/, Tick /*at*/, PinNumber /*pin*/, Level /*level*/) {}
  /// Several of them. With ChipRequest::late those of an access come when it is over, if nobody acts in between; those
  /// of many accesses of the chip to its memory that nothing else shows, with the next change of another pin, and only
  /// the last ones: as many as PinHistory keeps.
  virtual void edges(std::size_t slave, const PinEdge* first, const PinEdge* last) {
    for (; first != last; ++first) pin(slave, first->at, first->pin, first->level);
  }
  /// The pin that interrupts the user CPU, reported before pin().
  virtual void interrupt(std::size_t /*slave*/, Tick /*at*/, bool /*level*/) {}
  virtual void event(std::size_t /*slave*/, const profibus::Event& /*event*/) {}
  /// True if an agent may act at the tick of an event, which then interrupts an access under way.
  virtual bool acts_on_events() const { return true; }
  // The following are only reported on request: ChipNews.
  // The pin follows the run that begins on the line now, until its end or until it is cut: changes up to then may be
  // reported or not, even one to the present level.
  virtual void follows(std::size_t /*slave*/, PinNumber /*pin*/) {}
  /// The user CPU begins a read, whose first edge is still to come, and samples the data at `sample`, which no pin
  /// shows.
  virtual void read(std::size_t /*slave*/, Tick /*sample*/) {}
  /// The user CPU moves a pin as it has seen another: it looked at `pin` last at `at`, negative: never.
  virtual void looked(std::size_t /*slave*/, PinNumber /*pin*/, Tick /*at*/) {}
  /// An internal signal (ChipKind::inner_signals) has changed; signals of words have no level, others no word. Only
  /// with ChipRequest::inside.
  virtual void inside(std::size_t /*slave*/, Tick /*at*/, std::size_t /*signal*/, Level /*level*/,
                      const std::string& /*word*/) {}
  /// An access of the user that no pin shows, at the tick at which it acts; a read with its answer.
  virtual void accessed(std::size_t /*slave*/, Tick /*at*/, std::uint16_t /*address*/, std::uint8_t /*value*/,
                        bool /*write*/) {}
  /// An action of the user CPU at the chip's pins, as text: an access, or a change of a pin.
  virtual void action(std::size_t /*slave*/, Tick /*at*/, const std::string& /*words*/) {}
};

/// Optional reports; `reads`: also looked(). Without runs all changes are reported.
struct ChipNews {
  bool runs = false, reads = false, inside = false, actions = false;
};

class ChipView {
 public:
  virtual ~ChipView() = default;

  virtual void set_reset(Tick at, bool level) = 0;
  /// The user CPU was reset at `at`: its bus idles, an access in progress is dropped.
  virtual void reset_host(Tick at) = 0;
  virtual bus::StationId station() const = 0;
  /// Status and levels at the last evaluation; `sync` advances them to the present time.
  virtual ChipStatus status() const = 0;
  /// Address of the station, as in `status`.
  virtual std::uint8_t address() const = 0;
  virtual Level level(PinNumber pin) const = 0;
  /// A cell of the memory shared by chip and user, without side effects.
  virtual std::uint8_t peek(std::uint16_t address) const = 0;
  virtual void sync(Tick now) = 0;

  /// The interface for a user CPU of this kind; null: the bench cannot connect one.
  virtual user_cpu::UserSide* user_side() { return nullptr; }

  /// Whether its user CPU tells its looks: ChipListener::looked.
  virtual bool tells_looks() const { return true; }

  /// While an input changes in its user's turn, for a chip whose outputs may follow at once: they change in that turn.
  virtual bool is_in_users_turn() const { return false; }

  /// True if it reports ChipListener::follows.
  virtual bool tells_runs() const { return false; }

  /// Another agent acts before the next edge of the present access.
  virtual void pause_access() {}

  /// Reports all changes of these pins from now on, including those of a telegram or access in progress. Only for cores
  /// by their pins.
  virtual void watch(Tick /*now*/, PinMask /*pins*/) {}

  /// From now on reports only to `listener`, which must outlive the calls.
  void listen(ChipListener& listener, std::size_t number, const ChipNews& wanted = {}) {
    listener_ = &listener;
    number_ = number;
    wanted_ = wanted;
  }

 protected:
  ChipListener* listener_ = nullptr;
  std::size_t number_ = 0;
  ChipNews wanted_;  ///< empty without a listener
};

}  // namespace dsdpv1::tb
