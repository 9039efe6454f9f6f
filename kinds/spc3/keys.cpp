// The keys of the SPC3 family in a scenario, and what a scenario with these chips must not ask for.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "kinds/spc3/settings.hpp"

namespace dsdpv1::tb {
namespace {

using keys::ObjectOf;
using keys::Range;
using spc3::Variant;
using Words = std::vector<keys::WordFor<std::uint32_t>>;
using ChipKeys = ObjectOf<Spc3Settings>;

/// A parameter with words; all others are integers.
struct WordKey {
  const char* text;
  Words words;
};

const WordKey* word_key(std::string_view parameter) {
  static const std::map<std::string_view, WordKey> all = {
      {"fcb_rule",
       {"Which request with FCV = 1 is a repetition (S26).",
        {{0, "letter", "the same SA and FCB as the request before"},
         {1, "content", "the same telegram as the request before"}}}},
      {"violation",
       {"An access beyond the RAM (A3).",
        {{0, "offline", "the chip goes OFFLINE"}, {1, "status_only", "it only sets the status bit"}}}},
      {"address_cells",
       {"Time at which the cells 16 and 39 hold (A5).", {{0, "start", "at START"}, {1, "live", "always"}}}},
      {"prm7", {"The judge of a Set_Prm of seven bytes (A20).", {{0, "chip", ""}, {1, "user", ""}}}},
      {"prm_reserved",
       {"Reserved bits of a Set_Prm (A21).",
        {{0, "fault", "Prm_Fault, unless mode register 2 allows them"}, {1, "ignore", "not checked"}}}},
      {"prm_taken",
       {"Begin of the effect of a Set_Prm (A49).",
        {{0, "receipt", "when it is received"}, {1, "verdict", "with the user's ok (S15)"}}}},
      {"ssa_cells",
       {"The cells 16 and 39 after a Set_Slave_Address (A23).",
        {{0, "keep", "unchanged"}, {1, "write", "written by the chip"}}}},
      {"data_ex", {"Begin of DATA_EX (A24).", {{1, "new_din", "with the first inputs"}, {2, "cfg_ok", "with Cfg ok"}}}},
      {"fresh_56", {"A repeated read of the inputs is composed again (A28).", {{0, "no", ""}, {1, "yes", ""}}}},
      {"baud_control",
       {"Time of BAUD_CONTROL (A31).", {{0, "square", "value x value x 10 ms"}, {1, "linear", "value x 10 ms"}}}},
      {"tsdr_at_search",
       {"min_TSDR at each begin of the search (A33).",
        {{0, "default", "the default again"}, {1, "keep", "unchanged"}}}},
      {"diag_bytes",
       {"The six standard bytes of a diagnosis (A39).",
        {{0, "ram", "written into its buffer"}, {1, "answer", "only sent"}}}},
      {"clock",
       {"The clock in MHz; with 24 event_delay, int_delay, ready, ready_release and strobe double (A44).",
        {{24, "24", ""}, {48, "48", ""}}}},
      {"ready_rule",
       {"An access that ends before it is ready (A42).",
        {{0, "report", "reported and served"}, {1, "strict", "a read is X, a write is lost"}}}},
      {"empty_data",
       {"Empty data with Spec_Clear_Mode (A46).",
        {{0, "clear", "Clear"}, {1, "by_prm", "Clear only with byte 7 bit 6 of Set_Prm"}}}},
      {"diag_flag_by", {"The master whose read ends Diag_Flag (A51).", {{0, "holder", ""}, {1, "any", ""}}}},
      {"spi_fetch",
       {"The time at which a byte of a read by SPI acts (A60).",
        {{0, "clocked", "with the first bit of it that the user clocks"},
         {1, "ahead", "with the last bit before it"}}}},
      {"type", {"The type in the status register (A1).", {{11, "B", ""}, {12, "C", ""}, {14, "E", ""}}}}};
  const auto found = all.find(parameter);
  return found == all.end() ? nullptr : &found->second;
}

/// Some parameters are those of one chip only.
bool has_parameter(Variant variant, std::string_view name) {
  if (name == "clock") return variant == Variant::kSpc3;
  if (name == "type" || name == "prm_reserved" || name == "spi_mode" || name == "spi_fetch")
    return variant == Variant::kVpc3;
  return true;
}

void add_parameter(  // NOLINT(readability-function-size): as the macro has it
    ChipKeys& o, Variant variant, const char* key, std::uint32_t spc3::Config::*member, Range range, const char* unit,
    const char* text) {
  if (!has_parameter(variant, key)) return;
  const WordKey* words = word_key(key);
  if (words == nullptr) {
    o.integer(key, member, range, unit, text);
    return;
  }
  keys::Field& field = o.word(key, member, words->words, words->text);
  if (field.default_text.empty()) field.default_text = row(variant).exchanges_at_cfg_ok ? "cfg_ok" : "new_din";  // A24
}

ChipKeys chip_keys_of(Variant variant) {
  using spc3::Bus;
  ChipKeys o("chip", "The parameters of the chip that its rulings mark (p) (docs/spc3.md), for all slaves.");
  std::vector<keys::WordFor<Bus>> buses = {{Bus::kIntelAsync, "intel_async", "XCS, XRD, XWR; XREADY"},
                                           {Bus::kIntelSync, "intel_sync", "80C32: ALE, XRD, XWR"},
                                           {Bus::kMotorolaAsync, "motorola_async", "XCS, AS, R_W; XDTACK"},
                                           {Bus::kMotorolaSync, "motorola_sync", "68HC11: XCS, E_CLOCK, R_W"}};
  if (variant == Variant::kVpc3)
    buses.push_back({Bus::kSpi, "spi", "XSS, SCK, MOSI, MISO of the VPC3+S, by the strap SERIAL (A59)"});
  o.word("bus", &Spc3Settings::bus, buses, "The bus of the user CPU: the straps XINT/MOT and MODE (table 6.1).");
#define SPC3_PARAMETER(name, initial, least, most, unit, ruling, text) \
  add_parameter(o, variant, #name, &spc3::Config::name, {least, most}, unit, text " (" ruling ").");
#include "model/spc3/parameters.inc"
  return o;
}

}  // namespace

const keys::Object& spc3_chip_keys(Variant variant) {
  static const std::array<ChipKeys, spc3::kVariants.size()> all = {
      chip_keys_of(Variant::kApc3), chip_keys_of(Variant::kSpc3), chip_keys_of(Variant::kVpc3)};
  return all.at(static_cast<std::size_t>(variant));
}

namespace {

const ObjectOf<Spc3Access>& access_keys() {
  static const ObjectOf<Spc3Access> keys = [] {
    using A = Spc3Access;
    const Range time = {0, 100 * bus::kTicksPerUs}, low = {1, 100 * bus::kTicksPerUs};
    ObjectOf<A> o(
        "access",
        "Times at which the user CPU moves its bus pins; the strobe is XRD, XWR, AS or E_CLOCK. No document at hand "
        "has the chip's limits (A42). The defaults are those of an STM32F103 at 72 MHz.");
    o.time("address_setup", &A::address_setup, time, "AB, R_W and ALE before the strobe.");
    o.time("cs_lead", &A::cs_lead, time, "XCS before the strobe.");
    o.time("rd_low", &A::rd_low, low, "The strobe of a read.");
    o.time("rd_sample", &A::rd_sample, time, "From the begin of the strobe until DB is sampled.");
    o.time("wr_low", &A::wr_low, low, "The strobe of a write.");
    o.time("data_setup", &A::data_setup, time, "DB before the end of the strobe.");
    o.time("data_hold", &A::data_hold, time, "DB after the strobe.");
    o.time("address_hold", &A::address_hold, time, "AB and R_W after the strobe.");
    o.time("cs_trail", &A::cs_trail, time, "XCS after the strobe.");
    o.time("recovery", &A::recovery, time, "From the last edge of one access to the first of the next.");
    return o;
  }();
  return keys;
}

const ObjectOf<Spc3Spi>& spi_keys() {
  static const ObjectOf<Spc3Spi> keys = [] {
    ObjectOf<Spc3Spi> o("spi",
                        "The native user CPU's SPI controller, with bus: spi of the chip, whose spi_mode it has. No "
                        "document at hand has "
                        "the chip's limits (A59).");
    add_spi_times(o);
    return o;
  }();
  return keys;
}

}  // namespace

namespace {

ObjectOf<Spc3User> user_keys_of(Variant variant) {
  using spc3_user::Mode;
  using U = Spc3User;
  const Range short_time = {0, bus::kTicksPerMs};
  ObjectOf<U> o("user_cpu", "The processor that runs the user program, and its bus to the chip.");
  o.word("kind", &U::kind,
         std::vector<keys::WordFor<Spc3Cpu>>{
             {Spc3Cpu::kNative, "native", "a program of the bench on a CPU whose times are `access` and `overhead`"},
             {Spc3Cpu::kArm, "arm", kArmText}},
         "The processor.");
  add_elf_key(o);
  add_without_mailbox_key(o);
  add_processor_keys(o);
  o.object("fsmc", &U::fsmc, fsmc_keys(), "The times of the ARM board's bus, as registers of its FSMC.");
  o.word("mode", &U::mode,
         std::vector<keys::WordFor<Mode>>{{Mode::kInterrupt, "interrupt", "X/INT calls a handler, which judges"},
                                          {Mode::kPolled, "polled", "the main loop reads the requests in each cycle"}},
         "How the program gets the chip's events.");
  o.object("access", &U::access, access_keys(), "Its accesses.");
  if (variant == Variant::kVpc3) o.object("spi", &U::spi, spi_keys(), "Its end of SPI, with bus: spi of the chip.");
  o.boolean("wait", &U::wait,
            "XREADY is connected: the CPU looks at it each 13.9 ns and samples a read 55.6 ns, ends a write 41.7 ns "
            "after its fall. Not with the synchronous buses.");
  o.time("overhead", &U::overhead, short_time, "Instructions between two accesses.");
  o.time("interrupt_latency", &U::interrupt_latency, short_time, "From X/INT to the first instruction of its handler.");
  o.integer("wd_baud_control", &U::wd_baud_control, {1, 255}, "",
            "WD_BAUD_CONTROL_Val, cell 0A: a baud rate without telegrams ends after value x value x 10 ms (A31).");
  o.integer("user_wd", &U::user_watchdog, {1, 0xFFFF}, "data telegrams",
            "User watchdog, cells 18 and 19: the program serves it in each cycle (A34).");
  return o;
}

}  // namespace

const keys::Object& spc3_user_keys(Variant variant) {
  static const std::array<ObjectOf<Spc3User>, spc3::kVariants.size()> all = {
      user_keys_of(Variant::kApc3), user_keys_of(Variant::kSpc3), user_keys_of(Variant::kVpc3)};
  return all.at(static_cast<std::size_t>(variant));
}

spc3::Config spc3_config_of(const ChipRequest& request) {
  spc3::Config config = static_cast<const spc3::Config&>(static_cast<const Spc3Settings&>(request.settings));
  config.engine = request.engine == Engine::kStep || request.inside ? spc3::Engine::kStep : spc3::Engine::kSkip;
  return config;
}

namespace {

using user_cpu::command::OfChip;

std::string said_go_offline(const OfChip&) { return "Go_Offline"; }
std::string said_leave_master(const OfChip&) { return "User_Leave_Master"; }
std::string said_write(const OfChip& order) { return "writes " + bytes_text(order.bytes); }
std::string said_read(const OfChip& order) { return "reads " + bytes_text(order.bytes); }

}  // namespace

const std::vector<Order>& spc3_orders() {
  static const std::vector<Order> orders = {
      {{spc3_user::kGoOffline,
        "The user CPU writes Go_Offline (A55). The program begins again when MAC_Reset comes.",
        {"slave"},
        {}},
       said_go_offline},
      {{spc3_user::kLeaveMaster, "The user CPU writes User_Leave_Master.", {"slave"}, {}}, said_leave_master},
      {{spc3_user::kWriteChip,
        "The user CPU writes to the chip: `bytes` are the address, high byte first, and the values from there on.",
        {"slave", "bytes"},
        {}},
       said_write},
      {{spc3_user::kReadChip,
        "The user CPU reads a byte of the chip: `bytes` are its address, high byte first. Some reads are commands.",
        {"slave", "bytes"},
        {}},
       said_read}};
  return orders;
}

// --- what these chips do not have ------------------------------------------------------------------------------------

namespace {

/// Where, and of which chip.
struct At {
  const std::string& file;
  const char* chip;
};

[[noreturn]] void refuse(const At& at, int line, const std::string& what, const char* instead) {
  throw InputError(at.file, line, fmt::format("{}, but a {} {}", what, at.chip, instead));
}

bool is_one_of(const std::string& key, std::initializer_list<const char*> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// RESET PE4; X/INT PG6, XDATAEXCH PG12; SPI PA4 to PA7.
constexpr WiredPins kWired = {0, 0, 0, 0, 0x0010, 0, 0x1040}, kWiredSpi = {0x00F0, 0, 0, 0, 0x0010, 0, 0x1040};

/// Keys that only an ARM board has, or only the other CPU.
void check_cpu(const At& at, const scenario::Slave& slave) {
  const bool arm = spc3_user_of(slave.user_cpu).kind == Spc3Cpu::kArm;
  for (const keys::Given& key : slave.user_cpu.given) {
    if (arm && is_one_of(key.key, {"access", "wait", "overhead", "interrupt_latency"}))
      throw InputError(at.file, key.line,
                       fmt::format("{} is that of kind: native, an ARM board has cpi and fsmc", key.key));
    const bool spi = static_cast<const Spc3Settings&>(*slave.chip).bus == spc3::Bus::kSpi;
    if (key.key == "spi" && (arm || !spi))
      throw InputError(at.file, key.line, "spi without bus: spi of the chip and kind: native, expected both");
    if (spi && is_one_of(key.key, {"access", "wait"}))
      throw InputError(at.file, key.line, fmt::format("{} with bus: spi of the chip, expected spi", key.key));
    if (!arm && is_one_of(key.key, {"cpi", "fsmc", "without_mailbox"}))
      throw InputError(at.file, key.line, fmt::format("{} without kind: arm, expected access", key.key));
  }
  const spc3::Bus bus = static_cast<const Spc3Settings&>(*slave.chip).bus;
  if (arm && bus != spc3::Bus::kIntelAsync && bus != spc3::Bus::kSpi)
    throw InputError(
        at.file, slave.user_cpu.line,
        fmt::format("kind is arm and bus of the chip neither intel_async nor spi, expected both at slave {}",
                    slave.name.text));
  for (const keys::Given& key : slave.user_cpu.given)
    if (key.key == "fsmc" && bus == spc3::Bus::kSpi)
      throw InputError(at.file, key.line, "fsmc with bus: spi of the chip, expected none: the firmware sets its SPI");
}

void check_settings(const At& at, const scenario::Slave& slave) {
  constexpr const char* kNoDpv1 = "has no DPV1, expected none of it";
  if (slave.init.prm_mode > 2 || slave.init.cfg_mode > 2)
    throw InputError(at.file, slave.init.line, "prm_mode or cfg_mode is above 2, expected 0, 1 or 2");
  if (slave.init.dpv1.value_or(false)) refuse(at, slave.init.line, "dpv1 is true", kNoDpv1);
  for (const keys::Given& key : slave.user_cpu.given) {
    if (key.key == "dpv1") refuse(at, key.line, "user_cpu has dpv1", kNoDpv1);
    if (key.key == "overwrite_inputs" && !slave.user_cpu.overwrite_inputs)
      refuse(at, key.line, "overwrite_inputs is false", "does not tell whether inputs were taken, expected true");
  }
}

/// The order's address and bytes are in the map.
void check_place(const At& at, const scenario::Action& action, int highest) {
  const int first = action.bytes[0] << 8 | action.bytes[1];
  const int last = first + std::max(0, static_cast<int>(action.bytes.size()) - 3);
  if (last > highest)
    throw InputError(at.file, action.line,
                     fmt::format("bytes reach address {:X}, expected 0 to {:X} of a {}", last, highest, at.chip));
}

void check_action(const At& at, const scenario::Action& action, int highest) {
  using scenario::ActionKind;
  const std::size_t least = action.word == spc3_user::kWriteChip ? 3 : action.word == spc3_user::kReadChip ? 2 : 0;
  if (action.bytes.size() < least)
    throw InputError(at.file, action.line,
                     fmt::format("bytes has {} bytes, expected two of the address{}", action.bytes.size(),
                                 least == 3 ? " and one or more values" : ""));
  if (least != 0) check_place(at, action, highest);
  if (action.what == ActionKind::kWrongLength)
    refuse(at, action.line, action.word, "has one length of inputs, expected other actions");
  if (action.what == ActionKind::kAnswerAcyclic)
    refuse(at, action.line, action.word, "has no DPV1, expected other actions");
}

}  // namespace

void check_spc3_user(const Spc3User& user, const Spc3Settings& chip, const std::string& file, const std::string& slave,
                     int line) {
  check_board_keys(user, user.kind == Spc3Cpu::kArm, chip.bus == spc3::Bus::kSpi ? kWiredSpi : kWired, file, slave,
                   line);
}

void check_spc3_slave(const scenario::Scenario& scenario, const scenario::Slave& slave) {
  const At at{scenario.file, slave.kind->name()};
  check_mosi(spc3_user_of(slave.user_cpu).spi, scenario.file);
  check_settings(at, slave);
  check_cpu(at, slave);
  const int highest = std::string_view(at.chip) == "vpc3" ? 0xFFF : 0x7FF;
  for (const scenario::Action& action : scenario.script)
    if (action.slave.text == slave.name.text) check_action(at, action, highest);
}

}  // namespace dsdpv1::tb
