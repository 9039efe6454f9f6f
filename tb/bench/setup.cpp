#include "tb/bench/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "bus/gsd/cfg.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb {
namespace {

constexpr int kStandardDiag = 6;     // bytes of Slave_Diag before the user's
constexpr int kGsdIntervalUs = 100;  // unit of Min_Slave_Intervall

template <class To, class From>
void override_with(To& value, const std::optional<From>& given) {
  if (given) value = static_cast<To>(*given);
}

std::vector<std::string> module_names(const bus::Gsd& gsd) {
  std::vector<std::string> names;
  for (const bus::GsdModule& module : gsd.modules) names.push_back(module.name);
  return names;
}

bus::AlarmParameters alarm_parameters(const scenario::MasterAlarms& asked) {
  const auto bit = [](bool set, int position) { return set ? 1U << position : 0U; };
  bus::AlarmParameters alarms;
  alarms.enabled =
      static_cast<std::uint8_t>(bit(asked.pull_plug, 7) | bit(asked.process, 6) | bit(asked.diagnostic, 5) |
                                bit(asked.manufacturer, 4) | bit(asked.status, 3) | bit(asked.update, 2));
  alarms.mode = asked.mode;
  alarms.extra_sap = asked.extra_sap;
  alarms.acknowledged = asked.acknowledge;
  return alarms;
}

std::uint8_t limited(int value, int most) { return static_cast<std::uint8_t>(std::clamp(value, 0, most)); }

/// The station's values from the GSD, before those of the scenario.
user_cpu::StationConfig from_gsd(const bus::Gsd& gsd, const bus::GsdSetup& setup, int prm_mode) {
  user_cpu::StationConfig station;
  station.ident = gsd.ident;
  station.address_change = gsd.set_slave_add;
  station.freeze = gsd.freeze;
  station.sync = gsd.sync;
  station.fail_safe = gsd.fail_safe;
  station.dpv1 = bus::enables_dpv1(gsd, setup.user_prm);
  station.max_input = limited(gsd.max_input.value_or(setup.lengths.input), 244);
  station.max_output = limited(gsd.max_output.value_or(setup.lengths.output), 244);
  station.max_diag = limited(gsd.max_diag.value_or(kStandardDiag) - kStandardDiag, 238);
  const int prm = static_cast<int>(setup.user_prm.size());
  station.max_prm =
      limited(prm_mode == 1 ? prm : gsd.max_user_prm.value_or(prm), 237);  // table 13: mode 1 needs exactly this number
  station.cfg = setup.chk_cfg;
  return station;
}

}  // namespace

void Setup::fail(int line, const std::string& text) const { throw InputError(scenario_.file, line, text); }

const scenario::Slave* Setup::named(const scenario::MasterSlave& slave) const {
  const auto found = std::find_if(scenario_.slaves.begin(), scenario_.slaves.end(),
                                  [&slave](const scenario::Slave& each) { return each.name.text == slave.slave.text; });
  return found == scenario_.slaves.end() ? nullptr : &*found;
}

const bus::Gsd& Setup::gsd(const scenario::Name& path) {
  const std::string file = scenario::resolve(scenario_, path);
  const auto known = files_.find(file);
  if (known != files_.end()) return known->second;
  const ReadFile read = try_read_file(file, kGsdFile.most_mb);
  if (!read.wrong.empty()) {
    // A path from the command line is absolute: relative to the user's working folder.
    const bool of_scenario = std::filesystem::path(path.text).is_relative();
    fail(path.line, fmt::format("gsd {}: {}, expected {}{}", path.text, read.wrong, kGsdFile.what,
                                of_scenario ? ", its path relative to the scenario" : ""));
  }
  std::istringstream in(read.text);
  bus::GsdResult result = bus::parse_gsd(in, file);
  if (!result.gsd) {
    const auto error =
        std::find_if(result.diagnostics.begin(), result.diagnostics.end(),
                     [](const bus::GsdDiagnostic& each) { return each.level == bus::GsdDiagnostic::Level::kError; });
    throw InputError(bus::to_string(*error));
  }
  return files_.emplace(file, std::move(*result.gsd)).first->second;
}

bus::GsdSetup Setup::choose(const scenario::Name& path, const std::vector<scenario::Name>& modules) {
  const bus::Gsd& file = gsd(path);
  bus::GsdChoice choice;
  for (const scenario::Name& module : modules) {
    std::string why;
    if (!bus::find_module(file, module.text, why))
      fail(module.line, why + did_you_mean(module.text, module_names(file)));
    choice.modules.push_back(module.text);
  }
  bus::GsdSetup setup = bus::set_up(file, choice);
  for (const bus::GsdDiagnostic& each : setup.diagnostics)
    if (each.level == bus::GsdDiagnostic::Level::kError) fail(path.line, each.text);
  return setup;
}

user_cpu::StationConfig Setup::station(const scenario::Slave& slave) {
  const scenario::InitData& init = slave.init;
  user_cpu::StationConfig station = slave.gsd.empty()
                                        ? user_cpu::StationConfig{}
                                        : from_gsd(gsd(slave.gsd), choose(slave.gsd, slave.modules), init.prm_mode);
  station.address = static_cast<std::uint8_t>(slave.address);
  station.prm_mode = static_cast<std::uint8_t>(init.prm_mode);
  station.cfg_mode = static_cast<std::uint8_t>(init.cfg_mode);
  override_with(station.ident, init.ident);
  override_with(station.max_input, init.max_inputs);
  override_with(station.max_output, init.max_outputs);
  override_with(station.max_diag, init.max_diag);
  override_with(station.max_prm, init.max_prm);
  station.max_cfg = static_cast<std::uint8_t>(init.max_cfg.value_or(slave.kind->most_cfg()));
  override_with(station.address_change, init.set_slave_address);
  override_with(station.freeze, init.freeze);
  override_with(station.sync, init.sync);
  override_with(station.fail_safe, init.fail_safe);
  override_with(station.dpv1, init.dpv1);
  override_with(station.cfg, init.cfg);
  if (station.cfg.empty())
    fail(slave.line, fmt::format("slave {} has no configuration, modules or init cfg are needed", slave.name.text));
  return station;
}

void Setup::take_gsd(bus::SlaveParameters& parameters, const scenario::Name& path,
                     const std::vector<scenario::Name>& modules) {
  const bus::Gsd& file = gsd(path);
  const bus::GsdSetup setup = choose(path, modules);
  parameters.ident = file.ident;
  parameters.user_prm = setup.user_prm;
  parameters.cfg = setup.chk_cfg;
  parameters.min_slave_interval_us = file.min_slave_interval.value_or(0) * kGsdIntervalUs;
  for (int i = 0; i < bus::kBaudCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    parameters.max_tsdr.at(index) = file.bauds.at(index).max_tsdr.value_or(0);
  }
}

void Setup::take_init(bus::SlaveParameters& parameters, const scenario::Slave& slave) {
  const user_cpu::StationConfig config = station(slave);
  parameters.ident = config.ident;
  parameters.cfg = config.cfg;
  if (config.prm_mode == 1) parameters.user_prm.assign(config.max_prm, 0);  // table 13: exactly this number
}

void Setup::take_lengths(bus::SlaveParameters& parameters, int line) const {
  const bus::CfgLengths lengths = bus::cfg_lengths(parameters.cfg);
  if (!lengths.ok()) fail(line, "cfg: " + lengths.error);
  parameters.input_length = lengths.input;
  parameters.output_length = lengths.output;
}

bus::SlaveParameters Setup::parameters(const scenario::MasterSlave& slave) {
  const scenario::Slave* there = named(slave);
  bus::SlaveParameters parameters;
  parameters.address = static_cast<std::uint8_t>(slave.address.value_or(there != nullptr ? there->address : 0));
  parameters.name = there != nullptr ? there->name.text : fmt::format("address {}", parameters.address);
  if (!slave.gsd.empty()) {
    const bool own_modules = !slave.modules.empty() || there == nullptr;
    take_gsd(parameters, slave.gsd, own_modules ? slave.modules : there->modules);
  } else if (there != nullptr && !there->gsd.empty()) {
    take_gsd(parameters, there->gsd, slave.modules.empty() ? there->modules : slave.modules);
  } else if (there != nullptr) {
    take_init(parameters, *there);
  }
  override_with(parameters.ident, slave.ident);
  override_with(parameters.user_prm, slave.user_prm);
  override_with(parameters.cfg, slave.cfg);
  take_lengths(parameters, slave.line);
  const Watchdog watchdog = watchdog_factors(slave.watchdog);
  parameters.wd_fact_1 = watchdog.fact_1;
  parameters.wd_fact_2 = watchdog.fact_2;
  parameters.wd_base_1ms = watchdog.base_1ms;
  for (const std::uint8_t group : slave.groups)
    parameters.group_ident = static_cast<std::uint8_t>(parameters.group_ident | 1U << (group - 1U));
  parameters.min_tsdr = static_cast<std::uint8_t>(slave.min_tsdr);
  parameters.sync = slave.sync;
  parameters.freeze = slave.freeze;
  parameters.fail_safe = slave.fail_safe;
  if (slave.dpv1) take_dpv1(parameters, slave, there);
  if (slave.alarms) take_alarms(parameters, slave, there);
  return parameters;
}

const scenario::Name& Setup::gsd_path(const scenario::MasterSlave& slave, const scenario::Slave* there) {
  return slave.gsd.empty() && there != nullptr ? there->gsd : slave.gsd;
}

void Setup::take_dpv1(bus::SlaveParameters& parameters, const scenario::MasterSlave& slave,
                      const scenario::Slave* there) {
  const scenario::Name& path = gsd_path(slave, there);
  if (path.empty()) {
    parameters.dpv1 = true;
    return;
  }
  if (const std::string why = bus::enable_dpv1(gsd(path), parameters); !why.empty()) fail(slave.line, "dpv1: " + why);
}

void Setup::take_alarms(bus::SlaveParameters& parameters, const scenario::MasterSlave& slave,
                        const scenario::Slave* there) {
  if (!slave.dpv1) fail(slave.alarms->line, "alarms: they need dpv1: true");
  const bus::AlarmParameters alarms = alarm_parameters(*slave.alarms);
  const scenario::Name& path = gsd_path(slave, there);
  if (path.empty()) {
    parameters.alarms = alarms;
    return;
  }
  if (const std::string why = bus::enable_alarms(gsd(path), alarms, parameters); !why.empty())
    fail(slave.alarms->line, "alarms: " + why);
}

Watchdog watchdog_factors(bus::Tick time) {
  if (time == 0) return {};
  Watchdog best;
  // The 1 ms base needs the first DPV1 byte in Set_Prm, so it is only used if 10 ms is too coarse.
  best.base_1ms = time % (10 * bus::kTicksPerMs) != 0 && time <= 65025 * bus::kTicksPerMs;
  const bus::Tick base = (best.base_1ms ? 1 : 10) * bus::kTicksPerMs;
  const std::int64_t units = std::min<std::int64_t>((time + base - 1) / base, 255 * 255);
  std::int64_t least = 255 * 255 + 1;
  for (std::int64_t first = (units + 254) / 255; first <= 255; ++first) {
    const std::int64_t second = (units + first - 1) / first;
    if (first * second >= least) continue;
    least = first * second;
    best.fact_1 = static_cast<std::uint8_t>(first);
    best.fact_2 = static_cast<std::uint8_t>(second);
  }
  return best;
}

}  // namespace dsdpv1::tb
