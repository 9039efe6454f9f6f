#pragma once
// What a scenario's script can order the user program of a DSDPV1 to do beyond what every slave's program does, and the
// codes of what its driver returns.
#include <string>
#include <vector>

#include "kinds/dsdpv1/user_cpu/programs.hpp"

namespace dsdpv1::user_cpu {

// Words of command::OfChip::order.
constexpr const char* kHoldDpram = "hold_dpram";
constexpr const char* kWrongCrc = "wrong_crc";
constexpr const char* kEarlyRSta = "early_r_sta";
constexpr const char* kFlipBit = "flip_bit";
constexpr const char* kCutTelegram = "cut_telegram";
constexpr const char* kWrongParity = "wrong_parity";
constexpr const char* kHostTelegram = "host_telegram";
constexpr const char* kSendBreak = "send_break";
constexpr const char* kPauseTelegram = "pause_telegram";
constexpr const char* kTalkOverReply = "talk_over_reply";

/// The words of command::OfChip::block, in the order of command::Area.
const std::vector<std::string>& block_words();

/// The bench's command as this chip's programs take it.
DriverCommand driver_command(const Command& command);

/// "DSDPV1_ERR_INIT_CRC", ...: what a call of the driver returned.
std::string driver_error_code(dsdpv1_error error);

}  // namespace dsdpv1::user_cpu
