// Generated from registers/spc3.rdl by registers/generate.py. Do not edit.
#pragma once
// Addresses, bits and values of the SPC3 family. A word is at its low byte, the high byte follows.
#include <cstdint>

// clang-format off
namespace dsdpv1::spc3::regs {

using Address = std::uint16_t;  ///< 0x000..0x7FF

/// A part of the address space; command: a read acts (ruling A16).
struct Cell {
  Address first;
  Address last;
  bool user_reads;
  bool user_writes;
  bool command;
  const char* name;
};

// SPC3 family
inline constexpr std::uint16_t kRamSize = 1536;  // bytes

// Registers
inline constexpr Address kIrr = 0x000;  // Interrupt request register
inline constexpr Address kIr = 0x002;  // Interrupt register
inline constexpr Address kIar = 0x002;  // Interrupt acknowledge register
inline constexpr Address kStatus = 0x004;  // Status register
inline constexpr std::uint16_t kStatusReset = 0x0F00;  // value after reset
inline constexpr std::uint16_t kStatusPassiveIdle = 0x0001;  // 0 OFFLINE, 1 PASSIVE_IDLE.
inline constexpr std::uint16_t kStatusDiagFlag = 0x0004;  // The master has not fetched the diagnosis yet.
inline constexpr std::uint16_t kStatusRamViolation = 0x0008;  // Access beyond the RAM, by the user or by a pointer (ruling A3).
inline constexpr std::uint16_t kStatusDpState = 0x0030;  // State of the DP slave.
inline constexpr int kStatusDpStateShift = 4;  // lowest bit
inline constexpr std::uint16_t kStatusWdState = 0x00C0;  // State of the watchdog.
inline constexpr int kStatusWdStateShift = 6;  // lowest bit
inline constexpr std::uint16_t kStatusBaudRate = 0x0F00;  // Baud rate that is tried or was found (ruling A8).
inline constexpr int kStatusBaudRateShift = 8;  // lowest bit
inline constexpr std::uint16_t kStatusTypeCode = 0xF000;  // 0; vpc3 its type, B, C or E.
inline constexpr int kStatusTypeCodeShift = 12;  // lowest bit
inline constexpr Address kImr = 0x004;  // Interrupt mask register
inline constexpr std::uint16_t kImrReset = 0xFFFF;  // value after reset
inline constexpr Address kMode0Read = 0x006;  // Mode register 0, read
inline constexpr Address kMode0 = 0x006;  // Mode register 0
inline constexpr Address kDinSm = 0x008;  // Owners of the input buffers
inline constexpr std::uint8_t kDinSmReset = 0xE1;  // value after reset
inline constexpr Address kMode1S = 0x008;  // Mode register 1, set
inline constexpr Address kNewDin = 0x009;  // New_Din_Buffer_Cmd
inline constexpr std::uint8_t kNewDinU = 0x03;  // The user's new one.
inline constexpr int kNewDinUShift = 0;  // lowest bit
inline constexpr Address kMode1R = 0x009;  // Mode register 1, reset
inline constexpr Address kDoutSm = 0x00A;  // Owners of the output buffers
inline constexpr std::uint8_t kDoutSmReset = 0xE1;  // value after reset
inline constexpr Address kWdBaudControl = 0x00A;  // WD_BAUD_CONTROL_Val
inline constexpr std::uint8_t kWdBaudControlReset = 0x1E;  // value after reset
inline constexpr Address kNextDout = 0x00B;  // Next_Dout_Buffer_Cmd
inline constexpr std::uint8_t kNextDoutU = 0x03;  // The user's buffer now.
inline constexpr int kNextDoutUShift = 0;  // lowest bit
inline constexpr std::uint8_t kNextDoutFresh = 0x04;  // It is a new one.
inline constexpr std::uint8_t kNextDoutCleared = 0x08;  // It was cleared by the chip.
inline constexpr Address kMinTsdr = 0x00B;  // MinTSDR_Val
inline constexpr std::uint8_t kMinTsdrReset = 0x0B;  // value after reset
inline constexpr Address kDiagSm = 0x00C;  // Owners of the diagnosis buffers
inline constexpr std::uint8_t kDiagSmReset = 0x09;  // value after reset
inline constexpr std::uint8_t kDiagSmFirst = 0x03;  // Owner of buffer 1.
inline constexpr int kDiagSmFirstShift = 0;  // lowest bit
inline constexpr std::uint8_t kDiagSmSecond = 0x0C;  // Owner of buffer 2.
inline constexpr int kDiagSmSecondShift = 2;  // lowest bit
inline constexpr Address kMode2 = 0x00C;  // Mode register 2
inline constexpr std::uint8_t kMode2Reset = 0x01;  // value after reset
inline constexpr std::uint8_t kMode2GcEach = 0x01;  // New_GC_Command at every Global_Control (ruling A47).
inline constexpr std::uint8_t kMode2NoGcCheck = 0x02;  // The reserved bits of Global_Control are not checked.
inline constexpr std::uint8_t kMode2DxOutAlways = 0x04;  // DX_OUT also without outputs (ruling A48).
inline constexpr std::uint8_t kMode2NoPrmCheck = 0x40;  // The reserved bits of Set_Prm are not checked (ruling A21).
inline constexpr std::uint8_t kMode2Ram4k = 0x80;  // 4 KB of RAM, in segments of 16 bytes.
inline constexpr Address kNewDiag = 0x00D;  // New_Diag_Buffer_Cmd
inline constexpr std::uint8_t kNewDiagU = 0x03;  // The user's new buffer, 0 if there is none yet.
inline constexpr int kNewDiagUShift = 0;  // lowest bit
inline constexpr Address kPrmOk = 0x00E;  // User_Prm_Data_Okay
inline constexpr Address kPrmNotOk = 0x00F;  // User_Prm_Data_Not_Okay
inline constexpr Address kCfgOk = 0x010;  // User_Cfg_Data_Okay
inline constexpr Address kCfgNotOk = 0x011;  // User_Cfg_Data_Not_Okay
inline constexpr Address kMode3 = 0x012;  // Mode register 3
inline constexpr Address kSsaFree = 0x014;  // SSA_Buffer_Free_Cmd
inline constexpr Address kMode1Read = 0x015;  // Mode register 1, read

// Organisation
inline constexpr Address kOrg = 0x016;  // first byte
inline constexpr std::uint16_t kOrgSize = 42;  // bytes
inline constexpr Address kOrgAddress = 0x016;  // R_TS_Adr
inline constexpr std::uint8_t kOrgAddressLimit = 126;  // largest value accepted
inline constexpr Address kOrgSapPointer = 0x017;  // Pointer to a RAM address
inline constexpr Address kOrgUserWd = 0x018;  // R_User_Wd_Value
inline constexpr Address kOrgDoutLength = 0x01A;  // R_Len_Dout_Buf
inline constexpr std::uint8_t kOrgDoutLengthLimit = 244;  // largest value accepted
inline constexpr Address kOrgDoutPointer = 0x01B;  // R_Dout_Buf_Ptr1 to 3
inline constexpr std::uint16_t kOrgDoutPointerSize = 3;  // bytes
inline constexpr Address kOrgDinLength = 0x01E;  // R_Len_Din_Buf
inline constexpr std::uint8_t kOrgDinLengthLimit = 244;  // largest value accepted
inline constexpr Address kOrgDinPointer = 0x01F;  // R_Din_Buf_Ptr1 to 3
inline constexpr std::uint16_t kOrgDinPointerSize = 3;  // bytes
inline constexpr Address kOrgDiagLength = 0x024;  // R_Len_Diag_Buf1, 2
inline constexpr std::uint16_t kOrgDiagLengthSize = 2;  // bytes
inline constexpr std::uint8_t kOrgDiagLengthLimit = 244;  // largest value accepted
inline constexpr Address kOrgDiagPointer = 0x026;  // R_Diag_Buf_Ptr1, 2
inline constexpr std::uint16_t kOrgDiagPointerSize = 2;  // bytes
inline constexpr Address kOrgAuxLength = 0x028;  // R_Len_Cntrl_Buf1, 2
inline constexpr std::uint16_t kOrgAuxLengthSize = 2;  // bytes
inline constexpr std::uint8_t kOrgAuxLengthLimit = 244;  // largest value accepted
inline constexpr Address kOrgAuxSelect = 0x02A;  // R_Aux_Buf_Sel
inline constexpr std::uint8_t kOrgAuxSelectPrm = 0x01;  // Set_Prm.
inline constexpr std::uint8_t kOrgAuxSelectCfg = 0x02;  // Chk_Cfg.
inline constexpr std::uint8_t kOrgAuxSelectSsa = 0x04;  // Set_Slave_Address.
inline constexpr Address kOrgAuxPointer = 0x02B;  // R_Aux_Buf_Ptr1, 2
inline constexpr std::uint16_t kOrgAuxPointerSize = 2;  // bytes
inline constexpr Address kOrgSsaLength = 0x02D;  // R_Len_SSA_Data
inline constexpr Address kOrgSsaPointer = 0x02E;  // R_SSA_Buf_Ptr
inline constexpr Address kOrgPrmLength = 0x02F;  // R_Len_Prm_Data
inline constexpr Address kOrgPrmPointer = 0x030;  // R_Prm_Buf_Ptr
inline constexpr Address kOrgCfgLength = 0x031;  // R_Len_Cfg_Data
inline constexpr Address kOrgCfgPointer = 0x032;  // R_Cfg_Buf_Ptr
inline constexpr Address kOrgReadCfgLength = 0x033;  // R_Len_Read_Cfg_Data
inline constexpr Address kOrgReadCfgPointer = 0x034;  // R_Read_Cfg_Buf_Ptr
inline constexpr Address kOrgNoAddressChange = 0x039;  // R_Real_No_Add_Change
inline constexpr Address kOrgIdentLow = 0x03A;  // R_Ident_Low
inline constexpr Address kOrgIdentHigh = 0x03B;  // R_Ident_High
inline constexpr Address kOrgGcCommand = 0x03C;  // R_GC_Command
inline constexpr std::uint8_t kOrgGcCommandClearData = 0x02;  // Clear_Data.
inline constexpr std::uint8_t kOrgGcCommandUnfreeze = 0x04;  // Unfreeze.
inline constexpr std::uint8_t kOrgGcCommandFreeze = 0x08;  // Freeze.
inline constexpr std::uint8_t kOrgGcCommandUnsync = 0x10;  // Unsync.
inline constexpr std::uint8_t kOrgGcCommandSync = 0x20;  // Sync.
inline constexpr Address kOrgSpecPrmLength = 0x03D;  // R_Len_Spec_Prm_Buf
inline constexpr std::uint8_t kOrgSpecPrmLengthLimit = 244;  // largest value accepted

// Buffers
inline constexpr Address kBuffers = 0x040;  // Buffers
inline constexpr std::uint16_t kBuffersSize = 1472;  // bytes
inline constexpr Address kBuffersVpc3 = 0x600;  // Buffers
inline constexpr std::uint16_t kBuffersVpc3Size = 512;  // bytes

// Bits of event
inline constexpr std::uint16_t kEventMacReset = 0x0001;  // MAC_Reset: the chip is OFFLINE now, by Go_Offline or a RAM access violation.
inline constexpr std::uint16_t kEventDataEx = 0x0002;  // Go/Leave_DATA_EX: DATA_EX was entered or left.
inline constexpr std::uint16_t kEventBaudDetect = 0x0004;  // Baudrate_Detect: a baud rate was found.
inline constexpr std::uint16_t kEventWdTimeout = 0x0008;  // WD_DP_CONTROL_Timeout: the watchdog ran out in DP_CONTROL.
inline constexpr std::uint16_t kEventUserTimer = 0x0010;  // User_Timer_Clock: the user's time base has passed (ruling A36).
inline constexpr std::uint16_t kEventReserved5 = 0x0020;  // Reserved.
inline constexpr std::uint16_t kEventReserved6 = 0x0040;  // Reserved.
inline constexpr std::uint16_t kEventReserved7 = 0x0080;  // Reserved.
inline constexpr std::uint16_t kEventNewGc = 0x0100;  // New_GC_Command: a Global_Control is in gc_command (ruling A47).
inline constexpr std::uint16_t kEventNewSsa = 0x0200;  // New_SSA_Data: a Set_Slave_Address is in its buffer.
inline constexpr std::uint16_t kEventNewCfg = 0x0400;  // New_Cfg_Data: a Chk_Cfg is in its buffer. Only the answer clears it (rulings A14, A15).
inline constexpr std::uint16_t kEventNewPrm = 0x0800;  // New_Prm_Data: a Set_Prm is in its buffer. Only the answer clears it (rulings A14, A15).
inline constexpr std::uint16_t kEventDiagChanged = 0x1000;  // Diag_Buffer_Changed: the diagnosis buffers were exchanged.
inline constexpr std::uint16_t kEventDxOut = 0x2000;  // DX_OUT: new or cleared outputs are in N.
inline constexpr std::uint16_t kEventReserved14 = 0x4000;  // Reserved.
inline constexpr std::uint16_t kEventReserved15 = 0x8000;  // Reserved.

// Bits of mode_0
inline constexpr std::uint16_t kMode0DisStart = 0x0001;  // Dis_Start_Control; Set_Prm byte 7 overwrites it (ruling A21).
inline constexpr std::uint16_t kMode0DisStop = 0x0002;  // Dis_Stop_Control; Set_Prm byte 7 overwrites it (ruling A21).
inline constexpr std::uint16_t kMode0Combi = 0x0008;  // Default min_TSDR: 0 for DP alone, 1 for DP and other protocols on one line (ruling A33).
inline constexpr std::uint16_t kMode0IntPol = 0x0010;  // Interrupt output: 0 low-active, 1 high-active.
inline constexpr std::uint16_t kMode0EarlyRdy = 0x0020;  // Ready one clock earlier (ruling A42).
inline constexpr std::uint16_t kMode0SyncSupported = 0x0040;  // Sync is supported.
inline constexpr std::uint16_t kMode0FreezeSupported = 0x0080;  // Freeze is supported.
inline constexpr std::uint16_t kMode0DpMode = 0x0100;  // The DP services are on (ruling A6).
inline constexpr std::uint16_t kMode0EoiTimeBase = 0x0200;  // Inactive time of the interrupt output: 0 1 us, 1 1 ms (ruling A13).
inline constexpr std::uint16_t kMode0UserTimeBase = 0x0400;  // Time base of user_timer: 0 1 ms, 1 10 ms (ruling A36).
inline constexpr std::uint16_t kMode0WdTest = 0x0800;  // Test of the watchdog; never set.
inline constexpr std::uint16_t kMode0SpecPrmBuf = 0x1000;  // Set_Prm goes straight into the Prm buffer (ruling A37).
inline constexpr std::uint16_t kMode0SpecClear = 0x2000;  // Spec_Clear: an empty data telegram clears the outputs (ruling A46).

// Bits of sm
inline constexpr std::uint8_t kSmD = 0x03;  // The chip's buffer, for data transfer.
inline constexpr int kSmDShift = 0;  // lowest bit
inline constexpr std::uint8_t kSmN = 0x0C;  // The next one.
inline constexpr int kSmNShift = 2;  // lowest bit
inline constexpr std::uint8_t kSmU = 0x30;  // The user's.
inline constexpr int kSmUShift = 4;  // lowest bit
inline constexpr std::uint8_t kSmF = 0xC0;  // The free one.
inline constexpr int kSmFShift = 6;  // lowest bit

// Bits of mode_1
inline constexpr std::uint8_t kMode1Start = 0x01;  // Leave OFFLINE.
inline constexpr std::uint8_t kMode1Eoi = 0x02;  // End of interrupt: the output becomes inactive. The chip clears it.
inline constexpr std::uint8_t kMode1GoOffline = 0x04;  // OFFLINE after the request in progress. The chip clears it.
inline constexpr std::uint8_t kMode1UserLeaveMaster = 0x08;  // DP state to WAIT_PRM. The chip clears it.
inline constexpr std::uint8_t kMode1EnChangeCfg = 0x10;  // Cfg ok exchanges the pointers of the Cfg and Read_Cfg buffers (ruling A26).
inline constexpr std::uint8_t kMode1ResUserWd = 0x20;  // The next data telegram loads the user watchdog. Falls with it.

// Bits of verdict
inline constexpr std::uint8_t kVerdictAnswer = 0x03;  // The result.
inline constexpr int kVerdictAnswerShift = 0;  // lowest bit

// Values of dp_state
inline constexpr std::uint8_t kDpStateWaitPrm = 0x00;  // WAIT_PRM
inline constexpr std::uint8_t kDpStateWaitCfg = 0x01;  // WAIT_CFG
inline constexpr std::uint8_t kDpStateDataEx = 0x02;  // DATA_EX

// Values of wd_state
inline constexpr std::uint8_t kWdStateBaudSearch = 0x00;  // BAUD_SEARCH
inline constexpr std::uint8_t kWdStateBaudControl = 0x01;  // BAUD_CONTROL
inline constexpr std::uint8_t kWdStateDpControl = 0x02;  // DP_CONTROL

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
inline constexpr std::uint8_t kBaudNone = 0x0F;  // Reset or OFFLINE.

// Values of buffer
inline constexpr std::uint8_t kBufferNil = 0x00;  // No buffer.
inline constexpr std::uint8_t kBufferFirst = 0x01;  // Buffer 1.
inline constexpr std::uint8_t kBufferSecond = 0x02;  // Buffer 2.
inline constexpr std::uint8_t kBufferThird = 0x03;  // Buffer 3; diagnosis has two.

// Values of diag_owner
inline constexpr std::uint8_t kDiagOwnerNil = 0x00;  // Not owned.
inline constexpr std::uint8_t kDiagOwnerUser = 0x01;  // The user.
inline constexpr std::uint8_t kDiagOwnerChip = 0x02;  // The chip.
inline constexpr std::uint8_t kDiagOwnerSending = 0x03;  // The chip, which is sending it (ruling A19).

// Values of verdict
inline constexpr std::uint8_t kVerdictFinished = 0x00;  // The answer was taken, nothing else waits.
inline constexpr std::uint8_t kVerdictConflict = 0x01;  // A newer telegram came: its bytes are in the buffer now, answer again.
inline constexpr std::uint8_t kVerdictNotAllowed = 0x03;  // Nothing waits for an answer in this state.

// Values of address_change
inline constexpr std::uint8_t kAddressChangeLocked = 0xFF;  // No further Set_Slave_Address is taken.

/// Every address once for reads, and once for writes that are not ignored; ascending.
inline constexpr Cell kMap[] = {
    {0x000, 0x001, true, true, false, "irr"},
    {0x002, 0x003, true, false, false, "ir"},
    {0x002, 0x003, false, true, false, "iar"},
    {0x004, 0x005, true, false, false, "status"},
    {0x004, 0x005, false, true, false, "imr"},
    {0x006, 0x007, true, false, false, "mode_0_read"},
    {0x006, 0x007, false, true, false, "mode_0"},
    {0x008, 0x008, true, false, false, "din_sm"},
    {0x008, 0x008, false, true, false, "mode_1_s"},
    {0x009, 0x009, true, false, true, "new_din"},
    {0x009, 0x009, false, true, false, "mode_1_r"},
    {0x00A, 0x00A, true, false, false, "dout_sm"},
    {0x00A, 0x00A, false, true, false, "wd_baud_control"},
    {0x00B, 0x00B, true, false, true, "next_dout"},
    {0x00B, 0x00B, false, true, false, "min_tsdr"},
    {0x00C, 0x00C, true, false, false, "diag_sm"},
    {0x00C, 0x00C, false, true, false, "mode_2"},
    {0x00D, 0x00D, true, false, true, "new_diag"},
    {0x00E, 0x00E, true, false, true, "prm_ok"},
    {0x00F, 0x00F, true, false, true, "prm_not_ok"},
    {0x010, 0x010, true, false, true, "cfg_ok"},
    {0x011, 0x011, true, false, true, "cfg_not_ok"},
    {0x012, 0x012, true, false, false, "reserved_012"},
    {0x012, 0x012, false, true, false, "mode_3"},
    {0x013, 0x013, true, false, false, "reserved_013"},
    {0x014, 0x014, true, false, true, "ssa_free"},
    {0x015, 0x015, true, false, false, "mode_1_read"},
    {0x016, 0x016, true, true, false, "org.address"},
    {0x017, 0x017, true, true, false, "org.sap_pointer"},
    {0x018, 0x019, true, true, false, "org.user_wd"},
    {0x01A, 0x01A, true, true, false, "org.dout_length"},
    {0x01B, 0x01D, true, true, false, "org.dout_pointer"},
    {0x01E, 0x01E, true, true, false, "org.din_length"},
    {0x01F, 0x021, true, true, false, "org.din_pointer"},
    {0x022, 0x023, true, true, false, "org.reserved_022"},
    {0x024, 0x025, true, true, false, "org.diag_length"},
    {0x026, 0x027, true, true, false, "org.diag_pointer"},
    {0x028, 0x029, true, true, false, "org.aux_length"},
    {0x02A, 0x02A, true, true, false, "org.aux_select"},
    {0x02B, 0x02C, true, true, false, "org.aux_pointer"},
    {0x02D, 0x02D, true, true, false, "org.ssa_length"},
    {0x02E, 0x02E, true, true, false, "org.ssa_pointer"},
    {0x02F, 0x02F, true, true, false, "org.prm_length"},
    {0x030, 0x030, true, true, false, "org.prm_pointer"},
    {0x031, 0x031, true, true, false, "org.cfg_length"},
    {0x032, 0x032, true, true, false, "org.cfg_pointer"},
    {0x033, 0x033, true, true, false, "org.read_cfg_length"},
    {0x034, 0x034, true, true, false, "org.read_cfg_pointer"},
    {0x035, 0x038, true, true, false, "org.reserved_035"},
    {0x039, 0x039, true, true, false, "org.no_address_change"},
    {0x03A, 0x03A, true, true, false, "org.ident_low"},
    {0x03B, 0x03B, true, true, false, "org.ident_high"},
    {0x03C, 0x03C, true, true, false, "org.gc_command"},
    {0x03D, 0x03D, true, true, false, "org.spec_prm_length"},
    {0x03E, 0x03F, true, true, false, "org.reserved_03e"},
    {0x040, 0x5FF, true, true, false, "buffers"},
    {0x600, 0x7FF, true, true, false, "buffers_vpc3"},
};

}  // namespace dsdpv1::spc3::regs
// clang-format on
