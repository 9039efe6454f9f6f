// Generated from registers/dsdpv1.rdl by registers/generate.py. Do not edit.
#pragma once
// Addresses, bits and values of the DPRAM. A word (CRC, count) is at its high byte, the low byte follows.
#include <cstdint>

// clang-format off
namespace dsdpv1::regs {

using Address = std::uint16_t;  ///< 0x000..0x7FF

/// A part of the DPRAM and its writers (ruling P6); without a writer if only some modes of the DSDPV1-RSU have it.
struct Cell {
  Address first;
  Address last;
  bool chip_writes;
  bool user_writes;
  const char* name;
};

// DPRAM
inline constexpr std::uint16_t kDpramSize = 2048;  // bytes

// Status and command bytes
inline constexpr Address kVersion = 0x000;  // Version code
inline constexpr std::uint8_t kVersionReset = 0x01;  // value after reset
inline constexpr Address kVersionYear = 0x001;  // Version, year
inline constexpr std::uint8_t kVersionYearReset = 0x0D;  // value after reset
inline constexpr Address kVersionMonth = 0x002;  // Version, month
inline constexpr std::uint8_t kVersionMonthReset = 0x07;  // value after reset
inline constexpr Address kVersionDay = 0x003;  // Version, day
inline constexpr std::uint8_t kVersionDayReset = 0x01;  // value after reset
inline constexpr Address kValidFlag = 0x004;  // Valid flag
inline constexpr Address kDpv1Enable = 0x005;  // DPV1 enable
inline constexpr Address kAccessCount = 0x006;  // DPRAM access count
inline constexpr Address kOfflineCount = 0x008;  // Count of leaving data exchange
inline constexpr Address kChipStatus1 = 0x00A;  // Chip status byte 1
inline constexpr std::uint8_t kChipStatus1Initialised = 0x01;  // The initialisation succeeded; the user may clear it afterwards (ruling D7).
inline constexpr Address kChipStatus2 = 0x00B;  // Chip status byte 2
inline constexpr std::uint8_t kChipStatus2InitCrc = 0x01;  // Initialisation data, CRC wrong.
inline constexpr std::uint8_t kChipStatus2V1InitCrc = 0x02;  // V1 initialisation, CRC wrong; the chip never sets it (ruling R5).
inline constexpr std::uint8_t kChipStatus2InputCrc = 0x04;  // Input data, CRC wrong.
inline constexpr std::uint8_t kChipStatus2DiagCrc = 0x08;  // Diagnosis data, CRC wrong.
inline constexpr std::uint8_t kChipStatus2C1Crc = 0x10;  // C1 answer, CRC wrong.
inline constexpr std::uint8_t kChipStatus2C2Crc = 0x20;  // C2 answer, CRC wrong.
inline constexpr Address kUserStatus1 = 0x00C;  // User status byte 1
inline constexpr std::uint8_t kUserStatus1PrmWrong = 0x01;  // The user judges the parameters wrong; counts with B010.7 (ruling D4).
inline constexpr std::uint8_t kUserStatus1CfgWrong = 0x02;  // The user judges the configuration wrong; counts with B010.6 (ruling D4).
inline constexpr Address kUserStatus2 = 0x00D;  // User status byte 2
inline constexpr std::uint8_t kUserStatus2CfgCrc = 0x01;  // Configuration data, CRC wrong.
inline constexpr std::uint8_t kUserStatus2PrmCrc = 0x02;  // Parameter data, CRC wrong.
inline constexpr std::uint8_t kUserStatus2OutputCrc = 0x04;  // Output data, CRC wrong.
inline constexpr std::uint8_t kUserStatus2C2Crc = 0x08;  // C2 request, CRC wrong.
inline constexpr std::uint8_t kUserStatus2C1Crc = 0x10;  // C1 request, CRC wrong.
inline constexpr Address kChipCommand1 = 0x00E;  // Chip command byte 1
inline constexpr std::uint8_t kChipCommand1Output = 0x01;  // Output data valid.
inline constexpr std::uint8_t kChipCommand1Prm = 0x02;  // Parameter data valid.
inline constexpr std::uint8_t kChipCommand1Cfg = 0x04;  // Configuration data valid.
inline constexpr Address kChipCommand2 = 0x00F;  // Chip command byte 2
inline constexpr std::uint8_t kChipCommand2C1 = 0x01;  // C1 request valid.
inline constexpr std::uint8_t kChipCommand2C2 = 0x02;  // C2 request valid.
inline constexpr Address kUserCommand1 = 0x010;  // User command byte 1
inline constexpr std::uint8_t kUserCommand1Input = 0x01;  // Input data valid.
inline constexpr std::uint8_t kUserCommand1Diag = 0x02;  // Diagnosis data valid.
inline constexpr std::uint8_t kUserCommand1Init = 0x04;  // Initialisation data valid.
inline constexpr std::uint8_t kUserCommand1CfgVerdict = 0x40;  // Verdict on the configuration valid, see B00C.1 (ruling D4).
inline constexpr std::uint8_t kUserCommand1PrmVerdict = 0x80;  // Verdict on the parameters valid, see B00C.0 (ruling D4).
inline constexpr Address kUserCommand2 = 0x011;  // User command byte 2
inline constexpr std::uint8_t kUserCommand2C1 = 0x01;  // C1 answer valid.
inline constexpr std::uint8_t kUserCommand2C2 = 0x02;  // C2 answer valid.
inline constexpr std::uint8_t kUserCommand2InputHistory = 0x40;  // 1: B00B.2 shows the history of the inputs' CRC, a right block does not clear it; 0: the present. The user sets and clears it, the chip only reads it (ruling D16).
inline constexpr std::uint8_t kUserCommand2InputClear = 0x80;  // Asks the chip to clear B00B.2, which it does once when B011.6 is 1; it sets this bit back to 0 whatever B011.6 is (ruling D16).
inline constexpr Address kChipStatus3 = 0x012;  // Chip status byte 3
inline constexpr std::uint8_t kChipStatus3DpState = 0x0C;  // State of the DP slave.
inline constexpr int kChipStatus3DpStateShift = 2;  // lowest bit
inline constexpr std::uint8_t kChipStatus3BaudRate = 0xF0;  // Baud rate.
inline constexpr int kChipStatus3BaudRateShift = 4;  // lowest bit
inline constexpr Address kChipStatus4 = 0x013;  // Chip status byte 4
inline constexpr std::uint8_t kChipStatus4InitLimit = 0x01;  // A length or the address of the initialisation is out of its limits (ruling D7).
inline constexpr std::uint8_t kChipStatus4C2Limit = 0x02;  // Number of C2 channels over its limit; always 0 (ruling R5).
inline constexpr std::uint8_t kChipStatus4SlotLimit = 0x04;  // Number of slots and indices over its limit; always 0 (ruling R5).
inline constexpr Address kOwnership = 0x014;  // Ownership
inline constexpr std::uint8_t kOwnershipChip = 0x01;  // The chip is in an access.
inline constexpr std::uint8_t kOwnershipHost = 0x02;  // The host is in an access.
inline constexpr Address kUTimer = 0x015;  // U_Timer
inline constexpr std::uint8_t kUTimerEnable = 0x01;  // Enabled: the ownership ends automatically.
inline constexpr Address kUartInterval = 0x019;  // Interval between characters
inline constexpr Address kUartTsdr = 0x01A;  // TSDR

// Initialisation data
inline constexpr Address kInit = 0x020;  // first byte
inline constexpr std::uint16_t kInitSize = 215;  // bytes, without the CRC
inline constexpr Address kInitLength = 0x020;  // Length
inline constexpr Address kInitAddress = 0x021;  // Station address
inline constexpr std::uint8_t kInitAddressLimit = 126;  // largest value accepted
inline constexpr Address kInitIdentHigh = 0x022;  // Ident number, high byte
inline constexpr Address kInitIdentLow = 0x023;  // Ident number, low byte
inline constexpr Address kInitCommand = 0x024;  // Initialisation command byte
inline constexpr std::uint8_t kInitCommandAddressChange = 0x01;  // Set_Slave_Address is supported.
inline constexpr std::uint8_t kInitCommandFreeze = 0x02;  // Freeze is supported.
inline constexpr std::uint8_t kInitCommandSync = 0x04;  // Sync is supported.
inline constexpr std::uint8_t kInitCommandFailSafe = 0x08;  // Fail-safe mode is supported.
inline constexpr Address kInitMaxInput = 0x027;  // Largest input data length
inline constexpr std::uint8_t kInitMaxInputLimit = 244;  // largest value accepted
inline constexpr Address kInitMaxOutput = 0x028;  // Largest output data length
inline constexpr std::uint8_t kInitMaxOutputLimit = 244;  // largest value accepted
inline constexpr Address kInitMaxDiag = 0x029;  // User diagnosis length
inline constexpr std::uint8_t kInitMaxDiagLimit = 238;  // largest value accepted
inline constexpr Address kInitMaxPrm = 0x02A;  // Largest user parameter length
inline constexpr std::uint8_t kInitMaxPrmLimit = 237;  // largest value accepted
inline constexpr Address kPrmMode = 0x02B;  // Judging mode of the user parameters
inline constexpr Address kInitMaxCfg = 0x02C;  // Largest configuration length
inline constexpr std::uint8_t kInitMaxCfgLimit = 200;  // largest value accepted
inline constexpr Address kCfgMode = 0x02D;  // Judging mode of the configuration
inline constexpr Address kInitCfgLength = 0x02E;  // Configuration length
inline constexpr std::uint8_t kInitCfgLengthLimit = 200;  // largest value accepted
inline constexpr Address kInitCfg = 0x02F;  // Configuration bytes
inline constexpr std::uint16_t kInitCfgSize = 200;  // bytes
inline constexpr Address kInitCrc = 0x0F7;  // CRC

// Input data
inline constexpr Address kInput = 0x130;  // first byte
inline constexpr std::uint16_t kInputSize = 245;  // bytes, without the CRC
inline constexpr Address kInputLength = 0x130;  // Length
inline constexpr Address kInputData = 0x131;  // Input bytes
inline constexpr std::uint16_t kInputDataSize = 244;  // bytes
inline constexpr Address kInputCrc = 0x225;  // CRC

// Diagnosis data
inline constexpr Address kDiag = 0x227;  // first byte
inline constexpr std::uint16_t kDiagSize = 240;  // bytes, without the CRC
inline constexpr Address kDiagType = 0x227;  // Type of diagnosis
inline constexpr Address kDiagLength = 0x228;  // Length
inline constexpr Address kDiagData = 0x229;  // Diagnosis bytes
inline constexpr std::uint16_t kDiagDataSize = 238;  // bytes
inline constexpr Address kDiagCrc = 0x317;  // CRC

// Output data
inline constexpr Address kOutput = 0x319;  // first byte
inline constexpr std::uint16_t kOutputSize = 245;  // bytes, without the CRC
inline constexpr Address kOutputLength = 0x319;  // Length
inline constexpr Address kOutputData = 0x31A;  // Output bytes
inline constexpr std::uint16_t kOutputDataSize = 244;  // bytes
inline constexpr Address kOutputCrc = 0x40E;  // CRC

// User parameters
inline constexpr Address kPrm = 0x410;  // first byte
inline constexpr std::uint16_t kPrmSize = 238;  // bytes, without the CRC
inline constexpr Address kPrmLength = 0x410;  // Length
inline constexpr Address kPrmData = 0x411;  // User parameter bytes
inline constexpr std::uint16_t kPrmDataSize = 237;  // bytes
inline constexpr Address kPrmCrc = 0x4FE;  // CRC

// Configuration
inline constexpr Address kCfg = 0x500;  // first byte
inline constexpr std::uint16_t kCfgSize = 203;  // bytes, without the CRC
inline constexpr Address kCfgOutputLength = 0x500;  // Output data length
inline constexpr Address kCfgInputLength = 0x501;  // Input data length
inline constexpr Address kCfgLength = 0x502;  // Length
inline constexpr Address kCfgData = 0x503;  // Configuration bytes
inline constexpr std::uint16_t kCfgDataSize = 200;  // bytes
inline constexpr Address kCfgCrc = 0x5CB;  // CRC

// Non-cyclic data, class 1
inline constexpr Address kC1 = 0x5D0;  // first byte
inline constexpr std::uint16_t kC1Size = 244;  // bytes, without the CRC
inline constexpr Address kC1FunctionNum = 0x5D0;  // Function_Num
inline constexpr Address kC1Slot = 0x5D1;  // Slot number or Error_Decode
inline constexpr Address kC1Index = 0x5D2;  // Index or Error_Code_1
inline constexpr Address kC1Length = 0x5D3;  // Data length or Error_Code_2
inline constexpr Address kC1Data = 0x5D4;  // Data
inline constexpr std::uint16_t kC1DataSize = 240;  // bytes
inline constexpr Address kC1Crc = 0x6C4;  // CRC

// Non-cyclic data, class 2
inline constexpr Address kC2 = 0x6D0;  // first byte
inline constexpr std::uint16_t kC2Size = 244;  // bytes, without the CRC
inline constexpr Address kC2FunctionNum = 0x6D0;  // Function_Num
inline constexpr Address kC2Slot = 0x6D1;  // Slot number or Error_Decode
inline constexpr Address kC2Index = 0x6D2;  // Index or Error_Code_1
inline constexpr Address kC2Length = 0x6D3;  // Data length or Error_Code_2
inline constexpr Address kC2Data = 0x6D4;  // Data
inline constexpr std::uint16_t kC2DataSize = 240;  // bytes
inline constexpr Address kC2Crc = 0x7C4;  // CRC

// Values of valid_flag
inline constexpr std::uint8_t kValidFlagValid = 0xC5;  // The chip has begun to work.

// Values of dpv1_enable
inline constexpr std::uint8_t kDpv1EnableOn = 0x1D;  // DPV1 is enabled; every other value disables it.

// Values of dp_state
inline constexpr std::uint8_t kDpStateOffline = 0x00;  // OFFLINE
inline constexpr std::uint8_t kDpStateWaitPrm = 0x01;  // WAIT_PRM
inline constexpr std::uint8_t kDpStateWaitCfg = 0x02;  // WAIT_CFG
inline constexpr std::uint8_t kDpStateDataExchange = 0x03;  // DATA_EXCHANGE

// Values of baud
inline constexpr std::uint8_t kBaudRate12M = 0x00;  // 12 Mbit/s
inline constexpr std::uint8_t kBaudRate6M = 0x01;  // 6 Mbit/s
inline constexpr std::uint8_t kBaudRate3M = 0x02;  // 3 Mbit/s
inline constexpr std::uint8_t kBaudRate1M5 = 0x03;  // 1.5 Mbit/s
inline constexpr std::uint8_t kBaudRate500k = 0x04;  // 500 kbit/s
inline constexpr std::uint8_t kBaudRate187k5 = 0x05;  // 187.5 kbit/s
inline constexpr std::uint8_t kBaudRate93k75 = 0x06;  // 93.75 kbit/s
inline constexpr std::uint8_t kBaudRate45k45 = 0x07;  // 45.45 kbit/s
inline constexpr std::uint8_t kBaudRate19k2 = 0x08;  // 19.2 kbit/s
inline constexpr std::uint8_t kBaudRate9k6 = 0x09;  // 9.6 kbit/s
inline constexpr std::uint8_t kBaudSearching = 0x0F;  // The baud rate is being searched.

// Values of prm_mode
inline constexpr std::uint8_t kPrmModeAtMost = 0x00;  // The chip judges: user parameter length <= B02A.
inline constexpr std::uint8_t kPrmModeExactly = 0x01;  // The chip judges: user parameter length = B02A.
inline constexpr std::uint8_t kPrmModeUser = 0x02;  // The user judges: verdict in B00C.0, handed over with B010.7.

// Values of cfg_mode
inline constexpr std::uint8_t kCfgModeAtMost = 0x00;  // The chip judges: 0 < configuration length <= B02C.
inline constexpr std::uint8_t kCfgModeEqual = 0x01;  // The chip judges: configuration equal to B02F.. of the initialisation.
inline constexpr std::uint8_t kCfgModeUser = 0x02;  // The user judges: verdict in B00C.1, handed over with B010.6.

// Values of diag_type
inline constexpr std::uint8_t kDiagTypeExtended = 0x00;  // Low priority, extended diagnosis; ends external diagnosis (Ext_Diag 0).
inline constexpr std::uint8_t kDiagTypeExternalGone = 0x01;  // High priority, external diagnosis: the station has no error.
inline constexpr std::uint8_t kDiagTypeExternalPresent = 0x81;  // High priority, external diagnosis: the station has an error (Ext_Diag).
inline constexpr std::uint8_t kDiagTypeStaticGone = 0x02;  // High priority, static diagnosis: the station has no error.
inline constexpr std::uint8_t kDiagTypeStaticPresent = 0x82;  // High priority, static diagnosis: the station has an error (Stat_Diag).

// Values of function_num
inline constexpr std::uint8_t kFunctionNumTransport = 0x51;  // DS_Transport, class 2 only (table 31).
inline constexpr std::uint8_t kFunctionNumRead = 0x5E;  // DS_Read (table 26).
inline constexpr std::uint8_t kFunctionNumWrite = 0x5F;  // DS_Write (table 26).
inline constexpr std::uint8_t kFunctionNumTransportError = 0xD1;  // Transport error, class 2 only (table 32).
inline constexpr std::uint8_t kFunctionNumReadError = 0xDE;  // Read error (table 27).
inline constexpr std::uint8_t kFunctionNumWriteError = 0xDF;  // Write error (table 27).

/// Every address once, ascending, without a gap.
inline constexpr Cell kMap[] = {
    {0x000, 0x000, true, false, "version"},
    {0x001, 0x001, true, false, "version_year"},
    {0x002, 0x002, true, false, "version_month"},
    {0x003, 0x003, true, false, "version_day"},
    {0x004, 0x004, true, false, "valid_flag"},
    {0x005, 0x005, false, true, "dpv1_enable"},
    {0x006, 0x006, true, true, "access_count"},
    {0x007, 0x007, false, false, "reserved_007"},
    {0x008, 0x009, true, false, "offline_count"},
    {0x00A, 0x00A, true, true, "chip_status_1"},
    {0x00B, 0x00B, true, true, "chip_status_2"},
    {0x00C, 0x00C, false, true, "user_status_1"},
    {0x00D, 0x00D, false, true, "user_status_2"},
    {0x00E, 0x00E, true, true, "chip_command_1"},
    {0x00F, 0x00F, true, true, "chip_command_2"},
    {0x010, 0x010, true, true, "user_command_1"},
    {0x011, 0x011, true, true, "user_command_2"},
    {0x012, 0x012, true, false, "chip_status_3"},
    {0x013, 0x013, true, false, "chip_status_4"},
    {0x014, 0x014, false, false, "ownership"},
    {0x015, 0x015, false, false, "u_timer"},
    {0x016, 0x018, false, false, "reserved_016"},
    {0x019, 0x019, false, false, "uart_interval"},
    {0x01A, 0x01A, false, false, "uart_tsdr"},
    {0x01B, 0x01F, false, false, "reserved_01b"},
    {0x020, 0x020, false, true, "init.length"},
    {0x021, 0x021, false, true, "init.address"},
    {0x022, 0x022, false, true, "init.ident_high"},
    {0x023, 0x023, false, true, "init.ident_low"},
    {0x024, 0x024, false, true, "init.command"},
    {0x025, 0x026, false, true, "init.reserved"},
    {0x027, 0x027, false, true, "init.max_input"},
    {0x028, 0x028, false, true, "init.max_output"},
    {0x029, 0x029, false, true, "init.max_diag"},
    {0x02A, 0x02A, false, true, "init.max_prm"},
    {0x02B, 0x02B, false, true, "init.prm_mode"},
    {0x02C, 0x02C, false, true, "init.max_cfg"},
    {0x02D, 0x02D, false, true, "init.cfg_mode"},
    {0x02E, 0x02E, false, true, "init.cfg_length"},
    {0x02F, 0x0F6, false, true, "init.cfg"},
    {0x0F7, 0x0F8, false, true, "init.crc"},
    {0x0F9, 0x12F, false, false, "reserved_0f9"},
    {0x130, 0x130, false, true, "input.length"},
    {0x131, 0x224, false, true, "input.data"},
    {0x225, 0x226, false, true, "input.crc"},
    {0x227, 0x227, false, true, "diag.diag_type"},
    {0x228, 0x228, false, true, "diag.length"},
    {0x229, 0x316, false, true, "diag.data"},
    {0x317, 0x318, false, true, "diag.crc"},
    {0x319, 0x319, true, true, "output.length"},
    {0x31A, 0x40D, true, true, "output.data"},
    {0x40E, 0x40F, true, true, "output.crc"},
    {0x410, 0x410, true, false, "prm.length"},
    {0x411, 0x4FD, true, false, "prm.data"},
    {0x4FE, 0x4FF, true, false, "prm.crc"},
    {0x500, 0x500, true, false, "cfg.output_length"},
    {0x501, 0x501, true, false, "cfg.input_length"},
    {0x502, 0x502, true, false, "cfg.length"},
    {0x503, 0x5CA, true, false, "cfg.data"},
    {0x5CB, 0x5CC, true, false, "cfg.crc"},
    {0x5CD, 0x5CF, false, false, "reserved_5cd"},
    {0x5D0, 0x5D0, true, true, "c1.function_num"},
    {0x5D1, 0x5D1, true, true, "c1.slot"},
    {0x5D2, 0x5D2, true, true, "c1.index"},
    {0x5D3, 0x5D3, true, true, "c1.length"},
    {0x5D4, 0x6C3, true, true, "c1.data"},
    {0x6C4, 0x6C5, true, true, "c1.crc"},
    {0x6C6, 0x6CF, false, false, "reserved_6c6"},
    {0x6D0, 0x6D0, true, true, "c2.function_num"},
    {0x6D1, 0x6D1, true, true, "c2.slot"},
    {0x6D2, 0x6D2, true, true, "c2.index"},
    {0x6D3, 0x6D3, true, true, "c2.length"},
    {0x6D4, 0x7C3, true, true, "c2.data"},
    {0x7C4, 0x7C5, true, true, "c2.crc"},
    {0x7C6, 0x7FF, false, false, "reserved_7c6"},
};

}  // namespace dsdpv1::regs
// clang-format on
