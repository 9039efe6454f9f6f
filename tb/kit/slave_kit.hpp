#pragma once
// Slave chips of users on the bench: docs/own_slave.md is the guide, examples/own_slave/ a whole chip.
//
// The kit has what every chip has: RESET, PBRXD, PBTXD and PBRTS, the station, both engines, events, waves and a user
// CPU. A person writes a `UserPort`, which stands between the station and the chip's other pins, a program for the user
// CPU, and the `Parts` that name both. `Kind` makes a kind of chip of them:
//
//   tb::ChipKinds make_kinds() {
//     static const kit::Kind kind(make_parts());
//     return {&kind};
//   }
//   int main(int argc, char** argv) { return app::program(argc, argv, "own_slave", make_kinds); }  // apps/program.hpp
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/time.hpp"
#include "model/profibus/state.hpp"
#include "model/profibus/station.hpp"
#include "model/profibus/user_side.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::kit {

/// Rising edges of the chip's clock, 48 MHz, since the start; edge n is at tick 250 n.
using profibus::Cycle;
/// 1/12 ns since the start. bus::kTicksPerUs and kTicksPerMs are the usual units.
using profibus::Tick;
/// 0 or 1 of one wire, the value of several; kReleased: not driven.
using tb::Level;
constexpr Level kReleased = tb::kLevelZ;
constexpr Tick kTicksPerNs = profibus::kTicksPerNs;

using tb::PinNumber;
/// The pins of every chip of the kit: RESET (low-active), PBRXD, PBTXD, PBRTS. Its own begin with kOwn, in the order of
/// Parts::pins.
enum : PinNumber { kReset, kRxd, kTxd, kRts, kOwn };
/// The chip's own pins are at most so many.
constexpr std::size_t kMostOwnPins = 27;

enum Direction : std::uint8_t { kInput, kOutput };  ///< as the chip sees it

struct Pin {
  const char* name;
  Direction direction;
  Level rest;                 ///< of an output in reset; of an input until the program sets it
  int width = 1;              ///< wires, 1 to 15
  const char* bus = nullptr;  ///< two pins that are the directions of one bus have its name
};

/// The chip as its port has it; outlives the port.
class Chip {
 public:
  virtual ~Chip() = default;

  /// Sets an output of the chip's own, from tick `at` on: in UserPort::input that call's `at`, else the tick of the
  /// edge. The present level changes nothing.
  virtual void drive(Tick at, PinNumber pin, Level level) = 0;
  /// Sets it at edge `now`.
  void drive_at(Cycle now, PinNumber pin, Level level) { drive(now * profibus::kTicksPerCycle, pin, level); }
  /// The present level of any pin.
  virtual Level level(PinNumber pin) const = 0;

  /// Mail of the slave (outputs, parameters to judge, acyclic requests), and commands to it. Commands only in
  /// UserPort::eval.
  virtual profibus::UserSide& user() = 0;
  /// DP state, address, master.
  virtual const profibus::DpSlave& slave() const = 0;
  /// For a port that is firmware beside the station: the station itself, and the log of its events.
  virtual profibus::Station& dp_station() = 0;
  virtual profibus::EventLog& events() = 0;

  /// An event for log, script and result: a row of Parts::reasons, with the numbers of its text (16 bits each).
  virtual void say(Cycle now, const profibus::ReasonRow& reason, unsigned a = 0, unsigned b = 0, unsigned c = 0) = 0;
  /// The scenario's keys under `chip`, if the kind has some (ChipKind::make_chip_settings).
  virtual const tb::OwnSettings& settings() const = 0;
};

/// The state of a port, for a chip that is saved and restored alone (dpsim_chip_save). A port that has one derives from
/// this class too; each `store` calls one template of the port that lists its members (model/profibus/state.hpp).
class StoredPort {
 public:
  virtual ~StoredPort() = default;
  virtual void store(profibus::StateWriter& archive) = 0;
  virtual void store(profibus::StateReader& archive) = 0;
  /// Settings of the chip by name: a state is restored in a chip with the same.
  virtual std::vector<std::pair<std::string, std::uint32_t>> parameters() const { return {}; }
};

/// The part between the station and the chip's own pins. No call comes while RESET is low, except reset().
class UserPort {
 public:
  virtual ~UserPort() = default;

  /// RESET fell: everything as at power-on. The station has been reset, the outputs take their levels of rest.
  virtual void reset() = 0;
  /// An input of the chip's own has another level from `at` on. It is asynchronous: the first edge that sees it is
  /// profibus::first_edge_after(at) (P9).
  virtual void input(Tick at, PinNumber pin, Level level) = 0;
  /// Edge `now`, before the station's. Called at edges of next() and at others: it acts at its own only.
  virtual void eval(Cycle now) = 0;
  /// After the station's edge: sets the outputs that are registers of the edge.
  virtual void show(Cycle now) = 0;
  /// The next edge at which eval() or show() has an effect that comes from neither the station nor an earlier call of
  /// them; kNever: none. Changes of input() that an edge shows are such effects: skip evaluates no other edge.
  virtual Cycle next() const = 0;
  /// Null: the chip cannot be saved alone.
  virtual StoredPort* stored() { return nullptr; }
};

/// A diagnosis that the script has ordered.
struct Diagnosis {
  std::uint8_t type;  ///< for UserSide::new_diagnosis: 00 more bytes, 81 Ext_Diag, 01 no more, 82 Stat_Diag, 02 no more
  std::vector<std::uint8_t> bytes;
};

/// The user CPU as its program has it. The program runs on a separate stack (256 KB) from the release of RESET; only
/// the waits take simulated time. It may end; a reset of the chip, or `reinitialise` of a script, begins it again.
class Cpu {
 public:
  virtual ~Cpu() = default;

  /// Address, ident number, limits, configuration: from `init` and the GSD file.
  virtual const user_cpu::StationConfig& station() const = 0;
  /// The scenario's `cycle`: from the begin of one exchange with the chip to the next, > 0.
  virtual Tick period() const = 0;
  /// The scenario's keys under `user_cpu` of this kind (ChipKind::make_user_settings), and those under `chip`.
  virtual const tb::OwnSettings& settings() const = 0;
  virtual const tb::OwnSettings& chip_settings() const = 0;

  virtual Tick now() const = 0;
  /// Returns at `at`, at once if that has passed.
  virtual void wait_until(Tick at) = 0;
  void wait(Tick ticks) { wait_until(now() + ticks); }
  /// Waits for Parts::interrupt to leave its level of rest, at most until `until`; false: it did not. A change since
  /// the last call counts.
  virtual bool wait_interrupt(Tick until) = 0;
  /// `hear` is called at each change of an output of Parts::told, in order of time, whatever the program does; null:
  /// not any more.
  virtual void on_change(std::function<void(Tick at, PinNumber pin, Level level)> hear) = 0;
  /// Waits for the next of these changes, at most until `until`.
  virtual void wait_change(Tick until) = 0;

  /// Sets an input of the chip now.
  virtual void set(PinNumber pin, Level level) = 0;
  /// The present level of any pin of the chip.
  virtual Level level(PinNumber pin) const = 0;

  /// The inputs that the scenario wants now, `length` of them: as `behaviour` says, or as the script has set them.
  virtual std::vector<std::uint8_t> inputs(std::size_t length) = 0;
  /// The diagnosis to hand over, once for each order of the script; with Parts::diagnosis.
  virtual std::optional<Diagnosis> diagnosis() = 0;
  /// The next order of the script that this kind alone has (ChipKind::orders), once.
  virtual std::optional<user_cpu::command::OfChip> order() = 0;
  /// With Parts::acyclic: the scenario's objects for C1 and C2, and how a script wants them answered now.
  virtual const user_cpu::AcyclicOptions& acyclic() const = 0;

  // --- For results, conditions and expectations.
  /// The program has fetched these outputs.
  virtual void received(std::vector<std::uint8_t> outputs) = 0;
  /// The program has given inputs to the chip: one exchange more.
  virtual void written() = 0;
  /// The chip has taken its initialisation.
  virtual void initialised() = 0;
  /// A step of the program has failed; `code` is one of ChipKind::codes.
  virtual void failed(const std::string& code, const std::string& text) = 0;
};

/// The parts of a kind of chip.
struct Parts {
  const char* name = nullptr;   ///< in scenarios, `chip: {kind: NAME}`: lower case letters, digits, underscores
  const char* title = nullptr;  ///< in reports
  std::vector<Pin> pins = {};
  std::optional<PinNumber> interrupt = {};  ///< an output, for Cpu::wait_interrupt
  std::vector<PinNumber> told = {};         ///< outputs, for Cpu::on_change and wait_change
  profibus::Capacities capacities = {};     ///< bytes that the chip holds of each block
  profibus::ReasonTable reasons = {};       ///< of its port, besides those of every slave
  profibus::Words words = {};               ///< in the texts of every slave's reasons
  bool diagnosis = false;                   ///< its program hands over diagnoses; else a script that has one is refused
  bool acyclic = false;                     ///< it answers C1 and C2; else `dpv1` under `user_cpu` is refused
  std::function<std::unique_ptr<UserPort>(Chip&)> port = {};
  std::function<void(Cpu&)> program = {};
};

/// It has views of pins only, and no RTL. A kind with more derives from this one: its keys, checks, pin groups.
class Kind : public tb::ChipKind {
 public:
  /// Throws std::invalid_argument: no name, port or program; more than kMostOwnPins pins; an interrupt that is not an
  /// output; a code that another of its reasons has.
  explicit Kind(Parts parts);

  const Parts& made_of() const { return parts_; }

  const char* name() const override { return parts_.name; }
  const char* title() const override { return parts_.title; }
  const tb::PinTable& pins() const override { return pins_; }
  const tb::BoardPins& board_pins() const override { return board_pins_; }
  int most_cfg() const override { return parts_.capacities.cfg; }
  bool hands_over_diagnoses() const override { return parts_.diagnosis; }
  const tb::keys::Object& chip_keys() const override;
  std::unique_ptr<tb::OwnSettings> make_chip_settings() const override;
  const tb::keys::Object& user_keys() const override;
  std::unique_ptr<tb::OwnSettings> make_user_settings() const override;
  void check_slave(const tb::scenario::Scenario& scenario, const tb::scenario::Slave& slave) const override;
  std::unique_ptr<tb::PinDevice> make_device(const tb::ChipRequest& request) const override;
  std::unique_ptr<tb::PinChip> make_pin_chip(const tb::ChipRequest& request, std::unique_ptr<tb::PinDevice> device,
                                             bus::Segment& segment) const override;
  tb::MakeUser make_user(const tb::UserRequest& request) const override;
  bool needs_pins(const tb::scenario::Scenario& /*scenario*/, const tb::scenario::Slave& /*slave*/) const override {
    return true;
  }
  const std::vector<profibus::Reason>& reasons() const override { return reasons_; }
  std::string describe(const profibus::Event& event) const override;
  const std::vector<tb::CodeTable>& codes() const override { return codes_; }

 private:
  const Parts parts_;
  tb::PinTable pins_;
  tb::BoardPins board_pins_;
  std::vector<profibus::Reason> reasons_;
  std::vector<tb::CodeTable> codes_;
};

}  // namespace dsdpv1::kit
