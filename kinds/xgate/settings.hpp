#pragma once
// Settings in a scenario for an XGate-DPS10 and its host.
#include <optional>
#include <string>

#include "kinds/board/board_keys.hpp"
#include "kinds/board/spi_keys.hpp"
#include "model/dsdpv1/serial_host.hpp"
#include "model/xgate/config.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::xgate {

using bus::Tick;

/// Under `chip`: the choices of docs/xgate.md. Times are in ticks; those of the base are set by config().
struct ChipSettings : tb::OwnSettings, Config {
  Tick answer_time = Config().answer_delay * bus::kTicksPerCycle;
  Tick gap_time = Config().frame_gap * bus::kTicksPerCycle;
  Tick power_time = Config().power_up * bus::kTicksPerCycle;
  Tick hold_time = Config().rate_hold * bus::kTicksPerCycle;
  Tick shown_time = Config().host_shown * bus::kTicksPerCycle;
  unsigned spi_mode = 0;  ///< CPOL in bit 1, CPHA in bit 0
  std::string serial_number, product = "XGate-DPS10";
  bool isp_cfg_low = false;  ///< the board ties /ISP-CFG to ground

  Config config() const;
};

/// The host's end of SPI.
struct HostSpi : tb::SpiTimes {
  HostSpi() { clock_khz = 1000; }
};

enum class HostCpu : std::uint8_t { kNative, kArm };

/// Under `user_cpu`: the host and what it gives in command 04. Absent: as the module's.
struct UserSettings : tb::OwnSettings, tb::BoardKeys {
  HostCpu kind = HostCpu::kNative;
  std::optional<bool> printed_errors, short_mailboxes;
  std::optional<std::uint32_t> rate;
  Tick byte_gap = 0;
  std::optional<Tick> reset_wait;
  std::optional<HostSpi> spi;
  int repetitions = 2, answer_ms = 20, byte_ms = 5;
  Tick retry = bus::kTicksPerMs;  ///< from a command 04 without a right answer to the next

  bool any_cfg = false, check_cfg_mode = false;
  int user_parameters = 0;
  int c2_timeout = 10, c1_length = 240, c2_length = 240;
  int alarm_types = 0xFC, open_alarms = 5;
};

inline const ChipSettings& chip_settings_of(const tb::OwnSettings& settings) {
  return static_cast<const ChipSettings&>(settings);
}
inline const UserSettings& user_settings_of(const tb::OwnSettings& settings) {
  return static_cast<const UserSettings&>(settings);
}

/// UART: 8 bits, no parity (4.7.2).
inline UartTiming uart_timing(std::uint32_t rate, Tick gap = 0) { return {rate, gap, false}; }

// The keys (ChipKind::chip_keys, user_keys).
const tb::keys::Object& chip_keys();
const tb::keys::Object& user_keys();
/// Throws InputError for keys that only the other kind of user CPU has.
void check_cpu(const tb::scenario::Scenario& scenario, const tb::scenario::Slave& slave);
// ChipKind::check_chip, check_slave and check_user; they throw InputError.
void check_ids(const ChipSettings& chip, const std::string& file);
void check_slave(const tb::scenario::Scenario& scenario, const tb::scenario::Slave& slave);
void check_line(const UserSettings& user, const ChipSettings& chip, const std::string& file);

}  // namespace dsdpv1::xgate
