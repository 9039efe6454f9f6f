// A kind of chip made of its parts.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/input/input_error.hpp"
#include "model/profibus/alarm_reasons.hpp"
#include "model/profibus/chip_reasons.hpp"
#include "tb/bench/program_options.hpp"
#include "tb/bench/record.hpp"
#include "tb/kit/core.hpp"
#include "tb/kit/user.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::kit {
namespace {

struct NoKeys : tb::OwnSettings {};

constexpr PinNumber kNoPin = tb::kMostPins - 1;

std::vector<profibus::Reason> reasons_of(const Parts& parts) {
  const profibus::ReasonTable alarms =
      parts.capacities.alarms > 0 ? profibus::alarm_reasons() : profibus::ReasonTable{nullptr, 0};
  return profibus::reasons_of({parts.reasons, alarms, profibus::reasons()});
}

void check(const Parts& parts) {
  const auto fail = [&parts](const std::string& what) {
    throw std::invalid_argument(fmt::format("kit::Kind {}: {}", parts.name == nullptr ? "" : parts.name, what));
  };
  if (parts.name == nullptr || parts.title == nullptr) fail("no name or no title");
  if (!parts.port || !parts.program) fail("no port or no program");
  if (parts.pins.size() > kMostOwnPins)
    fail(fmt::format("{} pins, expected at most {}", parts.pins.size(), kMostOwnPins));
  const std::size_t interrupt = parts.interrupt ? std::size_t{*parts.interrupt} - kOwn : 0;
  if (parts.interrupt && (interrupt >= parts.pins.size() || parts.pins[interrupt].direction == kInput))
    fail("the interrupt is no output of its own");
  std::set<std::string_view> codes;
  for (const profibus::Reason reason : reasons_of(parts))
    if (!codes.insert(profibus::code(reason)).second)
      fail(fmt::format("two of its reasons have the code {}", profibus::code(reason)));
}

tb::PinTable table_of(const Parts& parts) {
  tb::PinTable table = {
      {"RESET", 1, true}, {"PBRXD", 1, true, nullptr, true}, {"PBTXD", 1, false, nullptr, true}, {"PBRTS", 1, false}};
  for (const Pin& pin : parts.pins)
    table.push_back({pin.name, pin.width, pin.direction == kInput, pin.bus, false,
                     pin.direction == kOutput && pin.rest == kReleased});
  return table;
}

std::vector<tb::CodeTable> codes_of(const Parts& parts) {
  tb::CodeTable chip{
      parts.title, fmt::format("Codes of the chip {}, with those of every DP slave in its words.", parts.name), {}};
  for (const profibus::Reason reason : reasons_of(parts))
    chip.codes.push_back({profibus::code(reason), tb::name(profibus::severity(reason)), reason.row().source,
                          profibus::text_template(reason, parts.words), profibus::advice(reason, parts.words)});
  return {std::move(chip)};
}

}  // namespace

Kind::Kind(Parts parts) : parts_(std::move(parts)) {
  check(parts_);
  pins_ = table_of(parts_);
  board_pins_ = {kReset, kRxd, kTxd, kRts, parts_.interrupt.value_or(kNoPin)};
  for (const PinNumber pin : parts_.told) board_pins_.told |= tb::mask_of(pin);
  reasons_ = reasons_of(parts_);
  codes_ = codes_of(parts_);
}

const tb::keys::Object& Kind::chip_keys() const {
  static const tb::keys::ObjectOf<NoKeys> none("chip", "The chip has no parameters.");
  return none;
}

std::unique_ptr<tb::OwnSettings> Kind::make_chip_settings() const { return std::make_unique<NoKeys>(); }

const tb::keys::Object& Kind::user_keys() const {
  static const tb::keys::ObjectOf<NoKeys> none("user_cpu", "The user CPU.");
  return none;
}

std::unique_ptr<tb::OwnSettings> Kind::make_user_settings() const { return std::make_unique<NoKeys>(); }

std::string Kind::describe(const profibus::Event& event) const { return profibus::describe(event, parts_.words); }

// --- what a program of the kit does not do ---------------------------------------------------------------------------

namespace {

using tb::scenario::ActionKind;

bool is_served(ActionKind what, const Parts& parts) {
  if (!tb::scenario::is_for_user_cpu(what) || what == ActionKind::kOfChip) return true;
  if (what == ActionKind::kSetDiagnosis) return parts.diagnosis;
  if (what == ActionKind::kAnswerAcyclic) return parts.acyclic;
  return what == ActionKind::kSetInputs || what == ActionKind::kReinitialise || what == ActionKind::kPauseUser;
}

bool is_served(const std::string& key, const Parts& parts) {
  if (key == "dpv1") return parts.acyclic;
  for (const char* not_served :
       {"judge_prm", "judge_cfg", "judge_delay", "judge_in_handler", "overwrite_inputs", "retry_delay"})
    if (key == not_served) return false;
  return true;
}

}  // namespace

void Kind::check_slave(const tb::scenario::Scenario& scenario, const tb::scenario::Slave& slave) const {
  const auto check_bytes = [&](const char* what, std::size_t bytes, int line) {
    const auto most = static_cast<std::size_t>(parts_.capacities.io);
    if (bytes > most)
      throw tb::InputError(scenario.file, line,
                           fmt::format("{} of {} bytes, but {} holds {}", what, bytes, name(), most));
  };
  check_bytes("max_inputs", static_cast<std::size_t>(slave.init.max_inputs.value_or(0)), slave.init.line);
  check_bytes("max_outputs", static_cast<std::size_t>(slave.init.max_outputs.value_or(0)), slave.init.line);
  for (const tb::keys::Given& key : slave.user_cpu.given)
    if (!is_served(key.key, parts_))
      throw tb::InputError(scenario.file, key.line,
                           fmt::format("user_cpu has {}, but the program of {} does not serve it, expected behaviour, "
                                       "constant, cycle, start_delay{} and keys of its own",
                                       key.key, name(), parts_.acyclic ? ", dpv1" : ""));
  if (slave.user_cpu.behaviour == tb::scenario::Behaviour::kIdle)
    throw tb::InputError(scenario.file, slave.user_cpu.line,
                         fmt::format("behaviour is idle, but the program of {} always exchanges, expected loop_back, "
                                     "count or constant",
                                     name()));
  for (const tb::scenario::Action& action : scenario.script) {
    if (action.slave.text != slave.name.text) continue;
    if (action.what == ActionKind::kSetInputs) check_bytes("set_inputs", action.bytes.size(), action.line);
    if (!is_served(action.what, parts_))
      throw tb::InputError(
          scenario.file, action.line,
          fmt::format("{}, but the program of {} does not serve it, expected set_inputs, {}{}pause_user "
                      "or reinitialise",
                      action.word, name(), parts_.diagnosis ? "set_diagnosis, " : "",
                      parts_.acyclic ? "answer_acyclic, " : ""));
  }
}

// --- on the bench ----------------------------------------------------------------------------------------------------

std::unique_ptr<tb::PinDevice> Kind::make_device(const tb::ChipRequest& request) const {
  return std::make_unique<Device>(parts_, request);
}

std::unique_ptr<tb::PinChip> Kind::make_pin_chip(const tb::ChipRequest& request, std::unique_ptr<tb::PinDevice> device,
                                                 bus::Segment& segment) const {
  return std::make_unique<OnSegment>(*this, request, std::move(device), segment);
}

tb::MakeUser Kind::make_user(const tb::UserRequest& request) const {
  return
      [this, &user = request.slave.user_cpu, chip = request.slave.chip,
       &pins = static_cast<OwnPins&>(*request.chip.user_side())](const user_cpu::StationConfig& station, Tick start) {
        return std::make_unique<Program>(parts_, pins, *user.own, *chip, tb::program_options(user, station), start);
      };
}

}  // namespace dsdpv1::kit
