#include "tb/scenario/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/input/units.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb::scenario {
namespace {

class Checker {
 public:
  explicit Checker(const Scenario& scenario) : scenario_(scenario) {
    for (const Slave& slave : scenario.slaves) slaves_.push_back(slave.name.text);
    for (const Master& master : scenario.masters) masters_.push_back(master.name.text);
    for (const Master2& master : scenario.masters2) {
      masters2_.push_back(master.name.text);
      for (const Connection& connection : master.connections) connections_.push_back(connection.name.text);
    }
  }

  void run(const Action& action) const { check_action(action); }
  void run() const {
    check_names();
    for (const Slave& slave : scenario_.slaves) check_slave(slave);
    for (const Master& master : scenario_.masters) check_master(master);
    for (const Master2& master : scenario_.masters2) check_master2(master);
    for (const Action& action : scenario_.script) check_action(action);
    for (const Expectation& expectation : scenario_.expect) check_expectation(expectation);
    for (const Allow& allow : scenario_.allow) {
      check_slave_name(allow.slave);
      check_code(allow.event);
    }
  }

 private:
  [[noreturn]] void fail(int line, const std::string& text) const { throw InputError(scenario_.file, line, text); }

  /// Names appear in logs, waves and result files: letters, digits and underscores, each only once.
  void check_names() const {
    std::map<std::string, int> seen;
    const auto check = [&](const Name& name) {
      const auto good = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
      if (name.text.size() > 32 || !std::all_of(name.text.begin(), name.text.end(), good))
        fail(name.line, fmt::format("name is \"{}\", expected 1 to 32 letters, digits and _", name.text));
      if (name.text == "bus" || name.text == "script")
        fail(name.line, fmt::format("name {} is taken, expected any other", name.text));
      const auto [place, fresh] = seen.emplace(name.text, name.line);
      if (!fresh)
        fail(name.line,
             fmt::format("name {} is already that of line {}, expected each name once", name.text, place->second));
    };
    for (const Slave& slave : scenario_.slaves) check(slave.name);
    for (const Master& master : scenario_.masters) check(master.name);
    for (const Master2& master : scenario_.masters2) {
      check(master.name);
      for (const Connection& connection : master.connections) check(connection.name);
    }
  }

  void check_known(const Name& name, const char* what, const std::vector<std::string>& known) const {
    if (name.empty() || std::find(known.begin(), known.end(), name.text) != known.end()) return;
    if (known.empty()) fail(name.line, fmt::format("{} {} does not exist, the scenario has none", what, name.text));
    fail(name.line, fmt::format("{} {} does not exist{}, expected {}", what, name.text, did_you_mean(name.text, known),
                                join(known)));
  }
  void check_slave_name(const Name& name) const { check_known(name, "slave", slaves_); }
  void check_master_name(const Name& name) const { check_known(name, "master", masters_); }
  void check_connection_name(const Name& name) const { check_known(name, "connection", connections_); }
  void check_any_master_name(const Name& name) const {
    std::vector<std::string> all = masters_;
    all.insert(all.end(), masters2_.begin(), masters2_.end());
    check_known(name, "master", all);
  }

  void check_code(const Name& code) const {
    const auto has_it = [&code](const Slave& slave) { return is_code(*slave.kind, code.text); };
    if (code.empty() || std::any_of(scenario_.slaves.begin(), scenario_.slaves.end(), has_it)) return;
    const std::vector<std::string>& codes = all_codes(*scenario_.kind);
    fail(code.line, fmt::format("event {} does not exist{}, expected the codes of dsdpv1-sim reasons", code.text,
                                did_you_mean(code.text, codes)));
  }

  void check_slave(const Slave& slave) const {
    check_objects(slave.user_cpu.dpv1);
    slave.kind->check_user(*slave.user_cpu.own, *slave.chip, {scenario_.file}, slave.name.text, slave.line);
    slave.kind->check_slave(scenario_, slave);
    if (slave.gsd.empty() && !slave.modules.empty())
      fail(slave.modules.front().line, "modules without gsd, expected the modules of a GSD file");
    if (!slave.gsd.empty()) return;
    const InitData& init = slave.init;
    const auto need = [&](bool there, const char* key) {
      if (!there)
        fail(slave.line,
             fmt::format("slave {} has neither gsd nor init: {}, one of them is needed", slave.name.text, key));
    };
    need(init.ident.has_value(), "ident");
    need(init.max_inputs.has_value(), "max_inputs");
    need(init.max_outputs.has_value(), "max_outputs");
    need(init.cfg.has_value(), "cfg");
  }

  void check_objects(const Dpv1User& user) const {
    std::map<std::pair<int, int>, int> seen;
    if (user.im0) seen[{0, 255}] = user.im0->line;
    for (const Dpv1Object& object : user.objects) {
      const auto [place, fresh] = seen.emplace(std::pair(object.slot, object.index), object.line);
      if (!fresh)
        fail(object.line, fmt::format("slot {} index {} is already taken in line {}, expected each once", object.slot,
                                      object.index, place->second));
      if (!object.read && !object.write && !object.transport)
        fail(object.line, "an object needs at least one of read, write, transport");
      if (object.min_length > static_cast<int>(object.data.size()))
        fail(object.line, fmt::format("min_length is {}, expected up to the length of data, {}", object.min_length,
                                      object.data.size()));
      if (object.transport && object.classes == user_cpu::kClass1)
        fail(object.line, "transport is a service of C2, it needs classes: both or class_2");
    }
  }

  void check_master(const Master& master) const {
    check_free_address(master);
    if (!scenario_.masters2.empty() && !master.bus.ring)
      fail(master.line, fmt::format("master {} is alone on the bus, beside masters2 it needs bus: {{ring: true}}",
                                    master.name.text));
    for (const MasterSlave& slave : master.slaves) check_master_slave(slave);
  }

  void check_master2(const Master2& master) const {
    check_free_address(master);
    for (const Master& other : scenario_.masters) {
      if (other.address == master.address)
        fail(master.line, fmt::format("master {} has address {} of master {}, expected each address once",
                                      master.name.text, master.address, other.name.text));
    }
    for (const Connection& connection : master.connections) check_slave_name(connection.slave);
  }

  template <class AnyMaster>
  void check_free_address(const AnyMaster& master) const {
    for (const Slave& slave : scenario_.slaves) {
      if (slave.address == master.address)
        fail(master.line, fmt::format("master {} has address {} of slave {}, expected each address once",
                                      master.name.text, master.address, slave.name.text));
    }
  }

  void check_master_slave(const MasterSlave& slave) const {
    check_slave_name(slave.slave);
    if (slave.slave.empty() && slave.gsd.empty() && (!slave.ident || !slave.cfg))
      fail(slave.line, "a master's slave needs slave, gsd, or ident and cfg");
    if (slave.gsd.empty() && slave.slave.empty() && !slave.modules.empty())
      fail(slave.modules.front().line, "modules without gsd, expected the modules of a GSD file");
    for (const std::uint8_t group : slave.groups)
      if (group < 1 || group > 8) fail(slave.line, fmt::format("groups holds {}, expected 1 to 8", group));
  }

  void check_time(const std::optional<bus::Tick>& time, const char* key, int line) const {
    if (time && *time > scenario_.end)
      fail(line, fmt::format("{} is {}, expected up to the end of the run, {}", key, time_text(*time),
                             time_text(scenario_.end)));
  }

  void check_condition(const Condition& condition) const {
    check_slave_name(condition.slave);
    check_master_name(condition.master);
    check_connection_name(condition.connection);
    check_code(condition.event);
    const bool about_slave = condition.dp_state || condition.baud || condition.station_address ||
                             condition.data_exchanges || condition.data_exchanges_at_most || condition.inputs ||
                             condition.outputs || !condition.event.empty() || condition.tsdr_min ||
                             condition.tsdr_max || condition.longest_wait_at_most;
    if (about_slave && condition.slave.empty()) fail(condition.line, "slave is missing, expected " + join(slaves_));
    if ((condition.reply || condition.outcome) != condition.reply_of.has_value())
      fail(condition.line, "reply or outcome and reply_of are only allowed together");
    if (condition.outcome && !acyclic(*condition.reply_of))
      fail(condition.line, "outcome is only known of acyclic services, expected reply");
    if (condition.connection_state && condition.connection.empty())
      fail(condition.line, "connection_state without connection, expected a connection's name");
    if (condition.reply_of && class2(*condition.reply_of) == condition.connection.empty())
      fail(condition.line, "connection belongs to the services c2_read, c2_write and c2_transport");
    if (condition.reply_of && !class2(*condition.reply_of) && scenario_.masters.empty())
      fail(condition.line, "reply_of needs a master, the scenario has none");
    if (condition.event.empty() && condition.count_at_most)
      fail(condition.line, "count_at_most without event, expected an event's code");
  }

  void check_expectation(const Expectation& expectation) const {
    check_condition(expectation);
    check_time(expectation.at, "at", expectation.line);
    check_time(expectation.by, "by", expectation.line);
  }

  void check_action(const Action& action) const {
    check_slave_name(action.slave);
    if (action.what == ActionKind::kAnswerFault &&
        (action.answer_fault == AnswerFaultKind::kLate) != action.duration.has_value())
      fail(action.line, "for is the delay of fault: late, expected both or neither");
    const bool any_class = action.what == ActionKind::kStopMaster || action.what == ActionKind::kStartMaster;
    any_class ? check_any_master_name(action.master) : check_master_name(action.master);
    check_connection_name(action.connection);
    check_time(action.at, "at", action.line);
    if (action.when) check_condition(*action.when);
    if (action.what == ActionKind::kOfChip)
      check_order(action);
    else if (action.bytes.size() > 255)
      fail(action.line, fmt::format("bytes has {} bytes, expected 0 to 255", action.bytes.size()));
    switch (action.what) {
      case ActionKind::kReadInputs:
      case ActionKind::kReadOutputs:
      case ActionKind::kGetCfg:
      case ActionKind::kSlaveDiag:
      case ActionKind::kSetSlaveAddress: check_target(action); break;
      default: break;
    }
    const bool named_class2 = any_class && !action.master.empty();
    if (needs_master(action.what) && !named_class2 && scenario_.masters.empty())
      fail(action.line, "this needs a master, the scenario has none");
  }

  void check_order(const Action& action) const {
    for (const Slave& slave : scenario_.slaves) {
      if (slave.name.text != action.slave.text) continue;
      if (order_of(*slave.kind, action.word) == nullptr)
        fail(action.line, fmt::format("slave {} is a {}, expected a slave of a kind with {}", slave.name.text,
                                      slave.kind->title(), action.word));
      slave.kind->check_order(action.word, *slave.user_cpu.own, *slave.chip, {scenario_.file}, action.line);
    }
  }

  void check_target(const Action& action) const {
    if (action.slave.empty() == !action.address.has_value())
      fail(action.line, "exactly one of slave and address is needed");
    if (action.what == ActionKind::kSetSlaveAddress && action.slave.empty() && !action.ident)
      fail(action.line, "ident is missing, it can only be left out where slave is named");
  }

  static bool class2(ActionKind what) { return what >= ActionKind::kC2Connect && what <= ActionKind::kC2Raw; }
  static bool acyclic(ActionKind what) {
    return what == ActionKind::kC1Read || what == ActionKind::kC1Write || class2(what);
  }
  static bool needs_master(ActionKind what) { return what >= ActionKind::kSetOutputs && what <= ActionKind::kTelegram; }

  const Scenario& scenario_;
  std::vector<std::string> slaves_, masters_, masters2_, connections_;
};

}  // namespace

void check(const Scenario& scenario) { Checker(scenario).run(); }

void check(const Scenario& scenario, const Action& action) { Checker(scenario).run(action); }

}  // namespace dsdpv1::tb::scenario
