#pragma once
// Script actions for the user program of a DSDPV1 beyond those of every slave's program, and the codes of its driver's
// results.
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
constexpr const char* kSpoilReads = "spoil_reads";

/// The words of command::OfChip::block, in the order of command::Area.
const std::vector<std::string>& block_words();

/// Carries out an order for the port; returns false, without any effect, for one for the program.
bool carry_out(const Command& command, HostBus& port);

/// Converts the bench's command for this chip's programs.
DriverCommand driver_command(const Command& command);

/// "DSDPV1_ERR_INIT_CRC", ...: the code of a driver call's result.
std::string driver_error_code(dsdpv1_error error);

}  // namespace dsdpv1::user_cpu
