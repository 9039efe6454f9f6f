#pragma once
// The DSDPV1's settings in a scenario: parameters of the chip, and the user CPU with its bus.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinds/board/board_keys.hpp"
#include "kinds/board/spi_keys.hpp"
#include "kinds/dsdpv1/port/serial_settings.hpp"
#include "kinds/dsdpv1/user_cpu/serial_port.hpp"
#include "kinds/user_cpu/cpu.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

using keys::Name;

struct Dsdpv1Settings : OwnSettings, dsdpv1::Config {
  // levels of the DSDPV1-RSU's straps
  HostMode mode = HostMode::kParallel;
  int address = 1;    ///< ADR
  int uart_rate = 7;  ///< UBR
  int interval = 0;   ///< UIV
};

/// The word for it in scenarios and on command lines.
const char* mode_name(HostMode mode);

/// Levels of MODE, ADR, UBR and UIV.
using Straps = std::array<Level, 4>;
Straps straps_of(const OwnSettings& settings);
/// True if a key of the chip is a strap.
bool is_strap(const std::string& key);

struct AccessTimes : AccessTiming {
  int line = 0;
};

struct CpuTimes : user_cpu::CpuTiming {
  int line = 0;
};

enum class CpuKind : std::uint8_t { kNative, kArm, kProcess };

/// The user's end of an SPI port.
struct SpiKeys : SpiTimes {
  int spare = 0;
};

/// The user's end of a UART port.
struct UartKeys {
  int rate = 0;  ///< bit/s; 0: the rate of the chip's strap
  Tick gap = 0;
  int line = 0;
};

struct Dsdpv1User : OwnSettings, BoardKeys {  // kArm; fsmc of all
  CpuKind kind = CpuKind::kNative;
  Name program;                               ///< kProcess
  std::vector<Name> arguments;                ///< kProcess
  Tick patience = 10 * bus::kTicksPerSecond;  ///< kProcess: of the host's time; 0: no limit
  std::optional<CpuTimes> timing;             ///< not kArm; its `access` is unused: see the next member
  std::optional<AccessTimes> access;
  std::optional<SpiKeys> spi;    ///< not kArm, HostMode::kSpi
  std::optional<UartKeys> uart;  ///< not kArm, HostMode::kUart
};

inline const Dsdpv1User& own(const scenario::UserCpu& user) { return static_cast<const Dsdpv1User&>(*user.own); }

/// The chip's parameters, with the engine of the request.
dsdpv1::Config config_of(const ChipRequest& request);

// The keys (ChipKind::chip_keys, user_keys).
const keys::Object& chip_keys_of(Part part);
inline const keys::Object& dsdpv1_chip_keys() { return chip_keys_of({}); }
const keys::Object& user_keys_of(Part part);

/// ChipKind::check_chip, check_user.
void check_dsdpv1_chip(const Dsdpv1Settings& chip, const std::string& file);
void check_dsdpv1_user(const Dsdpv1User& user, const std::string& file, const std::string& slave, int line);
void check_port(const Dsdpv1User& user, const Dsdpv1Settings& chip, const std::string& file, const std::string& slave,
                int line);
void check_order(const std::string& order, CpuKind kind, HostMode mode, const std::string& file, int line);

SerialSettings serial_settings_of(const Dsdpv1Settings& chip);
/// Makes a reader for the telegrams of the chip's serial port; null: it uses the parallel one.
std::unique_ptr<HostReader> host_reader_of(const Dsdpv1Settings& chip);

/// The user CPU's port to the chip.
user_cpu::HostPort host_port_of(const Dsdpv1User& user, const Dsdpv1Settings& chip);

}  // namespace dsdpv1::tb
