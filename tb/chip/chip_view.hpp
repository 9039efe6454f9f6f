#pragma once
// One chip as the bench drives and sees it, whichever kind it is and whichever way it is executed (pins of the core,
// TLM module, RTL).
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

/// What every slave chip can say of itself.
struct ChipStatus {
  profibus::DpState dp_state = profibus::DpState::kOffline;
  std::optional<int> baud;               ///< index of bus/baud.hpp, absent while it searches
  std::uint8_t address = 0;              ///< the station's present address, 0 before the initialisation
  std::uint8_t master = 255;             ///< the parameterising master, 255 = none
  std::uint64_t telegrams_received = 0;  ///< error-free telegrams of all stations
  std::uint64_t telegrams_answered = 0;  ///< answers sent
  std::uint64_t data_exchanges = 0;      ///< executed data exchanges, repetitions not counted
  std::uint64_t outputs_missed = 0;      ///< outputs that newer ones replaced before the user had fetched them
  profibus::RmRegistry c2 = {};          ///< table 30: who has the C2 channels
  std::uint64_t accesses = 0;            ///< of the chip to the memory that it shares with the user, if it does
  Tick longest_wait = 0;                 ///< longest time that it waited there for the user
};

/// What the status of any chip on the blocks of model/profibus has in common.
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

/// Who hears what happens at chips; overrides what concerns it. `slave`: the number with which it listens to the chip.
class ChipListener {
 public:
  virtual ~ChipListener() = default;

  /// Changes of the watched pins, in order of time.
  virtual void pin(std::size_t /*slave*/, Tick /*at*/, PinNumber /*pin*/, Level /*level*/) {}
  /// The pin that interrupts the user CPU, told before pin().
  virtual void interrupt(std::size_t /*slave*/, Tick /*at*/, bool /*level*/) {}
  virtual void event(std::size_t /*slave*/, const profibus::Event& /*event*/) {}
  // What follows is told to whom wants it: ChipNews.
  /// The pin has the levels of the run that begins on the line now, until its end or until it is cut: changes up to
  /// then may be told or not, also one to the level that the pin has already.
  virtual void follows(std::size_t /*slave*/, PinNumber /*pin*/) {}
  /// The user CPU begins a read, whose first edge is still to come, and samples the data at `sample`: no pin shows
  /// that.
  virtual void read(std::size_t /*slave*/, Tick /*sample*/) {}
  /// An inner signal (ChipKind::inner_signals) has changed; one of words has no level, any other no word. Only where
  /// ChipRequest::inside wants it.
  virtual void inside(std::size_t /*slave*/, Tick /*at*/, std::size_t /*signal*/, Level /*level*/,
                      const std::string& /*word*/) {}
  /// What the user CPU does at the chip's pins, in words: an access, a pin that it moves.
  virtual void action(std::size_t /*slave*/, Tick /*at*/, const std::string& /*words*/) {}
};

/// News that are not made where nobody wants them. Without runs all changes are told.
struct ChipNews {
  bool runs = false, reads = false, inside = false, actions = false;
};

class ChipView {
 public:
  virtual ~ChipView() = default;

  virtual void set_reset(Tick at, bool level) = 0;
  /// The user CPU was reset at `at`: its bus is idle again, an access begun is forgotten.
  virtual void reset_host(Tick at) = 0;
  virtual bus::StationId station() const = 0;
  /// Status and levels as of the last evaluation; `sync` brings them to the present time.
  virtual ChipStatus status() const = 0;
  /// Of the station, as in `status`.
  virtual std::uint8_t address() const = 0;
  virtual Level level(PinNumber pin) const = 0;
  /// A cell of the memory that chip and user share, without side effects.
  virtual std::uint8_t peek(std::uint16_t address) const = 0;
  virtual void sync(Tick now) = 0;

  /// What the user CPU of this kind has hold of; null: no user CPU of the bench can.
  virtual user_cpu::UserSide* user_side() { return nullptr; }

  /// Whether ChipListener::follows is told.
  virtual bool tells_runs() const { return false; }

  /// Somebody else acts before the next edge of an access under way.
  virtual void pause_access() {}

  /// From now on changes of these pins are told, all of them; a telegram and an access under way, too. Only of cores
  /// by their pins.
  virtual void watch(Tick /*now*/, PinMask /*pins*/) {}

  /// From now on `listener`, which must outlive the calls, is told, and nobody else.
  void listen(ChipListener& listener, std::size_t number, const ChipNews& wanted = {}) {
    listener_ = &listener;
    number_ = number;
    wanted_ = wanted;
  }

 protected:
  ChipListener* listener_ = nullptr;
  std::size_t number_ = 0;
  ChipNews wanted_;  ///< none without a listener
};

}  // namespace dsdpv1::tb
