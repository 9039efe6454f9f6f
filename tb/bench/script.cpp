#include "tb/bench/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bus/baud.hpp"
#include "bus/time_text.hpp"
#include "io/input/units.hpp"
#include "tb/bench/conditions.hpp"
#include "tb/bench/program_options.hpp"

namespace dsdpv1::tb {

using scenario::Action;
using scenario::ActionKind;

Script::Script(const scenario::Scenario& scenario, Stations& stations, bus::Segment& segment, Journal& journal,
               Replies& replies, const std::set<const void*>& left_out, const Observers& observers)
    : scenario_(scenario),
      stations_(stations),
      segment_(segment),
      journal_(journal),
      replies_(replies),
      observers_(observers) {
  const auto is_left_out = [&left_out](const void* what) { return left_out.count(what) != 0; };
  for (std::size_t i = 0; i < scenario.slaves.size(); ++i)
    plan(scenario.slaves[i].release_reset, Kind::kReleaseReset, i);
  for (std::size_t i = 0; i < scenario.masters.size(); ++i) plan(scenario.masters[i].start, Kind::kStartMaster, i);
  for (std::size_t i = 0; i < scenario.masters2.size(); ++i) plan(scenario.masters2[i].start, Kind::kStartMaster2, i);
  for (std::size_t i = 0; i < scenario.script.size(); ++i) {
    if (is_left_out(&scenario.script[i])) continue;
    if (scenario.script[i].at)
      plan(*scenario.script[i].at, Kind::kAction, i);
    else
      waiting_.push_back(i);
  }
  for (std::size_t i = 0; i < scenario.expect.size(); ++i) {
    const scenario::Expectation& expectation = scenario.expect[i];
    expectations_.push_back({describe(expectation), expectation.line, false, "", is_left_out(&expectation)});
    plan(expectation.at.value_or(expectation.by.value_or(scenario.end)), Kind::kExpectation, i);
  }
  for (ExpectationResult& each : expectations_) {
    if (each.left_out) each.seen = "not known, the program does not report it";
    judged_.push_back(each.left_out);
  }
}

void Script::plan(Tick at, Kind kind, std::size_t index) {
  const auto later = [at](const Due& due) { return due.at > at; };
  agenda_.insert(std::find_if_not(agenda_.begin(), agenda_.end(), later), {at, kind, index});
}

Tick Script::next() const { return std::min(changed_at_, agenda_.empty() ? bus::kNever : agenda_.back().at); }

void Script::run(Tick now) {
  changed_at_ = bus::kNever;
  look(now);
  while (!agenda_.empty() && agenda_.back().at <= now) {
    const Due due = agenda_.back();
    agenda_.pop_back();
    carry_out(due, now);
  }
  for (const scenario::Action& action : std::exchange(orders_, {})) {
    observers_.tell(&Observer::acts, action, now);
    act(action, now);
  }
  waits_ = waits();
}

void Script::order(scenario::Action action) {
  orders_.push_back(std::move(action));
  changed_at_ = observers_.now();
  announce();
}

void Script::carry_out(const Due& due, Tick now) {
  const scenario::Scenario& scenario = scenario_;
  switch (due.kind) {
    case Kind::kReleaseReset: {
      const std::string& name = scenario.slaves[due.index].name.text;
      journal_.log(now, name, "script", "RESET rises, the user CPU starts");
      stations_.slave(name).release_reset(now);
      break;
    }
    case Kind::kStartMaster: {
      const std::string& name = scenario.masters[due.index].name.text;
      journal_.log(now, name, "script", "starts");
      stations_.master(name).start();
      break;
    }
    case Kind::kStartMaster2: {
      const std::string& name = scenario.masters2[due.index].name.text;
      journal_.log(now, name, "script", "starts");
      stations_.class2(name)->master().start();
      break;
    }
    case Kind::kAction:
      observers_.tell(&Observer::acts, scenario.script[due.index], now);
      act(scenario.script[due.index], now);
      break;
    case Kind::kResumeUser:
      stations_.slave(scenario.slaves[due.index].name.text).command(now, user_cpu::command::Resume{});
      break;
    case Kind::kEndGlitch: segment_.force(now, std::nullopt); break;
    case Kind::kExpectation: judge(due.index, now, true); break;
  }
}

// --- conditions ------------------------------------------------------------------------------------------------------

void Script::look(Tick now) {
  look_at_actions(now);
  const auto& expect = scenario_.expect;
  for (std::size_t i = 0; i < expect.size(); ++i)
    if (expect[i].by && !judged_[i]) judge(i, now, false);
}

bool Script::waits() const {
  const auto& expect = scenario_.expect;
  for (std::size_t i = 0; i < expect.size(); ++i)
    if (expect[i].by && !judged_[i]) return true;
  return !waiting_.empty();
}

void Script::look_at_actions(Tick now) {
  const auto has_come_true = [this, now](std::size_t index) {
    const scenario::When& when = *scenario_.script[index].when;
    if (!holds(when, {stations_, journal_, replies_})) return false;
    plan(now + when.after, Kind::kAction, index);
    return true;
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), has_come_true), waiting_.end());
}

void Script::judge(std::size_t index, Tick now, bool last_chance) {
  if (judged_[index]) return;
  const scenario::Expectation& expectation = scenario_.expect[index];
  const Facts facts = {stations_, journal_, replies_};
  const bool passed = holds(expectation, facts);
  if (!passed && !last_chance) return;
  ExpectationResult& result = expectations_[index];
  const std::string there = seen(expectation, facts);
  result.passed = passed;
  result.seen = fmt::format("{} at {}", there, bus::moment_text(now));
  judged_[index] = true;
  const std::string& station = expectation.slave.empty() ? "bus" : expectation.slave.text;
  journal_.log(now, station, "expect", fmt::format("{}: {}, seen {}", passed ? "met" : "FAILED", result.text, there));
}

std::vector<ExpectationResult> Script::finish(Tick now, bool interrupted) {
  for (std::size_t i = 0; i < expectations_.size(); ++i) {
    const scenario::Expectation& expectation = scenario_.expect[i];
    if (!interrupted && !expectation.at && !expectation.by) judge(i, now, true);
    if (judged_[i]) continue;
    expectations_[i].seen = "the run ended at " + bus::moment_text(now);
  }
  return expectations_;
}

// --- actions ---------------------------------------------------------------------------------------------------------

void Script::act(const Action& action, Tick now) {
  if (!action.connection.empty()) return stations_.owner_of(action.connection.text).act(action, now);
  if (Class2Station* station = stations_.class2(action.master.text)) return act_on_class2(action, *station, now);
  if (action.what >= ActionKind::kSetOutputs && action.what <= ActionKind::kTelegram) return act_on_master(action, now);
  if (action.what >= ActionKind::kGlitch || action.what == ActionKind::kPlug || action.what == ActionKind::kUnplug)
    return act_on_bus(action, now);
  act_on_user(action, now);
}

void Script::act_on_user(const Action& action, Tick now) {
  namespace command = user_cpu::command;
  SlaveStation& slave = stations_.slave(action.slave.text);
  const auto order = [&](const std::string& text, const user_cpu::Command& what) {
    journal_.log(now, slave.name(), "script", text);
    slave.command(now, what);
  };
  switch (action.what) {
    case ActionKind::kSetInputs:
      return order("inputs " + journal_.in_log(action.bytes), command::SetInputs{action.bytes});
    case ActionKind::kSetDiagnosis:
      return order(fmt::format("diagnosis {:02X}: {}", diagnosis_code(action.diagnosis), journal_.in_log(action.bytes)),
                   command::SetDiagnosis{action.diagnosis, action.bytes});
    case ActionKind::kOfChip: return order_of_chip(action, now);
    case ActionKind::kWrongLength: return order("inputs of a wrong length", command::WrongLength{});
    case ActionKind::kAnswerAcyclic:
      return order("answers acyclic requests otherwise", command::SetAnswering{action.answering});
    case ActionKind::kVerdict:
      return order(action.refuse ? "verdict: wrong" : "verdict: right",
                   command::SendVerdict{action.of == scenario::Verdict::kCfg, action.refuse});
    case ActionKind::kPauseUser:
      order("pauses for " + time_text(*action.duration), command::Stop{});
      return plan(now + *action.duration, Kind::kResumeUser, slave_number(scenario_, slave.name()));
    case ActionKind::kReinitialise:
      journal_.log(now, slave.name(), "script", "initialises the chip again");
      return slave.reinitialise(now, action.new_address, action.cfg);
    default: return reset_chip(action, now);
  }
}

void Script::order_of_chip(const Action& action, Tick now) {
  const user_cpu::command::OfChip command{
      action.word, action.duration.value_or(0), action.block, action.times, action.bytes, action.listen};
  SlaveStation& slave = stations_.slave(action.slave.text);
  const Order& order = *order_of(slave.kind(), action.word);
  for (int i = 0; i < (order.one_by_one ? action.times : 1); ++i) {
    journal_.log(now, slave.name(), "script", order.said(command));
    slave.command(now, command);
  }
}

void Script::reset_chip(const Action& action, Tick now) {
  constexpr Tick kUsual = 10 * bus::kTicksPerUs;
  journal_.log(now, action.slave.text, "script", "RESET falls");
  stations_.slave(action.slave.text).hold_in_reset(now);
  plan(now + action.duration.value_or(kUsual), Kind::kReleaseReset, slave_number(scenario_, action.slave.text));
}

void Script::act_on_bus(const Action& action, Tick now) {
  if (action.what == ActionKind::kGlitch) {
    journal_.log(now, "bus", "script",
                 fmt::format("line forced {} for {}", action.level ? "high" : "low", time_text(*action.duration)));
    segment_.force(now, action.level);
    return plan(now + *action.duration, Kind::kEndGlitch, 0);
  }
  SlaveStation& slave = stations_.slave(action.slave.text);
  if (action.what == ActionKind::kAnswerFault) {
    journal_.log(now, slave.name(), "script",
                 fmt::format("its next {} answers: {}", action.times, scenario::word_of(action.answer_fault)));
    AnswerFault& fault = *stations_.answer_faults.at(slave_number(scenario_, slave.name()));
    return fault.damage(now, action.answer_fault, action.times, action.duration.value_or(0));
  }
  const bool plugged = action.what == ActionKind::kPlug;
  journal_.log(now, slave.name(), "script", plugged ? "plugged in" : "unplugged");
  segment_.plug(slave.chip().station(), now, plugged);
}

void Script::act_on_master(const Action& action, Tick now) {
  bus::Master1& master = stations_.master(action.master.text);
  const auto say = [&](const std::string& text) {
    journal_.log(now, action.master.empty() ? scenario_.masters.front().name.text : action.master.text, "script", text);
  };
  switch (action.what) {
    case ActionKind::kSetOutputs: {
      const std::uint8_t address = target(action);
      bus::Bytes outputs = action.bytes;
      outputs.resize(static_cast<std::size_t>(master.parameters(address).output_length));
      say(fmt::format("outputs of {}: {}", action.slave.text, journal_.in_log(outputs)));
      return master.set_outputs(address, outputs);
    }
    case ActionKind::kGlobalControl: return global_control(action);
    case ActionKind::kOperate: say("Operate"); return master.operate();
    case ActionKind::kClear: say("Clear"); return master.clear();
    case ActionKind::kStopMaster: say("stops"); return master.stop();
    case ActionKind::kStartMaster: say("starts"); return master.start();
    case ActionKind::kChangeBaud: say("baud rate " + baud_text(action.baud)); return stations_.change_baud(action.baud);
    case ActionKind::kTelegram: say("telegram " + journal_.in_log(action.bytes)); return send_telegram(action);
    case ActionKind::kC1Read:
    case ActionKind::kC1Write: return ask_acyclic(action);
    default: return ask(action);
  }
}

void Script::act_on_class2(const Action& action, Class2Station& station, Tick now) {
  const bool start = action.what == ActionKind::kStartMaster;
  journal_.log(now, station.name(), "script", start ? "starts" : "stops");
  start ? station.master().start() : station.master().stop();
}

std::uint8_t Script::target(const Action& action) const {
  if (action.address) return static_cast<std::uint8_t>(*action.address);
  const std::optional<std::uint8_t> listed = stations_.listed_address(action.slave.text);
  return listed ? *listed : stations_.slave(action.slave.text).chip().address();
}

/// An acyclic request; its answer is kept for `reply`.
void Script::ask(const Action& action) {
  bus::Master1& master = stations_.master(action.master.text);
  const auto keep = [this, name = action.master.text, what = action.what](const bus::FdlResult& result) {
    replies_.keep(name, what, {result.answered() && !result.short_acknowledge(), result.answer.data, {}});
  };
  const std::uint8_t address = action.what == ActionKind::kSetSlaveAddress && !action.address
                                   ? stations_.slave(action.slave.text).chip().address()
                                   : target(action);
  switch (action.what) {
    case ActionKind::kReadInputs: return master.read_inputs(address, keep);
    case ActionKind::kReadOutputs: return master.read_outputs(address, keep);
    case ActionKind::kGetCfg: return master.get_cfg(address, keep);
    case ActionKind::kSlaveDiag: return master.slave_diag(address, keep);
    default: break;
  }
  const int ident =
      action.ident.value_or(action.slave.empty() ? 0 : stations_.slave(action.slave.text).station().ident);
  master.set_slave_address(address, static_cast<std::uint8_t>(*action.new_address), static_cast<std::uint16_t>(ident),
                           action.lock, keep);
}

void Script::ask_acyclic(const Action& action) {
  bus::Master1& master = stations_.master(action.master.text);
  const auto slot = static_cast<std::uint8_t>(action.slot), index = static_cast<std::uint8_t>(action.index);
  const auto keep = [this, name = action.master.text, what = action.what](const bus::AcyclicResult& result) {
    replies_.keep(name, what, reply_of(result));
  };
  const std::uint8_t address = target(action);
  if (action.what == ActionKind::kC1Read)
    return master.c1_read(address, slot, index, static_cast<std::uint8_t>(action.length), keep);
  master.c1_write(address, slot, index, action.bytes, keep);
}

void Script::global_control(const Action& action) {
  namespace gc = bus::global_control;
  const auto bit = [](bool wanted, std::uint8_t value) { return wanted ? unsigned{value} : 0U; };
  const unsigned command = bit(action.sync, gc::kSync) | bit(action.unsync, gc::kUnsync) |
                           bit(action.freeze, gc::kFreeze) | bit(action.unfreeze, gc::kUnfreeze) |
                           bit(action.clear, gc::kClearData);
  stations_.master(action.master.text)
      .global_control(static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(action.group));
}

void Script::send_telegram(const Action& action) {
  const scenario::Faults& f = action.faults;
  const auto millibits = [](double bits) { return static_cast<int>(std::lround(bits * 1000)); };
  const auto place = [](const std::optional<int>& at) {
    return at ? std::optional<std::size_t>(static_cast<std::size_t>(*at)) : std::nullopt;
  };
  bus::WireFaults faults;
  faults.wrong_parity_at = place(f.wrong_parity_at);
  faults.missing_stop_at = place(f.missing_stop_at);
  faults.gap_before = place(f.gap_before);
  faults.gap_millibits = millibits(f.gap_bits);
  faults.truncate_after = place(f.truncate_after);
  faults.glitch_at = place(f.glitch_at);
  faults.glitch = {millibits(f.glitch_start_bits), millibits(f.glitch_bits)};
  stations_.master(action.master.text).send_raw(action.bytes, faults);
}

}  // namespace dsdpv1::tb
