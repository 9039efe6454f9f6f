/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Generated from registers/spc3.rdl by registers/generate.py. Do not edit. */
/* Addresses, bits and values of the SPC3 family. A word is at its low byte, the high byte follows. */
#ifndef SPC3_REGS_H
#define SPC3_REGS_H
/* clang-format off */

// SPC3 family
#define SPC3_REG_RAM_SIZE 1536U  // bytes

// Registers
#define SPC3_REG_IRR 0x000U  // Interrupt request register
#define SPC3_REG_IR 0x002U  // Interrupt register
#define SPC3_REG_IAR 0x002U  // Interrupt acknowledge register
#define SPC3_REG_STATUS 0x004U  // Status register
#define SPC3_REG_STATUS_RESET 0x0F00U  // value after reset
#define SPC3_REG_STATUS_PASSIVE_IDLE 0x0001U  // 0 OFFLINE, 1 PASSIVE_IDLE.
#define SPC3_REG_STATUS_DIAG_FLAG 0x0004U  // The master has not fetched the diagnosis yet.
#define SPC3_REG_STATUS_RAM_VIOLATION 0x0008U  // Access beyond the RAM, by the user or by a pointer (ruling A3).
#define SPC3_REG_STATUS_DP_STATE 0x0030U  // State of the DP slave.
#define SPC3_REG_STATUS_DP_STATE_SHIFT 4U  // lowest bit
#define SPC3_REG_STATUS_WD_STATE 0x00C0U  // State of the watchdog.
#define SPC3_REG_STATUS_WD_STATE_SHIFT 6U  // lowest bit
#define SPC3_REG_STATUS_BAUD_RATE 0x0F00U  // Baud rate that is tried or was found (ruling A8).
#define SPC3_REG_STATUS_BAUD_RATE_SHIFT 8U  // lowest bit
#define SPC3_REG_STATUS_TYPE_CODE 0xF000U  // 0; vpc3 its type, B, C or E.
#define SPC3_REG_STATUS_TYPE_CODE_SHIFT 12U  // lowest bit
#define SPC3_REG_IMR 0x004U  // Interrupt mask register
#define SPC3_REG_IMR_RESET 0xFFFFU  // value after reset
#define SPC3_REG_MODE_0_READ 0x006U  // Mode register 0, read
#define SPC3_REG_MODE_0 0x006U  // Mode register 0
#define SPC3_REG_DIN_SM 0x008U  // Owners of the input buffers
#define SPC3_REG_DIN_SM_RESET 0xE1U  // value after reset
#define SPC3_REG_MODE_1_S 0x008U  // Mode register 1, set
#define SPC3_REG_NEW_DIN 0x009U  // New_Din_Buffer_Cmd
#define SPC3_REG_NEW_DIN_U 0x03U  // The user's new one.
#define SPC3_REG_NEW_DIN_U_SHIFT 0U  // lowest bit
#define SPC3_REG_MODE_1_R 0x009U  // Mode register 1, reset
#define SPC3_REG_DOUT_SM 0x00AU  // Owners of the output buffers
#define SPC3_REG_DOUT_SM_RESET 0xE1U  // value after reset
#define SPC3_REG_WD_BAUD_CONTROL 0x00AU  // WD_BAUD_CONTROL_Val
#define SPC3_REG_WD_BAUD_CONTROL_RESET 0x1EU  // value after reset
#define SPC3_REG_NEXT_DOUT 0x00BU  // Next_Dout_Buffer_Cmd
#define SPC3_REG_NEXT_DOUT_U 0x03U  // The user's buffer now.
#define SPC3_REG_NEXT_DOUT_U_SHIFT 0U  // lowest bit
#define SPC3_REG_NEXT_DOUT_FRESH 0x04U  // It is a new one.
#define SPC3_REG_NEXT_DOUT_CLEARED 0x08U  // It was cleared by the chip.
#define SPC3_REG_MIN_TSDR 0x00BU  // MinTSDR_Val
#define SPC3_REG_MIN_TSDR_RESET 0x0BU  // value after reset
#define SPC3_REG_DIAG_SM 0x00CU  // Owners of the diagnosis buffers
#define SPC3_REG_DIAG_SM_RESET 0x09U  // value after reset
#define SPC3_REG_DIAG_SM_FIRST 0x03U  // Owner of buffer 1.
#define SPC3_REG_DIAG_SM_FIRST_SHIFT 0U  // lowest bit
#define SPC3_REG_DIAG_SM_SECOND 0x0CU  // Owner of buffer 2.
#define SPC3_REG_DIAG_SM_SECOND_SHIFT 2U  // lowest bit
#define SPC3_REG_MODE_2 0x00CU  // Mode register 2
#define SPC3_REG_MODE_2_RESET 0x01U  // value after reset
#define SPC3_REG_MODE_2_GC_EACH 0x01U  // New_GC_Command at every Global_Control (ruling A47).
#define SPC3_REG_MODE_2_NO_GC_CHECK 0x02U  // The reserved bits of Global_Control are not checked.
#define SPC3_REG_MODE_2_DX_OUT_ALWAYS 0x04U  // DX_OUT also without outputs (ruling A48).
#define SPC3_REG_MODE_2_NO_PRM_CHECK 0x40U  // The reserved bits of Set_Prm are not checked (ruling A21).
#define SPC3_REG_MODE_2_RAM_4K 0x80U  // 4 KB of RAM, in segments of 16 bytes.
#define SPC3_REG_NEW_DIAG 0x00DU  // New_Diag_Buffer_Cmd
#define SPC3_REG_NEW_DIAG_U 0x03U  // The user's new buffer, 0 if there is none yet.
#define SPC3_REG_NEW_DIAG_U_SHIFT 0U  // lowest bit
#define SPC3_REG_PRM_OK 0x00EU  // User_Prm_Data_Okay
#define SPC3_REG_PRM_NOT_OK 0x00FU  // User_Prm_Data_Not_Okay
#define SPC3_REG_CFG_OK 0x010U  // User_Cfg_Data_Okay
#define SPC3_REG_CFG_NOT_OK 0x011U  // User_Cfg_Data_Not_Okay
#define SPC3_REG_MODE_3 0x012U  // Mode register 3
#define SPC3_REG_SSA_FREE 0x014U  // SSA_Buffer_Free_Cmd
#define SPC3_REG_MODE_1_READ 0x015U  // Mode register 1, read

// Organisation
#define SPC3_REG_ORG 0x016U  // first byte
#define SPC3_REG_ORG_SIZE 42U  // bytes
#define SPC3_REG_ORG_ADDRESS 0x016U  // R_TS_Adr
#define SPC3_REG_ORG_ADDRESS_LIMIT 126U  // largest value accepted
#define SPC3_REG_ORG_SAP_POINTER 0x017U  // Pointer to a RAM address
#define SPC3_REG_ORG_USER_WD 0x018U  // R_User_Wd_Value
#define SPC3_REG_ORG_DOUT_LENGTH 0x01AU  // R_Len_Dout_Buf
#define SPC3_REG_ORG_DOUT_LENGTH_LIMIT 244U  // largest value accepted
#define SPC3_REG_ORG_DOUT_POINTER 0x01BU  // R_Dout_Buf_Ptr1 to 3
#define SPC3_REG_ORG_DOUT_POINTER_SIZE 3U  // bytes
#define SPC3_REG_ORG_DIN_LENGTH 0x01EU  // R_Len_Din_Buf
#define SPC3_REG_ORG_DIN_LENGTH_LIMIT 244U  // largest value accepted
#define SPC3_REG_ORG_DIN_POINTER 0x01FU  // R_Din_Buf_Ptr1 to 3
#define SPC3_REG_ORG_DIN_POINTER_SIZE 3U  // bytes
#define SPC3_REG_ORG_DIAG_LENGTH 0x024U  // R_Len_Diag_Buf1, 2
#define SPC3_REG_ORG_DIAG_LENGTH_SIZE 2U  // bytes
#define SPC3_REG_ORG_DIAG_LENGTH_LIMIT 244U  // largest value accepted
#define SPC3_REG_ORG_DIAG_POINTER 0x026U  // R_Diag_Buf_Ptr1, 2
#define SPC3_REG_ORG_DIAG_POINTER_SIZE 2U  // bytes
#define SPC3_REG_ORG_AUX_LENGTH 0x028U  // R_Len_Cntrl_Buf1, 2
#define SPC3_REG_ORG_AUX_LENGTH_SIZE 2U  // bytes
#define SPC3_REG_ORG_AUX_LENGTH_LIMIT 244U  // largest value accepted
#define SPC3_REG_ORG_AUX_SELECT 0x02AU  // R_Aux_Buf_Sel
#define SPC3_REG_ORG_AUX_SELECT_PRM 0x01U  // Set_Prm.
#define SPC3_REG_ORG_AUX_SELECT_CFG 0x02U  // Chk_Cfg.
#define SPC3_REG_ORG_AUX_SELECT_SSA 0x04U  // Set_Slave_Address.
#define SPC3_REG_ORG_AUX_POINTER 0x02BU  // R_Aux_Buf_Ptr1, 2
#define SPC3_REG_ORG_AUX_POINTER_SIZE 2U  // bytes
#define SPC3_REG_ORG_SSA_LENGTH 0x02DU  // R_Len_SSA_Data
#define SPC3_REG_ORG_SSA_POINTER 0x02EU  // R_SSA_Buf_Ptr
#define SPC3_REG_ORG_PRM_LENGTH 0x02FU  // R_Len_Prm_Data
#define SPC3_REG_ORG_PRM_POINTER 0x030U  // R_Prm_Buf_Ptr
#define SPC3_REG_ORG_CFG_LENGTH 0x031U  // R_Len_Cfg_Data
#define SPC3_REG_ORG_CFG_POINTER 0x032U  // R_Cfg_Buf_Ptr
#define SPC3_REG_ORG_READ_CFG_LENGTH 0x033U  // R_Len_Read_Cfg_Data
#define SPC3_REG_ORG_READ_CFG_POINTER 0x034U  // R_Read_Cfg_Buf_Ptr
#define SPC3_REG_ORG_NO_ADDRESS_CHANGE 0x039U  // R_Real_No_Add_Change
#define SPC3_REG_ORG_IDENT_LOW 0x03AU  // R_Ident_Low
#define SPC3_REG_ORG_IDENT_HIGH 0x03BU  // R_Ident_High
#define SPC3_REG_ORG_GC_COMMAND 0x03CU  // R_GC_Command
#define SPC3_REG_ORG_GC_COMMAND_CLEAR_DATA 0x02U  // Clear_Data.
#define SPC3_REG_ORG_GC_COMMAND_UNFREEZE 0x04U  // Unfreeze.
#define SPC3_REG_ORG_GC_COMMAND_FREEZE 0x08U  // Freeze.
#define SPC3_REG_ORG_GC_COMMAND_UNSYNC 0x10U  // Unsync.
#define SPC3_REG_ORG_GC_COMMAND_SYNC 0x20U  // Sync.
#define SPC3_REG_ORG_SPEC_PRM_LENGTH 0x03DU  // R_Len_Spec_Prm_Buf
#define SPC3_REG_ORG_SPEC_PRM_LENGTH_LIMIT 244U  // largest value accepted

// Buffers
#define SPC3_REG_BUFFERS 0x040U  // Buffers
#define SPC3_REG_BUFFERS_SIZE 1472U  // bytes
#define SPC3_REG_BUFFERS_VPC3 0x600U  // Buffers
#define SPC3_REG_BUFFERS_VPC3_SIZE 512U  // bytes

// Bits of event
#define SPC3_REG_EVENT_MAC_RESET 0x0001U  // MAC_Reset: the chip is OFFLINE now, by Go_Offline or a RAM access violation.
#define SPC3_REG_EVENT_DATA_EX 0x0002U  // Go/Leave_DATA_EX: DATA_EX was entered or left.
#define SPC3_REG_EVENT_BAUD_DETECT 0x0004U  // Baudrate_Detect: a baud rate was found.
#define SPC3_REG_EVENT_WD_TIMEOUT 0x0008U  // WD_DP_CONTROL_Timeout: the watchdog ran out in DP_CONTROL.
#define SPC3_REG_EVENT_USER_TIMER 0x0010U  // User_Timer_Clock: the user's time base has passed (ruling A36).
#define SPC3_REG_EVENT_RESERVED_5 0x0020U  // Reserved.
#define SPC3_REG_EVENT_RESERVED_6 0x0040U  // Reserved.
#define SPC3_REG_EVENT_RESERVED_7 0x0080U  // Reserved.
#define SPC3_REG_EVENT_NEW_GC 0x0100U  // New_GC_Command: a Global_Control is in gc_command (ruling A47).
#define SPC3_REG_EVENT_NEW_SSA 0x0200U  // New_SSA_Data: a Set_Slave_Address is in its buffer.
#define SPC3_REG_EVENT_NEW_CFG 0x0400U  // New_Cfg_Data: a Chk_Cfg is in its buffer. Only the answer clears it (rulings A14, A15).
#define SPC3_REG_EVENT_NEW_PRM 0x0800U  // New_Prm_Data: a Set_Prm is in its buffer. Only the answer clears it (rulings A14, A15).
#define SPC3_REG_EVENT_DIAG_CHANGED 0x1000U  // Diag_Buffer_Changed: the diagnosis buffers were exchanged.
#define SPC3_REG_EVENT_DX_OUT 0x2000U  // DX_OUT: new or cleared outputs are in N.
#define SPC3_REG_EVENT_RESERVED_14 0x4000U  // Reserved.
#define SPC3_REG_EVENT_RESERVED_15 0x8000U  // Reserved.

// Bits of mode_0
#define SPC3_REG_MODE_0_DIS_START 0x0001U  // Dis_Start_Control; Set_Prm byte 7 overwrites it (ruling A21).
#define SPC3_REG_MODE_0_DIS_STOP 0x0002U  // Dis_Stop_Control; Set_Prm byte 7 overwrites it (ruling A21).
#define SPC3_REG_MODE_0_COMBI 0x0008U  // Default min_TSDR: 0 for DP alone, 1 for DP and other protocols on one line (ruling A33).
#define SPC3_REG_MODE_0_INT_POL 0x0010U  // Interrupt output: 0 low-active, 1 high-active.
#define SPC3_REG_MODE_0_EARLY_RDY 0x0020U  // Ready one clock earlier (ruling A42).
#define SPC3_REG_MODE_0_SYNC_SUPPORTED 0x0040U  // Sync is supported.
#define SPC3_REG_MODE_0_FREEZE_SUPPORTED 0x0080U  // Freeze is supported.
#define SPC3_REG_MODE_0_DP_MODE 0x0100U  // The DP services are on (ruling A6).
#define SPC3_REG_MODE_0_EOI_TIME_BASE 0x0200U  // Inactive time of the interrupt output: 0 1 us, 1 1 ms (ruling A13).
#define SPC3_REG_MODE_0_USER_TIME_BASE 0x0400U  // Time base of user_timer: 0 1 ms, 1 10 ms (ruling A36).
#define SPC3_REG_MODE_0_WD_TEST 0x0800U  // Test of the watchdog; never set.
#define SPC3_REG_MODE_0_SPEC_PRM_BUF 0x1000U  // Set_Prm goes straight into the Prm buffer (ruling A37).
#define SPC3_REG_MODE_0_SPEC_CLEAR 0x2000U  // Spec_Clear: an empty data telegram clears the outputs (ruling A46).

// Bits of sm
#define SPC3_REG_SM_D 0x03U  // The chip's buffer, for data transfer.
#define SPC3_REG_SM_D_SHIFT 0U  // lowest bit
#define SPC3_REG_SM_N 0x0CU  // The next one.
#define SPC3_REG_SM_N_SHIFT 2U  // lowest bit
#define SPC3_REG_SM_U 0x30U  // The user's.
#define SPC3_REG_SM_U_SHIFT 4U  // lowest bit
#define SPC3_REG_SM_F 0xC0U  // The free one.
#define SPC3_REG_SM_F_SHIFT 6U  // lowest bit

// Bits of mode_1
#define SPC3_REG_MODE_1_START 0x01U  // Leave OFFLINE.
#define SPC3_REG_MODE_1_EOI 0x02U  // End of interrupt: the output becomes inactive. The chip clears it.
#define SPC3_REG_MODE_1_GO_OFFLINE 0x04U  // OFFLINE after the request in progress. The chip clears it.
#define SPC3_REG_MODE_1_USER_LEAVE_MASTER 0x08U  // DP state to WAIT_PRM. The chip clears it.
#define SPC3_REG_MODE_1_EN_CHANGE_CFG 0x10U  // Cfg ok exchanges the pointers of the Cfg and Read_Cfg buffers (ruling A26).
#define SPC3_REG_MODE_1_RES_USER_WD 0x20U  // The next data telegram loads the user watchdog. Falls with it.

// Bits of verdict
#define SPC3_REG_VERDICT_ANSWER 0x03U  // The result.
#define SPC3_REG_VERDICT_ANSWER_SHIFT 0U  // lowest bit

// Values of dp_state
#define SPC3_REG_DP_STATE_WAIT_PRM 0x00U  // WAIT_PRM
#define SPC3_REG_DP_STATE_WAIT_CFG 0x01U  // WAIT_CFG
#define SPC3_REG_DP_STATE_DATA_EX 0x02U  // DATA_EX

// Values of wd_state
#define SPC3_REG_WD_STATE_BAUD_SEARCH 0x00U  // BAUD_SEARCH
#define SPC3_REG_WD_STATE_BAUD_CONTROL 0x01U  // BAUD_CONTROL
#define SPC3_REG_WD_STATE_DP_CONTROL 0x02U  // DP_CONTROL

// Values of baud
#define SPC3_REG_BAUD_RATE_12M 0x00U  // 12 Mbit/s
#define SPC3_REG_BAUD_RATE_6M 0x01U  // 6 Mbit/s
#define SPC3_REG_BAUD_RATE_3M 0x02U  // 3 Mbit/s
#define SPC3_REG_BAUD_RATE_1M5 0x03U  // 1.5 Mbit/s
#define SPC3_REG_BAUD_RATE_500K 0x04U  // 500 kbit/s
#define SPC3_REG_BAUD_RATE_187K5 0x05U  // 187.5 kbit/s
#define SPC3_REG_BAUD_RATE_93K75 0x06U  // 93.75 kbit/s
#define SPC3_REG_BAUD_RATE_45K45 0x07U  // 45.45 kbit/s
#define SPC3_REG_BAUD_RATE_19K2 0x08U  // 19.2 kbit/s
#define SPC3_REG_BAUD_RATE_9K6 0x09U  // 9.6 kbit/s
#define SPC3_REG_BAUD_NONE 0x0FU  // Reset or OFFLINE.

// Values of buffer
#define SPC3_REG_BUFFER_NIL 0x00U  // No buffer.
#define SPC3_REG_BUFFER_FIRST 0x01U  // Buffer 1.
#define SPC3_REG_BUFFER_SECOND 0x02U  // Buffer 2.
#define SPC3_REG_BUFFER_THIRD 0x03U  // Buffer 3; diagnosis has two.

// Values of diag_owner
#define SPC3_REG_DIAG_OWNER_NIL 0x00U  // Not owned.
#define SPC3_REG_DIAG_OWNER_USER 0x01U  // The user.
#define SPC3_REG_DIAG_OWNER_CHIP 0x02U  // The chip.
#define SPC3_REG_DIAG_OWNER_SENDING 0x03U  // The chip, which is sending it (ruling A19).

// Values of verdict
#define SPC3_REG_VERDICT_FINISHED 0x00U  // The answer was taken, nothing else waits.
#define SPC3_REG_VERDICT_CONFLICT 0x01U  // A newer telegram came: its bytes are in the buffer now, answer again.
#define SPC3_REG_VERDICT_NOT_ALLOWED 0x03U  // Nothing waits for an answer in this state.

// Values of address_change
#define SPC3_REG_ADDRESS_CHANGE_LOCKED 0xFFU  // No further Set_Slave_Address is taken.

#endif
