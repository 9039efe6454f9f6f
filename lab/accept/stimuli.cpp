#include "lab/accept/stimuli.hpp"

#include <algorithm>

#include "bus/gsd/setup.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1::tb::accept {
namespace {

using Need = Met::Need;
using Ports = Met::Ports;

constexpr bus::Tick kMs = bus::kTicksPerMs;
constexpr int kOffers = 4;  ///< of a configuration, each to be refused

const Met kReturns = {"in data exchange again", {"in data exchange"}, Need::kAlways};

const Met kRefused = {"Cfg_Fault", {"CFG_USER", "CFG_DIFFERS", "CFG_LENGTH", "CFG_IO_LENGTH"}, Need::kAlways, kOffers};

// --- telegrams -------------------------------------------------------------------------------------------------------

/// As its master sends it.
bus::Bytes right_prm(const Requests& requests) { return bus::set_prm_data(requests.slave().parameters, 0); }

void set_prm(Requests& requests, const bus::Bytes& data) {
  requests.telegram(bus::sap::kSetPrm, bus::sap::kMaster, data);
}
void chk_cfg(Requests& requests, const bus::Bytes& cfg) {
  requests.telegram(bus::sap::kChkCfg, bus::sap::kMaster, cfg);
}

bool is_of_the_gsd(const Slave& slave, const bus::Bytes& identifier) {
  const auto& modules = slave.gsd.modules;
  return std::any_of(modules.begin(), modules.end(),
                     [&identifier](const bus::GsdModule& module) { return module.cfg == identifier; });
}

/// The slave's configuration with another first identifier, which no module of the GSD has: of the same lengths, where
/// that is possible, so that the chip cannot know. Empty: there is none.
bus::Bytes wrong_cfg(const Slave& slave) {
  constexpr std::uint8_t kConsistent = 0x80, kWords = 0x40, kOneMore = 0x01;
  const bus::Bytes& right = slave.parameters.cfg;
  const bool compact = (right[0] & 0x30U) != 0;
  const std::size_t place = compact || right.size() == 1 ? 0 : 1;
  const bus::CfgLengths identifiers = bus::cfg_lengths(right);
  const auto end = static_cast<std::ptrdiff_t>(identifiers.identifiers.front().size);
  for (const std::uint8_t change : {kConsistent, kOneMore, kWords}) {
    bus::Bytes cfg = right;
    cfg[place] = static_cast<std::uint8_t>(cfg[place] ^ change);
    if (!is_of_the_gsd(slave, {cfg.begin(), cfg.begin() + end})) return cfg;
  }
  return {};
}

// --- the stimuli -----------------------------------------------------------------------------------------------------

void outputs(Requests& requests) { requests.wait(40 * kMs); }

void restart(Requests& requests) {
  for (const bus::Tick pause : {4 * kMs, requests.chance(20 * kMs)}) {
    requests.act("do: stop_master");
    requests.wait(pause + kMs);
    requests.act("do: start_master");
    requests.wait(requests.returned());
  }
}

void watchdog(Requests& requests) {
  const bus::SlaveParameters& parameters = requests.slave().parameters;
  const bus::Tick time = (parameters.wd_base_1ms ? kMs : 10 * kMs) * parameters.wd_fact_1 * parameters.wd_fact_2;
  requests.act("do: stop_master");
  requests.wait(time + kMs + requests.served());
  requests.act("do: start_master");
  requests.wait(requests.returned());
}

void clear(Requests& requests) {
  requests.act("do: clear");
  requests.wait(2 * requests.served());
  requests.act("do: operate");
  requests.wait(requests.served());
}

void sync_and_freeze(Requests& requests) {
  for (const char* command : {"sync", "sync", "freeze", "freeze", "unsync", "unfreeze"}) {
    requests.act(std::string("do: global_control, ") + command + ": true");
    requests.wait(requests.served() / 2);
  }
  requests.wait(requests.served());
}

void wrong_ident(Requests& requests) {
  requests.stop_cycle();
  bus::SlaveParameters wrong = requests.slave().parameters;
  wrong.ident = static_cast<std::uint16_t>(wrong.ident ^ 1U);
  set_prm(requests, bus::set_prm_data(wrong, 0));
  requests.start_cycle();
}

/// A watchdog of factor 0.
void wrong_parameters(Requests& requests) {
  constexpr std::uint8_t kWatchdogOn = 0x08;
  requests.stop_cycle();
  bus::Bytes data = right_prm(requests);
  data[0] = static_cast<std::uint8_t>(data[0] | kWatchdogOn);
  data[1] = 0;
  set_prm(requests, data);
  requests.start_cycle();
}

std::size_t too_long(const Slave& slave) {
  return 7U + static_cast<std::size_t>(slave.gsd.max_user_prm.value_or(237)) + 1U;
}

void long_parameters(Requests& requests) {
  requests.stop_cycle();
  bus::Bytes data = right_prm(requests);
  data.resize(too_long(requests.slave()));
  set_prm(requests, data);
  requests.start_cycle();
}

void same_parameters(Requests& requests) {
  set_prm(requests, right_prm(requests));
  requests.wait(requests.returned());
}

/// In data exchange the chip itself refuses every other configuration (S16), before it the user may have to.
void wrong_configuration(Requests& requests) {
  requests.stop_cycle();
  for (int i = 0; i < kOffers; ++i) {
    set_prm(requests, right_prm(requests));
    requests.wait(requests.served());
    chk_cfg(requests, wrong_cfg(requests.slave()));
    requests.wait(requests.served() + requests.chance(kMs));
  }
  requests.start_cycle();
}

void same_configuration(Requests& requests) {
  for (int i = 0; i < 3; ++i) {
    chk_cfg(requests, requests.slave().parameters.cfg);
    requests.wait(requests.served() + requests.chance(kMs));
  }
}

/// The newer block counts: a verdict on the older one must not be given for it. Set_Prm twice, then a right Chk_Cfg and
/// a wrong one.
void newer_block(Requests& requests) {
  requests.stop_cycle();
  for (int i = 0; i < kOffers; ++i) {
    set_prm(requests, right_prm(requests));
    set_prm(requests, right_prm(requests));
    requests.wait(requests.served() + requests.chance(kMs));
    chk_cfg(requests, requests.slave().parameters.cfg);
    chk_cfg(requests, wrong_cfg(requests.slave()));
    requests.wait(requests.served());
  }
  requests.start_cycle();
}

/// A Chk_Cfg that changes nothing, at any time in the program's turn. Chk_Cfg and Set_Prm together: if the user holds
/// the memory for so long that both wait, the interrupt falls again 128 cycles later (P7), perhaps in the next hold.
void interrupts(Requests& requests) {
  for (int i = 0; i < 60; ++i) {
    chk_cfg(requests, requests.slave().parameters.cfg);
    requests.wait(requests.served() / 2 + requests.chance(kMs));
  }
  for (int i = 0; i < 8; ++i) {
    requests.wait(requests.returned() / 4 + requests.chance(kMs));
    chk_cfg(requests, requests.slave().parameters.cfg);
    set_prm(requests, right_prm(requests));
  }
  requests.wait(requests.returned());
}

std::string object_of(const Object& object) {
  return "slot: " + std::to_string(object.slot) + ", index: " + std::to_string(object.index);
}

void read_c1(Requests& requests, const Object& what) {
  requests.act(std::string("do: c1_read, slave: ") + kDevice + ", " + object_of(what) +
               ", length: " + std::to_string(what.length));
  requests.wait(requests.served() + requests.chance(kMs));
}

void c1(Requests& requests) {
  const Object& object = requests.slave().object;
  const Object nowhere = {253, 253, 4};
  for (const Object& each : {object, nowhere, Object{object.slot, object.index, 1}, Object{object.slot, 253, 4}})
    read_c1(requests, each);
  requests.act(std::string("do: c1_write, slave: ") + kDevice + ", " + object_of(nowhere) + ", bytes: \"5A\"");
  requests.wait(requests.served() + requests.chance(kMs));
  read_c1(requests, object);
}

/// Set_Prm directly after the request, which is with the user then; asked again after the return.
void c1_dropped(Requests& requests) {
  const Object& object = requests.slave().object;
  constexpr std::uint8_t kRead = 0x5E;
  for (int i = 0; i < 3; ++i) {
    requests.telegram(bus::sap::kMs1, bus::sap::kMs1,
                      {kRead, static_cast<std::uint8_t>(object.slot), static_cast<std::uint8_t>(object.index),
                       static_cast<std::uint8_t>(object.length)});
    set_prm(requests, right_prm(requests));
    requests.wait(requests.returned() + requests.chance(kMs));
    read_c1(requests, object);
  }
}

/// The silent connection's F, U and half of its I timer, which end it one after the other.
void c2(Requests& requests) {
  const Object& object = requests.slave().object;
  const auto act = [&](const std::string& what) {
    requests.act(what);
    requests.wait(requests.served() + requests.chance(kMs));
  };
  const auto read = [&](const std::string& where, int length) {
    act(std::string("do: c2_read, connection: ") + kConnection + ", " + where + ", length: " + std::to_string(length));
  };
  const std::string connection = std::string(", connection: ") + kConnection;
  const std::string brief = std::string(", connection: ") + kBrief;
  act(std::string("do: start_master, master: ") + kMaster2);
  requests.wait(requests.returned());
  act("do: c2_connect" + connection);
  read(object_of(object), object.length);
  read(object_of({253, 253, 0}), 4);
  act("do: c2_write" + connection + ", slot: 253, index: 253, bytes: \"5A\"");
  act("do: c2_transport" + connection + ", slot: 253, index: 253, bytes: \"5A\"");
  read(object_of(object), object.length);
  act("do: c2_abort" + connection);
  act("do: c2_connect" + connection);
  read(object_of(object), object.length);
  act("do: c2_abort" + connection);
  act("do: c2_connect" + brief);
  act("do: c2_behaviour" + brief + ", behaviour: silent");
  requests.wait(4 * brief_timeout(requests.served()));
  act(std::string("do: stop_master, master: ") + kMaster2);
  requests.wait(requests.returned());
}

void spoil_reads(Requests& requests) { requests.act(std::string("do: spoil_reads, slave: ") + kDevice); }

void spoilt_blocks(Requests& requests) {
  requests.stop_cycle();
  for (int i = 0; i < kOffers; ++i) {
    spoil_reads(requests);
    set_prm(requests, right_prm(requests));
    requests.wait(requests.served() + requests.chance(kMs));
    spoil_reads(requests);
    chk_cfg(requests, requests.slave().parameters.cfg);
    requests.wait(requests.served() + requests.chance(kMs));
  }
  requests.start_cycle();
}

void spoilt_requests(Requests& requests) {
  for (int i = 0; i < kOffers; ++i) {
    spoil_reads(requests);
    read_c1(requests, requests.slave().object);
  }
  requests.wait(requests.returned());
}

void power(Requests& requests) {
  requests.act(std::string("do: reset_chip, slave: ") + kDevice + ", for: 100us");
  requests.wait(requests.returned());
}

// --- what a slave may do without -------------------------------------------------------------------------------------

std::string without_watchdog(const Slave& slave) {
  return slave.parameters.wd_fact_1 == 0 ? "the master has no watchdog" : "";
}
std::string without_sync(const Slave& slave) {
  return slave.gsd.sync && slave.gsd.freeze ? "" : "the GSD has no Sync_Mode_supp and Freeze_Mode_supp";
}
std::string without_long_prm(const Slave& slave) {
  return too_long(slave) <= bus::kMaxData ? "" : "the GSD allows 237 bytes, as many as fit";
}
std::string without_wrong_cfg(const Slave& slave) {
  return wrong_cfg(slave).empty() ? "the GSD has a module for each identifier tried" : "";
}
std::string without_c1(const Slave& slave) {
  return slave.parameters.dpv1 && slave.gsd.c1_read_write ? "" : "the GSD has no DPV1_Slave and C1_Read_Write_supp";
}
std::string without_c2(const Slave& slave) {
  return slave.gsd.c2_read_write ? "" : "the GSD has no C2_Read_Write_supp";
}

}  // namespace

const std::vector<Stimulus>& stimuli() {
  static const std::vector<Stimulus> list = {
      {"start",
       "initialised once, parameters and configuration judged (D7, S7)",
       {{"initialised", {"INITIALISED"}, Need::kAlways}, {"in data exchange", {"in data exchange"}, Need::kAlways}}},
      {"outputs",
       "each data exchange has other outputs (S4)",
       {{"new outputs", {"new outputs"}, Need::kAlways}},
       outputs},
      {"restart", "the master stops and starts (S15)", {kReturns}, restart},
      {"watchdog",
       "the master is silent until the watchdog expires (S22)",
       {{"watchdog expired", {"WD_EXPIRED"}, Need::kAlways}, kReturns},
       watchdog,
       without_watchdog},
      {"clear", "Clear and back to Operate (S18, S24)", {{"Global_Control", {"GLOBAL_CONTROL"}, Need::kAlways}}, clear},
      {"sync and freeze",
       "Global_Control as the GSD allows it (S24)",
       {{"Global_Control", {"GLOBAL_CONTROL"}, Need::kAlways},
        {"refused, though the GSD has it", {"GC_SYNC", "GC_FREEZE"}, Need::kNever}},
       sync_and_freeze,
       without_sync},
      {"wrong ident",
       "Set_Prm for another device (S8)",
       {{"Prm_Fault", {"PRM_IDENT"}, Need::kAlways}, kReturns},
       wrong_ident},
      {"wrong parameters",
       "a watchdog of 0 (S8)",
       {{"Prm_Fault", {"PRM_WD"}, Need::kAlways}, kReturns},
       wrong_parameters},
      {"long parameters",
       "one byte more than the GSD allows (D8)",
       {{"Prm_Fault", {"PRM_USER", "PRM_USER_LENGTH"}, Need::kCounted}, kReturns},
       long_parameters,
       without_long_prm},
      {"same parameters",
       "Set_Prm in data exchange (S15)",
       {{"Set_Prm taken", {"PRM_OK"}, Need::kAlways}, kReturns},
       same_parameters},
      {"wrong configuration",
       "an identifier that no module of the GSD has must be refused (S15)",
       {kRefused, kReturns},
       wrong_configuration,
       without_wrong_cfg},
      {"same configuration",
       "Chk_Cfg in data exchange (S16)",
       {{"given to the user", {"interrupt"}, Need::kAlways, 3}},
       same_configuration},
      {"newer block",
       "Set_Prm and Chk_Cfg again before the verdict: the newer one counts (H7)",
       {{"newer ones before the verdict", {"newer block"}, Need::kCounted},
        {"verdicts too late", {"VERDICT_SUPERSEDED"}, Need::kCounted},
        kRefused,
        kReturns},
       newer_block,
       without_wrong_cfg},
      {"C1",
       "reads and writes, right and wrong (V1, V6)",
       {{"requests to the user", {"C1_REQUEST"}, Need::kAlways},
        {"answered with data", {"C1 data"}, Need::kCounted},
        {"answered with an error", {"C1 error"}, Need::kAlways}},
       c1,
       without_c1},
      {"C1 dropped",
       "data exchange left with a request open (V6)",
       {{"requests dropped", {"C1_DROPPED"}, Need::kCounted}, kReturns},
       c1_dropped,
       without_c1},
      {"C2",
       "connect, read, write, transport, abort, silence (V2, V4)",
       {{"connected", {"C2_CONNECTED"}, Need::kAlways},
        {"answered with data", {"C2 data"}, Need::kCounted},
        {"answered with an error", {"C2 error"}, Need::kAlways},
        {"timed out", {"C2_TIMEOUT"}, Need::kCounted}},
       c2,
       without_c2},
      {"spoilt blocks",
       "a wrong bit in what the user reads, which a CRC shows: it reads again (4.2, table 7, R15)",
       {{"wrong bits read", {"spoilt"}, Need::kCounted},
        {"right parameters or configuration refused",
         {"PRM_USER", "CFG_USER", "CFG_DIFFERS", "CFG_LENGTH", "CFG_IO_LENGTH"},
         Need::kNever},
        kReturns},
       spoilt_blocks},
      {"spoilt requests",
       "the same with C1 requests",
       {{"wrong bits read", {"spoilt"}, Need::kCounted}, {"answers", {"C1 data", "C1 error"}, Need::kAlways, kOffers}},
       spoilt_requests,
       without_c1},
      {"interrupts",
       "the chip interrupts at any time of the program's turn, of the seed (P7, H2)",
       {{"interrupts", {"interrupt"}, Need::kAlways},
        {"while the user waits for the memory", {"interrupt waiting"}, Need::kCounted, 1, Ports::kParallel},
        {"the user asks for the memory meanwhile", {"request in interrupt"}, Need::kCounted, 1, Ports::kParallel},
        {"inside a hold", {"interrupt inside"}, Need::kCounted, 1, Ports::kOwned},
        {"within 2 us after a hold", {"interrupt released"}, Need::kCounted, 1, Ports::kOwned}},
       interrupts},
      {"power",
       "RESET and the user CPU from the beginning (H6)",
       {{"initialised", {"INITIALISED"}, Need::kAlways}, kReturns},
       power},
  };
  return list;
}

}  // namespace dsdpv1::tb::accept
