#pragma once
// Settings in a scenario for a chip of the SPC3 family: its parameters, and the user CPU.
#include "kinds/board/board_keys.hpp"
#include "kinds/board/spi_keys.hpp"
#include "kinds/spc3/user_cpu/program.hpp"
#include "kinds/user_cpu/cpu.hpp"
#include "model/spc3/bus_lines.hpp"
#include "model/spc3/config.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

struct Spc3Settings : OwnSettings, spc3::Config {
  spc3::Bus bus = spc3::Bus::kIntelAsync;  ///< the straps XINT/MOT, MODE and SERIAL
};

struct Spc3Access : dsdpv1::AccessTiming {
  int line = 0;
};

struct Spc3Spi : SpiTimes {
  Spc3Spi() { clock_khz = 4500; }
};

enum class Spc3Cpu : std::uint8_t { kNative, kArm };

struct Spc3User : OwnSettings, spc3_user::FirmwareOptions, BoardKeys {
  Spc3Cpu kind = Spc3Cpu::kNative;
  Spc3Access access;
  Spc3Spi spi;
  bool wait = true;  ///< XREADY is connected
  Tick overhead = user_cpu::CpuTiming().overhead;
  Tick interrupt_latency = 2000;
};

inline const Spc3User& spc3_user_of(const scenario::UserCpu& user) { return static_cast<const Spc3User&>(*user.own); }
/// ChipKind::check_user.
void check_spc3_user(const Spc3User& user, const Spc3Settings& chip, const std::string& file, const std::string& slave,
                     int line);

// The keys (ChipKind::chip_keys, user_keys).
const keys::Object& spc3_chip_keys(spc3::Variant variant);
const keys::Object& spc3_user_keys(spc3::Variant variant);

/// ChipKind::orders.
const std::vector<Order>& spc3_orders();
/// ChipKind::check_slave.
void check_spc3_slave(const scenario::Scenario& scenario, const scenario::Slave& slave);

/// The chip's parameters, with the engine of the request.
spc3::Config spc3_config_of(const ChipRequest& request);

/// ChipKind::codes.
const std::vector<CodeTable>& spc3_codes();

}  // namespace dsdpv1::tb
