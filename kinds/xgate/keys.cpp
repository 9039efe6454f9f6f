// The keys of an XGate-DPS10 and its host in a scenario.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "driver/xgate/xgate.h"
#include "io/input/input_error.hpp"
#include "kinds/xgate/settings.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::xgate {
namespace {

using tb::keys::ObjectOf;
using tb::keys::Range;

constexpr Range kRates = {1200, 3'000'000};
constexpr Range kByte = {0, 255}, kWord = {0, 0xFFFF};

std::uint32_t cycles(Tick time) { return static_cast<std::uint32_t>(time / bus::kTicksPerCycle); }

Words words_of(const std::string& text) {
  Words words{};
  std::copy(text.begin(), text.end(), words.begin());
  return words;
}

void add_choices(ObjectOf<ChipSettings>& o) {
  using C = ChipSettings;
  o.word("port", &C::port, std::vector<tb::keys::WordFor<Port>>{{Port::kUart, "uart", ""}, {Port::kSpi, "spi", ""}},
         "The line to the host (4.6).");
  o.word("errors", &C::errors,
         std::vector<tb::keys::WordFor<ErrorForm>>{{ErrorForm::kFlag, "flag", "len 03 and bit 7 of special"},
                                                   {ErrorForm::kPrinted, "printed", "len 83, as 4.5.1 prints it"}},
         "The form of error answers (X3).");
  o.word("mailboxes", &C::mailboxes,
         std::vector<tb::keys::WordFor<MailboxForm>>{{MailboxForm::kSpecial, "special", "with the byte special"},
                                                     {MailboxForm::kShort, "short", "without it"}},
         "The form of mailboxes (X6).");
  o.word("watchdog", &C::watchdog,
         std::vector<tb::keys::WordFor<WatchdogUse>>{{WatchdogUse::kStored, "stored", "nothing"},
                                                     {WatchdogUse::kHost, "host", "the host's commands"}},
         "The object of command 16 (X12).");
  o.word("step_answer", &C::step_answer,
         std::vector<tb::keys::WordFor<StepAnswer>>{{StepAnswer::kTable, "table", "13"},
                                                    {StepAnswer::kExample, "example", "04"}},
         "The command code of the answer to command 13 (X15).");
}

void add_times(ObjectOf<ChipSettings>& o) {
  using C = ChipSettings;
  const Range any = {0, 10 * bus::kTicksPerSecond};
  o.time("answer_delay", &C::answer_time, any, "Time from a command to its answer (X2).");
  o.time("frame_gap", &C::gap_time, any, "Gap at the end of a frame, at least 10 characters (X4).");
  o.time("power_up", &C::power_time, any, "Time from /Rst to the first frame (X18).");
  o.time("rate_hold", &C::hold_time, any, "Time from the answer to command 03 to the new rate (X13).");
  o.time("host_shown", &C::shown_time, any, "Time for which LED2 shows a command (X26).");
}

void add_numbers(ObjectOf<ChipSettings>& o) {
  using C = ChipSettings;
  o.integer("rate", &C::rate, kRates, "bit/s", "Rate of the UART after /Rst (X18).");
  o.integer("spi_mode", &C::spi_mode, {0, 3}, "", "SPI mode, CPOL in bit 1, CPHA in bit 0; the PC tool sets it (X14).");
  o.integer("most_cfg", &C::most_cfg, {1, 244}, "bytes", "Longest configuration in command 04 (X5).");
  o.integer("c1_id", &C::c1_id, kByte, "", "Id of mailboxes of C1 (X7).");
  o.integer("c2_id", &C::c2_id, kByte, "", "Id of mailboxes of C2 (X7).");
  o.integer("mailbox_special", &C::mailbox_special, kByte, "", "The byte special of mailboxes (X6).");
  o.integer("vendor", &C::vendor, kWord, "", "Vendor of command 01 (X27).");
  o.integer("device", &C::device, kWord, "", "Device of command 01 (X27).");
  o.integer("hardware", &C::hardware, kWord, "", "Hardware version of command 01 (X27).");
  o.integer("software", &C::software, kWord, "", "Software version of command 01 (X27).");
  o.text("serial_number", &C::serial_number, "Serial number of command 01, until command 02 (X27).", 12);
  o.text("product", &C::product, "Name of command 01, until command 02 (X27).", 12);
  o.boolean("isp_cfg_low", &C::isp_cfg_low,
            "The board ties /ISP-CFG to ground: the module waits for the PC tool (X25).");
}

const ObjectOf<HostSpi>& spi_keys() {
  static const ObjectOf<HostSpi> keys = [] {
    ObjectOf<HostSpi> o(
        "spi", "The host's SPI controller, with port: spi of the chip, whose spi_mode it has. XSS is NSS here.");
    tb::add_spi_times(o);
    return o;
  }();
  return keys;
}

constexpr std::array<const char*, 5> kArmKeys = {"kind", "elf", "without_mailbox", "switches", "cpi"};

void add_processor(ObjectOf<UserSettings>& o) {
  o.word("kind", &UserSettings::kind,
         std::vector<tb::keys::WordFor<HostCpu>>{
             {HostCpu::kNative, "native", "a program of the bench with driver/xgate, whose computing takes no time"},
             {HostCpu::kArm, "arm", tb::kArmText}},
         "The host.");
  tb::add_elf_key(o);
  tb::add_without_mailbox_key(o);
  tb::add_processor_keys(o);
}

void add_line(ObjectOf<UserSettings>& o) {
  using U = UserSettings;
  o.integer("rate", &U::rate, kRates, "bit/s", "The host's rate (default: the chip's).");
  o.time("reset_wait", &U::reset_wait, {0, 10 * bus::kTicksPerSecond},
         "From the rise of /Rst to the host's first byte (default: the chip's power_up and 1 ms, X18).");
  o.time("byte_gap", &U::byte_gap, {0, bus::kTicksPerSecond}, "Idle time between two bytes of a command by UART.");
  o.object("spi", &U::spi, spi_keys(), "Its end of SPI, with port: spi of the chip.");
  o.boolean("printed_errors", &U::printed_errors,
            "The host expects errors as printed (default: as the chip's errors, X3).");
  o.boolean("short_mailboxes", &U::short_mailboxes,
            "The host has mailboxes without special (default: as the chip's mailboxes, X6).");
  o.integer("repetitions", &U::repetitions, {0, 255}, "",
            "Number of times that a command without a whole answer is sent again.");
  o.integer("answer_ms", &U::answer_ms, {1, 60'000}, "ms", "Longest wait for an answer.");
  o.integer("byte_ms", &U::byte_ms, {1, 60'000}, "ms", "Longest wait for the next byte of an answer.");
  o.time("retry", &U::retry, {1, 10 * bus::kTicksPerSecond}, "Pause before command 04 is given again.");
}

void add_initialisation(ObjectOf<UserSettings>& o) {
  using U = UserSettings;
  o.boolean("any_cfg", &U::any_cfg,
            "Command 04 has no configuration: the master's is right, and read before data exchange.");
  o.boolean("check_cfg_mode", &U::check_cfg_mode,
            "DPV1_STATUS bit 0: another configuration than that of command 04 is right.");
  o.integer("user_parameters", &U::user_parameters, {0, 237}, "bytes",
            "Number of the master's user parameters and DPV1's three; 0: none (X9).");
  o.integer("c2_timeout", &U::c2_timeout, kByte, "100 ms", "C2_Response_Timeout (X20).");
  o.integer("c1_length", &U::c1_length, {0, 240}, "bytes", "Longest data of a request of C1.");
  o.integer("c2_length", &U::c2_length, {0, 240}, "bytes", "Longest data of a request of C2.");
  o.integer("alarm_types", &U::alarm_types, kByte, "",
            "Type_Enable_Alarm: bit 7 pull and plug, 6 process, 5 diagnostic, 4 "
            "manufacturer, 3 status, 2 update (X17).");
  o.integer("open_alarms", &U::open_alarms, {0, 7}, "", "Num_Enable_Alarm n: at most 2^n alarms are open (X17).");
}

}  // namespace

Config ChipSettings::config() const {
  Config config = *this;
  config.answer_delay = cycles(answer_time);
  config.frame_gap = cycles(gap_time);
  config.power_up = cycles(power_time);
  config.rate_hold = cycles(hold_time);
  config.host_shown = cycles(shown_time);
  config.serial = words_of(serial_number);
  config.name = words_of(product);
  return config;
}

void check_ids(const ChipSettings& chip, const std::string& file) {
  if (chip.c1_id == chip.c2_id)
    throw tb::InputError(file, chip.line,
                         fmt::format("c1_id and c2_id are both {}, expected different ids (X7)", chip.c1_id));
}

void check_line(const UserSettings& user, const ChipSettings& chip, const std::string& file) {
  if (user.rate && chip.port != Port::kUart)
    throw tb::InputError(file, user.line, "rate with port: spi of the chip, expected port: uart");
  if (user.spi && chip.port != Port::kSpi)
    throw tb::InputError(file, user.spi->line, "spi with port: uart of the chip, expected port: spi");
  if (user.spi) tb::check_mosi(*user.spi, file);
}

/// Command 04 has no place for some data, and for a long configuration.
void check_slave(const tb::scenario::Scenario& scenario, const tb::scenario::Slave& slave) {
  constexpr std::array kServed = {"ident", "max_inputs", "max_outputs", "cfg", "fail_safe", "dpv1"};
  for (const tb::keys::Given& key : slave.init.given)
    if (std::find(kServed.begin(), kServed.end(), key.key) == kServed.end())
      throw tb::InputError(scenario.file, key.line,
                           fmt::format("init has {}, but command 04 of an XGate-DPS10 has no place for it, expected {}",
                                       key.key, fmt::join(kServed, ", ")));
  const std::size_t cfg = slave.init.cfg ? slave.init.cfg->size() : 0;
  if (cfg > XGATE_MAX_CFG && !user_settings_of(*slave.user_cpu.own).any_cfg)
    throw tb::InputError(scenario.file, slave.init.line,
                         fmt::format("cfg has {} bytes, but command 04 holds {}, expected any_cfg: true of the user "
                                     "CPU (4.7.3)",
                                     cfg, XGATE_MAX_CFG));
}

const tb::keys::Object& chip_keys() {
  static const ObjectOf<ChipSettings> keys = [] {
    ObjectOf<ChipSettings> o("chip", "The open choices and times in the data sheet of an XGate-DPS10 (docs/xgate.md).");
    add_choices(o);
    add_times(o);
    add_numbers(o);
    return o;
  }();
  return keys;
}

const tb::keys::Object& user_keys() {
  static const ObjectOf<UserSettings> keys = [] {
    ObjectOf<UserSettings> o(
        "user_cpu", "The host of an XGate-DPS10: driver/xgate, its line, and what it gives in command 04 (4.2).");
    add_processor(o);
    add_line(o);
    add_initialisation(o);
    return o;
  }();
  return keys;
}

void check_cpu(const tb::scenario::Scenario& scenario, const tb::scenario::Slave& slave) {
  constexpr tb::WiredPins kUart = {0x000C, 0, 0, 0, 0x0010, 0, 0x0040}, kSpi = {0x00F0, 0, 0, 0, 0x0010, 0, 0x0040};
  const UserSettings& user = user_settings_of(*slave.user_cpu.own);
  const bool arm = user.kind == HostCpu::kArm;
  for (const tb::keys::Given& key : slave.user_cpu.given) {
    const bool of_board = std::find(kArmKeys.begin(), kArmKeys.end(), key.key) != kArmKeys.end();
    if (arm && !of_board && user_keys().find(key.key) != nullptr)
      throw tb::InputError(
          scenario.file, key.line,
          fmt::format("{} is that of kind: native, the firmware of an ARM board has its own", key.key));
    if (!arm && (key.key == "cpi" || key.key == "without_mailbox"))
      throw tb::InputError(scenario.file, key.line, fmt::format("{} without kind: arm, expected both", key.key));
  }
  tb::check_board_keys(user, arm, chip_settings_of(*slave.chip).port == Port::kSpi ? kSpi : kUart, scenario.file,
                       slave.name.text, slave.line);
}

}  // namespace dsdpv1::xgate
