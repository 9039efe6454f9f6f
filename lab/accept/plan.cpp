#include "lab/accept/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/input/units.hpp"
#include "tb/bench/setup.hpp"

namespace dsdpv1::tb::accept {
namespace {

/// A text of YAML in quotes.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

std::string absolute(const std::string& path) { return quoted(std::filesystem::absolute(path).string()); }

std::string module_list(const std::vector<std::string>& modules) {
  std::string text;
  for (const std::string& module : modules) text += (text.empty() ? "" : ", ") + quoted(module);
  return "[" + text + "]";
}

/// Addresses of kMaster2, kMaster and kProbe: the first that the slave does not have.
std::vector<int> master_addresses(int slave) {
  std::vector<int> addresses;
  for (int address = 1; addresses.size() < 3; ++address)
    if (address != slave) addresses.push_back(address);
  return addresses;
}

std::string words_of_master(const bus::Gsd& gsd, std::uint32_t seed) {
  std::string keys = fmt::format("watchdog: 100ms, outputs: random, seed: {}", seed);
  const auto add = [&keys](bool wanted, const char* key) {
    if (wanted) keys += std::string(", ") + key + ": true";
  };
  add(gsd.sync, "sync");
  add(gsd.freeze, "freeze");
  add(gsd.dpv1, "dpv1");
  return keys;
}

bool is_for_this_computer(const std::string& program) {
  constexpr std::size_t kMachine = 18;  // of the ELF header, 2 bytes
  constexpr char kArm = 40;
  std::ifstream in(program, std::ios::binary);
  std::array<char, kMachine + 2> head{};
  return in.read(head.data(), head.size()) && head[0] == '\x7F' && head[1] == 'E' && head[kMachine] != kArm;
}

/// What the native CPU and firmware with a mailbox are told. Other firmware does what it does.
std::string words_of_device(const Order& order, const bus::Gsd& gsd) {
  if (is_for_this_computer(order.program))
    return "    user_cpu:\n      kind: process\n      program: " + absolute(order.program) + "\n";
  std::string data;
  for (int i = 0; i < order.object.length; ++i) data += fmt::format("{}{:02X}", i == 0 ? "" : " ", 0xA0 + i % 16);
  return fmt::format(
      "    init: {{prm_mode: 2, cfg_mode: 1, dpv1: {}}}\n"
      "    user_cpu:\n      dpv1: {{objects: [{{slot: {}, index: {}, data: \"{}\"}}]}}\n{}",
      gsd.dpv1, order.object.slot, order.object.index, data,
      order.program.empty()
          ? ""
          : "      kind: arm\n      elf: " + absolute(order.program) + "\n      without_mailbox: leave_out\n");
}

/// Masters that stop fall silent within a telegram; of a token may be left that of another master.
constexpr const char* kAllowed =
    "\nallow:\n  - {event: BUS_CHARACTER_ERROR}\n  - {event: BUS_TELEGRAM_ERROR}\n  - {event: BUS_GLITCH}\n"
    "  - {event: BUS_TWO_MASTERS}\n";

std::string chip_of(const Order& order) {
  return fmt::format("chip: {{kind: {}{}, search_window_ms: 2}}\n", order.chip,
                     order.mode.empty() ? "" : ", mode: " + order.mode);
}

std::string name_of(const std::string& program) {
  return program.empty() ? "the native CPU" : std::filesystem::path(program).filename().string();
}

std::string head(const Order& order, const bus::Gsd& gsd, bus::Tick end) {
  const std::vector<int> masters = master_addresses(order.address);
  const std::string ring = fmt::format("highest_address: {}, target_rotation: 20000", masters.back());
  return fmt::format("name: {}\nbaud: {}\nend: {}\n", quoted("Acceptance of " + name_of(order.program)), order.baud,
                     time_text(end)) +
         chip_of(order) +
         fmt::format("\nslaves:\n  - name: {}\n    address: {}\n    gsd: {}\n    modules: {}\n", kDevice, order.address,
                     absolute(order.gsd), module_list(order.modules)) +
         words_of_device(order, gsd) +
         fmt::format(
             "\nmasters:\n  - name: {}\n    address: {}\n    start: 500us\n    bus: {{ring: true, {}}}\n"
             "    slaves: [{{slave: {}, {}}}]\n"
             "  - {{name: {}, address: {}, start: 600s, bus: {{ring: true, {}}}}}\n",
             kMaster, masters[1], ring, kDevice, words_of_master(gsd, order.seed), kProbe, masters[2], ring) +
         fmt::format(
             "\nmasters2:\n  - name: {}\n    address: {}\n    start: 600s\n    bus: {{{}}}\n"
             "    connections: [{{name: {}, slave: {}, send_timeout: 5}}, {{name: {}, slave: {}, send_timeout: {}}}]\n",
             kMaster2, masters[0], ring, kConnection, kDevice, kBrief, kDevice,
             brief_timeout(order.within) / (10 * bus::kTicksPerMs)) +
         kAllowed;
}

bus::Gsd read_gsd(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path, 0, "no such file, expected a GSD file, that of the device");
  bus::GsdResult result = bus::parse_gsd(in, path);
  if (result.gsd) return std::move(*result.gsd);
  for (const bus::GsdDiagnostic& each : result.diagnostics)
    if (each.level == bus::GsdDiagnostic::Level::kError) throw InputError(bus::to_string(each));
  throw InputError(path, 0, "is no GSD file");
}

void check_names(const std::vector<std::string>& only) {
  std::vector<std::string> names;
  for (const Stimulus& each : stimuli()) names.push_back(each.name);
  for (const std::string& name : only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError("dsdpv1-sim accept: there is no stimulus " + name + did_you_mean(name, names) + ", expected " +
                       join(names));
}

bool is_wanted(const Order& order, const Stimulus& stimulus) {
  return order.only.empty() || stimulus.apply == nullptr ||
         std::find(order.only.begin(), order.only.end(), stimulus.name) != order.only.end();
}

int lines_in(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

std::vector<Section> apply(const Order& order, const Slave& slave, Requests& requests) {
  std::vector<Section> sections;
  for (const Stimulus& stimulus : stimuli()) {
    Section section = {&stimulus, requests.now(), 0, "", lines_in(requests.script())};
    if (!is_wanted(order, stimulus)) section.left_out = kNotAskedFor;
    if (section.left_out.empty() && stimulus.left_out != nullptr) section.left_out = stimulus.left_out(slave);
    if (section.left_out.empty() && stimulus.apply != nullptr) stimulus.apply(requests);
    section.to = requests.now();
    sections.push_back(std::move(section));
  }
  return sections;
}

}  // namespace

Plan make_plan(const Order& order, const std::string& file) {
  check_names(order.only);
  const bus::Gsd gsd = read_gsd(order.gsd);
  const scenario::Scenario without_script = scenario::parse(head(order, gsd, kLongestStart), file, order.settings);
  Setup setup(without_script);
  const scenario::Master& master = without_script.masters.front();
  const Slave slave = {setup.parameters(master.slaves.front()), gsd, static_cast<std::uint8_t>(master.address),
                       static_cast<std::uint8_t>(without_script.masters.at(1).address), order.object};
  Requests requests(slave, order.seed, order.within);
  requests.act(std::string("do: operate, master: ") + kMaster);  // which it does already: the script begins
  Plan plan;
  plan.sections = apply(order, slave, requests);
  plan.end = requests.now();
  plan.address = slave.parameters.address;
  plan.mode = order.mode;
  const std::string begin = head(order, gsd, kLongestStart + plan.end) + "\nscript:\n";
  for (Section& section : plan.sections) section.line += lines_in(begin) + 1;
  plan.text = begin + requests.script();
  plan.scenario = scenario::parse(plan.text, file, order.settings);
  return plan;
}

}  // namespace dsdpv1::tb::accept
