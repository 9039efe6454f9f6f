#include "kinds/board/untold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb {
namespace {

using keys::Given;
using scenario::Condition;

bool is_one_of(const std::string& key, const std::vector<std::string>& keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Keys of user_cpu that concern the program; the others concern processor, board and bus.
bool is_for_the_program(const std::string& key) {
  static const std::vector<std::string> keys = {
      "behaviour",   "constant",  "overwrite_inputs", "start_delay", "cycle", "judge_delay", "judge_in_handler",
      "retry_delay", "judge_prm", "judge_cfg",        "dpv1",        "mode",  "user_wd",     "wd_baud_control"};
  return is_one_of(key, keys);
}

/// Keys of init that masters also use.
bool is_for_masters(const std::string& key) {
  static const std::vector<std::string> keys = {"ident", "max_inputs", "max_outputs", "cfg"};
  return is_one_of(key, keys);
}

/// The part of the program's state that a condition needs; nullopt: none.
std::optional<std::string> wanted(const Condition& condition, const std::string& slave, const char* driver_errors) {
  if (condition.slave.text != slave) return std::nullopt;
  if (condition.outputs) return fmt::format("outputs are those that the program of {} has fetched", slave);
  if (condition.event.text.rfind(driver_errors, 0) == 0)
    return fmt::format("event {} is counted by the driver in the program of {}", condition.event.text, slave);
  return std::nullopt;
}

class Finder {
 public:
  Finder(const scenario::Scenario& scenario, const scenario::Slave& slave, UntoldProgram program)
      : scenario_(scenario),
        slave_(slave),
        name_(std::filesystem::path(program.path).filename().string()),
        program_(std::move(program)),
        leave_out_(program_.how == WithoutMailbox::kLeaveOut) {}

  Untold find() {
    not_told_.push_back(fmt::format("address (line {})", slave_.line));
    for (const Given& key : slave_.init.given) setting(key, "init." + key.key, !is_for_masters(key.key));
    for (const Given& key : slave_.user_cpu.given)
      if (is_for_the_program(key.key)) setting(key, key.key, true);
    found_.notes.push_back(
        fmt::format("{} {}: its counters and the outputs that it has fetched are not known", name_, program_.because));
    found_.notes.push_back("it is not told " + join(not_told_));
    for (const scenario::Action& each : scenario_.script) action(each);
    for (const scenario::Expectation& each : scenario_.expect)
      if (const auto what = wanted(each, slave_.name.text, program_.driver_errors))
        demanded(&each, each.line, *what, "tell them");
    return std::move(found_);
  }

 private:
  void setting(const Given& key, const std::string& name, bool only_for_the_program) {
    not_told_.push_back(key.option.empty() ? fmt::format("{} (line {})", name, key.line) : name);
    if (!only_for_the_program || leave_out_) return;
    const std::string what = fmt::format("{} is for the program of {}", name, slave_.name.text);
    if (!key.option.empty()) throw InputError(key.option, 0, refusal(what, "be told"));
    if (program_is_of_the_file()) throw InputError(scenario_.file, key.line, refusal(what, "be told"));
  }

  bool program_is_of_the_file() const {
    const auto& given = slave_.user_cpu.given;
    return std::any_of(given.begin(), given.end(), [](const Given& key) {
      return (key.key == "elf" || key.key == "program") && key.option.empty();
    });
  }

  void action(const scenario::Action& action) {
    const std::string& name = slave_.name.text;
    if (action.slave.text == name && scenario::is_for_user_cpu(action.what) && action.word != program_.not_for_it)
      return demanded(&action, action.line, fmt::format("{} is for the program of {}", action.word, name), "be told");
    if (!action.when) return;
    if (const auto what = wanted(*action.when, name, program_.driver_errors))
      demanded(&action, action.when->line, *what, "tell them");
  }

  void demanded(const void* of, int line, const std::string& what, const char* cannot) {
    if (!leave_out_) throw InputError(scenario_.file, line, refusal(what, cannot));
    found_.left_out.insert(of);
    found_.notes.push_back(fmt::format("left out: {}:{}: {}", scenario_.file, line, what));
  }

  std::string refusal(const std::string& what, const char* cannot) const {
    const char* other = program_.how ? ", or user_cpu: {without_mailbox: leave_out}" : "";
    return fmt::format("{}, and {}, which {}, cannot {}; expected what chip and bus show{}", what, name_,
                       program_.because, cannot, other);
  }

  const scenario::Scenario& scenario_;
  const scenario::Slave& slave_;
  const std::string name_;
  const UntoldProgram program_;
  bool leave_out_;
  std::vector<std::string> not_told_;
  Untold found_;
};

}  // namespace

Untold untold(const scenario::Scenario& scenario, const scenario::Slave& slave, UntoldProgram program) {
  return Finder(scenario, slave, std::move(program)).find();
}

}  // namespace dsdpv1::tb
