// The DSDPV1's keys in a scenario: parameters of the chip, and the user CPU with its bus.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/keys/serial_keys.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"

namespace dsdpv1::tb {
namespace {

using keys::ObjectOf;
using keys::Range;
using keys::WordFor;

const ObjectOf<AccessTimes>& access_keys() {
  static const ObjectOf<AccessTimes> keys = [] {
    using A = AccessTimes;
    const Range any = {-100 * bus::kTicksPerUs, 100 * bus::kTicksPerUs}, positive = {0, 100 * bus::kTicksPerUs};
    ObjectOf<A> o("access",
                  "Times at which the user CPU moves its bus pins. The chip's limits are in table 15; times beyond "
                  "them are reported as "
                  "violations. The defaults are those of an STM32F103 at 72 MHz.");
    o.time("address_setup", &A::address_setup, any, "A valid before RD or WR falls (Tc >= 0ns); negative: after it.");
    o.time("cs_lead", &A::cs_lead, positive, "CSR falls before RD or WR.");
    o.time("rd_low", &A::rd_low, {1, 100 * bus::kTicksPerUs}, "RD low.");
    o.time("rd_sample", &A::rd_sample, positive, "From the fall of RD until D is sampled (Tw >= 31.25ns).");
    o.time("wr_low", &A::wr_low, {1, 100 * bus::kTicksPerUs}, "WR low (Ts >= 12.5ns).");
    o.time("data_setup", &A::data_setup, any, "D valid before WR rises (Td >= 12.5ns); negative: after it.");
    o.time("data_hold", &A::data_hold, positive, "D driven after WR rose (Td >= 12.5ns).");
    o.time("address_hold", &A::address_hold, positive, "A valid after RD or WR rose (Td >= 12.5ns of writes).");
    o.time("cs_trail", &A::cs_trail, positive, "CSR rises after RD or WR.");
    o.time("recovery", &A::recovery, positive, "From the last edge of one access to the first of the next.");
    return o;
  }();
  return keys;
}

const ObjectOf<CpuTimes>& timing_keys() {
  static const ObjectOf<CpuTimes> keys = [] {
    using T = CpuTimes;
    const Range range = {0, bus::kTicksPerMs}, slow = {0, bus::kTicksPerSecond};
    ObjectOf<T> o("timing", "Speed of the user CPU. The defaults are those of a Cortex-M3 at 72 MHz.");
    o.time("overhead", &T::overhead, range, "Instructions between two accesses.");
    o.time("pin_sample", &T::pin_sample, range, "Reading one handshake pin.");
    o.time("pin_write", &T::pin_write, range, "Setting one handshake pin.");
    o.time("r_req_to_sample", &T::r_req_to_sample, range, "From the rise of R_REQ to the first sample of L_REQ (H2).");
    o.time("r_req_to_r_sta", &T::r_req_to_r_sta, range, "Least time from the rise of R_REQ to that of R_STA (H2).");
    o.time("interrupt_latency", &T::interrupt_latency, slow,
           "From the fall of INTR0 to the first instruction of its handler.");
    o.time("poll_interval", &T::poll_interval, slow, "Pause between two polls of the DPRAM while the driver waits.");
    return o;
  }();
  return keys;
}

}  // namespace

namespace {

using ChipKeys = ObjectOf<Dsdpv1Settings>;
using C = Dsdpv1Settings;

const std::vector<WordFor<std::uint32_t>>& fcb_rule_words() {
  static const std::vector<WordFor<std::uint32_t>> words = {
      {0, "letter", "the same SA and FCB as the request before"},
      {1, "content", "the same telegram as the request before, the ruling until an audit"}};
  return words;
}

void add_parameter(ChipKeys& o, const char* key, std::uint32_t Config::*member, Range range, const char* unit,
                   const char* text) {
  if (member == &Config::fcb_rule)
    o.word(key, member, fcb_rule_words(), "Which request with FCV = 1 is a repetition (S26).");
  else
    o.integer(key, member, range, unit, text);
}

ChipKeys plain_chip_keys() {
  ChipKeys o("chip", "The parameters of the chip that the rulings mark (p), for all slaves of the scenario.");
#define DSDPV1_PARAMETER(name, initial, least, most, unit, ruling, text) \
  add_parameter(o, #name, &C::name, {least, most}, unit, text " (" ruling ").");
#define DSDPV1_RSU_PARAMETER(...)
#define DSDPV1_RSU_LIST(...)
#include "model/dsdpv1/parameters.inc"
  return o;
}

const std::vector<WordFor<HostMode>>& mode_words() {
  static const std::vector<WordFor<HostMode>> words = {{HostMode::kParallel, "parallel", "the port of the DSDPV1"},
                                                       {HostMode::kSpi, "spi", "SPI"},
                                                       {HostMode::kUart, "uart", "UART"}};
  return words;
}

// In the order of UBR's codes (UA1), and of UIV's (UA3).
const std::vector<WordFor<int>>& rate_words() {
  static const std::vector<WordFor<int>> words = {{0, "9.6k", ""},   {1, "19.2k", ""},  {2, "38.4k", ""},
                                                  {3, "57.6k", ""},  {4, "115.2k", ""}, {5, "230.4k", ""},
                                                  {6, "460.8k", ""}, {7, "1.8432M", ""}};
  return words;
}

void add_straps(ChipKeys& o) {
  o.word("mode", &C::mode, mode_words(), "The live host port: the strap MODE (R11).");
  o.integer(
      "address", &C::address, {0, 3}, "",
      "The card's address in telegrams of SPI and UART: the strap ADR. With 0 and 3 no telegram is for it (R11).");
  o.word("uart_rate", &C::uart_rate, rate_words(), "Baud rate of the UART: the strap UBR (UA1).");
  o.integer("interval", &C::interval, {0, 7}, "",
            "Longest silence within a telegram of the UART, an index of `uart_gaps`: the strap UIV (UA3).");
}

void add_serial_parameters(ChipKeys& o) {
#define DSDPV1_PARAMETER(...)
#define DSDPV1_RSU_PARAMETER(name, initial, least, most, unit, ruling, text) \
  o.integer(#name, &C::name, {least, most}, unit, text " (" ruling ").");
#define DSDPV1_RSU_LIST(name, initial, least, most, unit, ruling, text) \
  o.integers(#name, &C::name, {least, most}, unit, text " (" ruling ").");
#include "model/dsdpv1/parameters.inc"
}

ChipKeys rsu_chip_keys() {
  ChipKeys o = plain_chip_keys();
  add_straps(o);
  add_serial_parameters(o);
  return o;
}

}  // namespace

const char* mode_name(HostMode mode) { return mode_words().at(static_cast<std::size_t>(mode)).text; }

const keys::Object& chip_keys_of(Part part) {
  static const ChipKeys plain = plain_chip_keys(), rsu = rsu_chip_keys();
  return dsdpv1::has_serial_ports(part) ? static_cast<const keys::Object&>(rsu) : plain;
}

void check_dsdpv1_chip(const Dsdpv1Settings& chip, const std::string& file) {
  if (chip.u_timer > 0 && chip.u_timer < 48)
    throw InputError(file, chip.line,
                     fmt::format("u_timer is {}, expected 0 or an integer from 48 to 4800000 cycles", chip.u_timer));
}

bool is_strap(const std::string& key) {
  static const ChipKeys straps = [] {
    ChipKeys o("chip", "");
    add_straps(o);
    return o;
  }();
  return straps.find(key) != nullptr;
}

Straps straps_of(const OwnSettings& settings) {
  const auto& chip = static_cast<const Dsdpv1Settings&>(settings);
  return {static_cast<Level>(chip.mode), static_cast<Level>(chip.address), static_cast<Level>(chip.uart_rate),
          static_cast<Level>(chip.interval)};
}

namespace {

ObjectOf<Dsdpv1User> plain_user_keys() {
  using U = Dsdpv1User;
  ObjectOf<U> o("user_cpu", "The processor that runs the user program, and its bus to the chip.");
  o.word("kind", &U::kind,
         std::vector<WordFor<CpuKind>>{
             {CpuKind::kNative, "native", "a program of the bench on a CPU whose times are `timing`"},
             {CpuKind::kArm, "arm", kArmText},
             {CpuKind::kProcess, "process",
              "`program`, compiled for this computer, in a process (docs/tutorials/c_driver_on_host.md); its accesses "
              "have the times "
              "of `timing`"}},
         "The processor.");
  add_elf_key(o);
  o.file("program", &U::program,
         "Program of kind: process, relative to the scenario's folder; on the command line relative to the current "
         "folder.");
  o.names("arguments", &U::arguments, {0, 64}, "Its arguments.");
  o.time("patience", &U::patience, {0, 86'400 * bus::kTicksPerSecond},
         "How long it may compute between two calls of its port, in the time of this computer; 0: no limit, for a "
         "debugger.");
  add_without_mailbox_key(o);
  add_processor_keys(o);
  o.object("timing", &U::timing, timing_keys(), "Its speed.");
  o.object("access", &U::access, access_keys(),
           "Times at which it moves the pins of its bus; on an ARM board instead of the FSMC.");
  o.object("fsmc", &U::fsmc, fsmc_keys(), "The same times, as registers of an FSMC.");
  o.at_most_one.push_back({"access", "fsmc"});
  return o;
}

ObjectOf<Dsdpv1User> rsu_user_keys() {
  ObjectOf<Dsdpv1User> o = plain_user_keys();
  add_serial_ports(o);
  return o;
}

}  // namespace

const keys::Object& user_keys_of(Part part) {
  static const ObjectOf<Dsdpv1User> plain = plain_user_keys(), rsu = rsu_user_keys();
  return dsdpv1::has_serial_ports(part) ? rsu : plain;
}

dsdpv1::Config config_of(const ChipRequest& request) {
  dsdpv1::Config config = static_cast<const dsdpv1::Config&>(static_cast<const Dsdpv1Settings&>(request.settings));
  config.engine = request.engine == Engine::kStep || request.inside ? dsdpv1::Engine::kStep : dsdpv1::Engine::kSkip;
  return config;
}

// --- what does not fit together -------------------------------------------------------------------------------------

namespace {

/// L_REQ, L_STA, R_REQ, R_STA; RESET; INTR0, PBF, BR, READY.
constexpr WiredPins kWired = {0, 0, 0x03C0, 0, 0x0010, 0, 0x7040};

}  // namespace

void check_dsdpv1_user(const Dsdpv1User& user, const std::string& file, const std::string& slave, int line) {
  const bool arm = user.kind == CpuKind::kArm, process = user.kind == CpuKind::kProcess;
  if (process && user.program.empty())
    throw InputError(file, line, fmt::format("program is missing, slave {} has a process that runs it", slave));
  if (!process && !user.program.empty())
    throw InputError(file, user.program.line,
                     "program without kind: process, expected both (--set user_cpu.kind=process)");
  if (process && user.without_mailbox != WithoutMailbox::kRefuse)
    throw InputError(file, line, "without_mailbox is that of kind: arm, a process is never told anything");
  if (!process && !user.arguments.empty())
    throw InputError(file, user.arguments.front().line,
                     "arguments without kind: process, expected those of its program");
  check_board_keys(user, arm, kWired, file, slave, line);
  if (arm && user.timing)
    throw InputError(file, user.timing->line, "timing is that of kind: native, an ARM board has cpi, fsmc and access");
}

}  // namespace dsdpv1::tb
