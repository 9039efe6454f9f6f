/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Generated from registers/dsdpv1.rdl by registers/generate.py. Do not edit. */
/* Addresses, bits and values of the DPRAM. A word (CRC, count) is at its high byte, the low byte follows. */
#ifndef DSDPV1_REGS_H
#define DSDPV1_REGS_H
/* clang-format off */

// DPRAM
#define DSDPV1_REG_DPRAM_SIZE 2048U  // bytes

// Status and command bytes
#define DSDPV1_REG_VERSION 0x000U  // Version code
#define DSDPV1_REG_VERSION_RESET 0x01U  // value after reset
#define DSDPV1_REG_VERSION_YEAR 0x001U  // Version, year
#define DSDPV1_REG_VERSION_YEAR_RESET 0x0DU  // value after reset
#define DSDPV1_REG_VERSION_MONTH 0x002U  // Version, month
#define DSDPV1_REG_VERSION_MONTH_RESET 0x07U  // value after reset
#define DSDPV1_REG_VERSION_DAY 0x003U  // Version, day
#define DSDPV1_REG_VERSION_DAY_RESET 0x01U  // value after reset
#define DSDPV1_REG_VALID_FLAG 0x004U  // Valid flag
#define DSDPV1_REG_DPV1_ENABLE 0x005U  // DPV1 enable
#define DSDPV1_REG_ACCESS_COUNT 0x006U  // DPRAM access count
#define DSDPV1_REG_OFFLINE_COUNT 0x008U  // Count of leaving data exchange
#define DSDPV1_REG_CHIP_STATUS_1 0x00AU  // Chip status byte 1
#define DSDPV1_REG_CHIP_STATUS_1_INITIALISED 0x01U  // The initialisation succeeded; the user may clear it afterwards (ruling D7).
#define DSDPV1_REG_CHIP_STATUS_2 0x00BU  // Chip status byte 2
#define DSDPV1_REG_CHIP_STATUS_2_INIT_CRC 0x01U  // Initialisation data, CRC wrong.
#define DSDPV1_REG_CHIP_STATUS_2_V1_INIT_CRC 0x02U  // V1 initialisation, CRC wrong; the chip never sets it (ruling R5).
#define DSDPV1_REG_CHIP_STATUS_2_INPUT_CRC 0x04U  // Input data, CRC wrong.
#define DSDPV1_REG_CHIP_STATUS_2_DIAG_CRC 0x08U  // Diagnosis data, CRC wrong.
#define DSDPV1_REG_CHIP_STATUS_2_C1_CRC 0x10U  // C1 answer, CRC wrong.
#define DSDPV1_REG_CHIP_STATUS_2_C2_CRC 0x20U  // C2 answer, CRC wrong.
#define DSDPV1_REG_USER_STATUS_1 0x00CU  // User status byte 1
#define DSDPV1_REG_USER_STATUS_1_PRM_WRONG 0x01U  // The user judges the parameters wrong; counts with B010.7 (ruling D4).
#define DSDPV1_REG_USER_STATUS_1_CFG_WRONG 0x02U  // The user judges the configuration wrong; counts with B010.6 (ruling D4).
#define DSDPV1_REG_USER_STATUS_2 0x00DU  // User status byte 2
#define DSDPV1_REG_USER_STATUS_2_CFG_CRC 0x01U  // Configuration data, CRC wrong.
#define DSDPV1_REG_USER_STATUS_2_PRM_CRC 0x02U  // Parameter data, CRC wrong.
#define DSDPV1_REG_USER_STATUS_2_OUTPUT_CRC 0x04U  // Output data, CRC wrong.
#define DSDPV1_REG_USER_STATUS_2_C2_CRC 0x08U  // C2 request, CRC wrong.
#define DSDPV1_REG_USER_STATUS_2_C1_CRC 0x10U  // C1 request, CRC wrong.
#define DSDPV1_REG_CHIP_COMMAND_1 0x00EU  // Chip command byte 1
#define DSDPV1_REG_CHIP_COMMAND_1_OUTPUT 0x01U  // Output data valid.
#define DSDPV1_REG_CHIP_COMMAND_1_PRM 0x02U  // Parameter data valid.
#define DSDPV1_REG_CHIP_COMMAND_1_CFG 0x04U  // Configuration data valid.
#define DSDPV1_REG_CHIP_COMMAND_2 0x00FU  // Chip command byte 2
#define DSDPV1_REG_CHIP_COMMAND_2_C1 0x01U  // C1 request valid.
#define DSDPV1_REG_CHIP_COMMAND_2_C2 0x02U  // C2 request valid.
#define DSDPV1_REG_USER_COMMAND_1 0x010U  // User command byte 1
#define DSDPV1_REG_USER_COMMAND_1_INPUT 0x01U  // Input data valid.
#define DSDPV1_REG_USER_COMMAND_1_DIAG 0x02U  // Diagnosis data valid.
#define DSDPV1_REG_USER_COMMAND_1_INIT 0x04U  // Initialisation data valid.
#define DSDPV1_REG_USER_COMMAND_1_CFG_VERDICT 0x40U  // Verdict on the configuration valid, see B00C.1 (ruling D4).
#define DSDPV1_REG_USER_COMMAND_1_PRM_VERDICT 0x80U  // Verdict on the parameters valid, see B00C.0 (ruling D4).
#define DSDPV1_REG_USER_COMMAND_2 0x011U  // User command byte 2
#define DSDPV1_REG_USER_COMMAND_2_C1 0x01U  // C1 answer valid.
#define DSDPV1_REG_USER_COMMAND_2_C2 0x02U  // C2 answer valid.
#define DSDPV1_REG_USER_COMMAND_2_INPUT_HISTORY 0x40U  // 1: B00B.2 shows the history of the inputs' CRC, a right block does not clear it; 0: the present. The user sets and clears it, the chip only reads it (ruling D16).
#define DSDPV1_REG_USER_COMMAND_2_INPUT_CLEAR 0x80U  // Asks the chip to clear B00B.2, which it does once when B011.6 is 1; it sets this bit back to 0 whatever B011.6 is (ruling D16).
#define DSDPV1_REG_CHIP_STATUS_3 0x012U  // Chip status byte 3
#define DSDPV1_REG_CHIP_STATUS_3_DP_STATE 0x0CU  // State of the DP slave.
#define DSDPV1_REG_CHIP_STATUS_3_DP_STATE_SHIFT 2U  // lowest bit
#define DSDPV1_REG_CHIP_STATUS_3_BAUD_RATE 0xF0U  // Baud rate.
#define DSDPV1_REG_CHIP_STATUS_3_BAUD_RATE_SHIFT 4U  // lowest bit
#define DSDPV1_REG_CHIP_STATUS_4 0x013U  // Chip status byte 4
#define DSDPV1_REG_CHIP_STATUS_4_INIT_LIMIT 0x01U  // A length or the address of the initialisation is out of its limits (ruling D7).
#define DSDPV1_REG_CHIP_STATUS_4_C2_LIMIT 0x02U  // Number of C2 channels over its limit; always 0 (ruling R5).
#define DSDPV1_REG_CHIP_STATUS_4_SLOT_LIMIT 0x04U  // Number of slots and indices over its limit; always 0 (ruling R5).
#define DSDPV1_REG_OWNERSHIP 0x014U  // Ownership
#define DSDPV1_REG_OWNERSHIP_CHIP 0x01U  // The chip is in an access.
#define DSDPV1_REG_OWNERSHIP_HOST 0x02U  // The host is in an access.
#define DSDPV1_REG_U_TIMER 0x015U  // U_Timer
#define DSDPV1_REG_U_TIMER_ENABLE 0x01U  // Enabled: the ownership ends automatically.
#define DSDPV1_REG_UART_INTERVAL 0x019U  // Interval between characters
#define DSDPV1_REG_UART_TSDR 0x01AU  // TSDR

// Initialisation data
#define DSDPV1_REG_INIT 0x020U  // first byte
#define DSDPV1_REG_INIT_SIZE 215U  // bytes, without the CRC
#define DSDPV1_REG_INIT_LENGTH 0x020U  // Length
#define DSDPV1_REG_INIT_ADDRESS 0x021U  // Station address
#define DSDPV1_REG_INIT_ADDRESS_LIMIT 126U  // largest value accepted
#define DSDPV1_REG_INIT_IDENT_HIGH 0x022U  // Ident number, high byte
#define DSDPV1_REG_INIT_IDENT_LOW 0x023U  // Ident number, low byte
#define DSDPV1_REG_INIT_COMMAND 0x024U  // Initialisation command byte
#define DSDPV1_REG_INIT_COMMAND_ADDRESS_CHANGE 0x01U  // Set_Slave_Address is supported.
#define DSDPV1_REG_INIT_COMMAND_FREEZE 0x02U  // Freeze is supported.
#define DSDPV1_REG_INIT_COMMAND_SYNC 0x04U  // Sync is supported.
#define DSDPV1_REG_INIT_COMMAND_FAIL_SAFE 0x08U  // Fail-safe mode is supported.
#define DSDPV1_REG_INIT_MAX_INPUT 0x027U  // Largest input data length
#define DSDPV1_REG_INIT_MAX_INPUT_LIMIT 244U  // largest value accepted
#define DSDPV1_REG_INIT_MAX_OUTPUT 0x028U  // Largest output data length
#define DSDPV1_REG_INIT_MAX_OUTPUT_LIMIT 244U  // largest value accepted
#define DSDPV1_REG_INIT_MAX_DIAG 0x029U  // User diagnosis length
#define DSDPV1_REG_INIT_MAX_DIAG_LIMIT 238U  // largest value accepted
#define DSDPV1_REG_INIT_MAX_PRM 0x02AU  // Largest user parameter length
#define DSDPV1_REG_INIT_MAX_PRM_LIMIT 237U  // largest value accepted
#define DSDPV1_REG_PRM_MODE 0x02BU  // Judging mode of the user parameters
#define DSDPV1_REG_INIT_MAX_CFG 0x02CU  // Largest configuration length
#define DSDPV1_REG_INIT_MAX_CFG_LIMIT 200U  // largest value accepted
#define DSDPV1_REG_CFG_MODE 0x02DU  // Judging mode of the configuration
#define DSDPV1_REG_INIT_CFG_LENGTH 0x02EU  // Configuration length
#define DSDPV1_REG_INIT_CFG_LENGTH_LIMIT 200U  // largest value accepted
#define DSDPV1_REG_INIT_CFG 0x02FU  // Configuration bytes
#define DSDPV1_REG_INIT_CFG_SIZE 200U  // bytes
#define DSDPV1_REG_INIT_CRC 0x0F7U  // CRC

// Input data
#define DSDPV1_REG_INPUT 0x130U  // first byte
#define DSDPV1_REG_INPUT_SIZE 245U  // bytes, without the CRC
#define DSDPV1_REG_INPUT_LENGTH 0x130U  // Length
#define DSDPV1_REG_INPUT_DATA 0x131U  // Input bytes
#define DSDPV1_REG_INPUT_DATA_SIZE 244U  // bytes
#define DSDPV1_REG_INPUT_CRC 0x225U  // CRC

// Diagnosis data
#define DSDPV1_REG_DIAG 0x227U  // first byte
#define DSDPV1_REG_DIAG_SIZE 240U  // bytes, without the CRC
#define DSDPV1_REG_DIAG_TYPE 0x227U  // Type of diagnosis
#define DSDPV1_REG_DIAG_LENGTH 0x228U  // Length
#define DSDPV1_REG_DIAG_DATA 0x229U  // Diagnosis bytes
#define DSDPV1_REG_DIAG_DATA_SIZE 238U  // bytes
#define DSDPV1_REG_DIAG_CRC 0x317U  // CRC

// Output data
#define DSDPV1_REG_OUTPUT 0x319U  // first byte
#define DSDPV1_REG_OUTPUT_SIZE 245U  // bytes, without the CRC
#define DSDPV1_REG_OUTPUT_LENGTH 0x319U  // Length
#define DSDPV1_REG_OUTPUT_DATA 0x31AU  // Output bytes
#define DSDPV1_REG_OUTPUT_DATA_SIZE 244U  // bytes
#define DSDPV1_REG_OUTPUT_CRC 0x40EU  // CRC

// User parameters
#define DSDPV1_REG_PRM 0x410U  // first byte
#define DSDPV1_REG_PRM_SIZE 238U  // bytes, without the CRC
#define DSDPV1_REG_PRM_LENGTH 0x410U  // Length
#define DSDPV1_REG_PRM_DATA 0x411U  // User parameter bytes
#define DSDPV1_REG_PRM_DATA_SIZE 237U  // bytes
#define DSDPV1_REG_PRM_CRC 0x4FEU  // CRC

// Configuration
#define DSDPV1_REG_CFG 0x500U  // first byte
#define DSDPV1_REG_CFG_SIZE 203U  // bytes, without the CRC
#define DSDPV1_REG_CFG_OUTPUT_LENGTH 0x500U  // Output data length
#define DSDPV1_REG_CFG_INPUT_LENGTH 0x501U  // Input data length
#define DSDPV1_REG_CFG_LENGTH 0x502U  // Length
#define DSDPV1_REG_CFG_DATA 0x503U  // Configuration bytes
#define DSDPV1_REG_CFG_DATA_SIZE 200U  // bytes
#define DSDPV1_REG_CFG_CRC 0x5CBU  // CRC

// Non-cyclic data, class 1
#define DSDPV1_REG_C1 0x5D0U  // first byte
#define DSDPV1_REG_C1_SIZE 244U  // bytes, without the CRC
#define DSDPV1_REG_C1_FUNCTION_NUM 0x5D0U  // Function_Num
#define DSDPV1_REG_C1_SLOT 0x5D1U  // Slot number or Error_Decode
#define DSDPV1_REG_C1_INDEX 0x5D2U  // Index or Error_Code_1
#define DSDPV1_REG_C1_LENGTH 0x5D3U  // Data length or Error_Code_2
#define DSDPV1_REG_C1_DATA 0x5D4U  // Data
#define DSDPV1_REG_C1_DATA_SIZE 240U  // bytes
#define DSDPV1_REG_C1_CRC 0x6C4U  // CRC

// Non-cyclic data, class 2
#define DSDPV1_REG_C2 0x6D0U  // first byte
#define DSDPV1_REG_C2_SIZE 244U  // bytes, without the CRC
#define DSDPV1_REG_C2_FUNCTION_NUM 0x6D0U  // Function_Num
#define DSDPV1_REG_C2_SLOT 0x6D1U  // Slot number or Error_Decode
#define DSDPV1_REG_C2_INDEX 0x6D2U  // Index or Error_Code_1
#define DSDPV1_REG_C2_LENGTH 0x6D3U  // Data length or Error_Code_2
#define DSDPV1_REG_C2_DATA 0x6D4U  // Data
#define DSDPV1_REG_C2_DATA_SIZE 240U  // bytes
#define DSDPV1_REG_C2_CRC 0x7C4U  // CRC

// Values of valid_flag
#define DSDPV1_REG_VALID_FLAG_VALID 0xC5U  // The chip has begun to work.

// Values of dpv1_enable
#define DSDPV1_REG_DPV1_ENABLE_ON 0x1DU  // DPV1 is enabled; every other value disables it.

// Values of dp_state
#define DSDPV1_REG_DP_STATE_OFFLINE 0x00U  // OFFLINE
#define DSDPV1_REG_DP_STATE_WAIT_PRM 0x01U  // WAIT_PRM
#define DSDPV1_REG_DP_STATE_WAIT_CFG 0x02U  // WAIT_CFG
#define DSDPV1_REG_DP_STATE_DATA_EXCHANGE 0x03U  // DATA_EXCHANGE

// Values of baud
#define DSDPV1_REG_BAUD_RATE_12M 0x00U  // 12 Mbit/s
#define DSDPV1_REG_BAUD_RATE_6M 0x01U  // 6 Mbit/s
#define DSDPV1_REG_BAUD_RATE_3M 0x02U  // 3 Mbit/s
#define DSDPV1_REG_BAUD_RATE_1M5 0x03U  // 1.5 Mbit/s
#define DSDPV1_REG_BAUD_RATE_500K 0x04U  // 500 kbit/s
#define DSDPV1_REG_BAUD_RATE_187K5 0x05U  // 187.5 kbit/s
#define DSDPV1_REG_BAUD_RATE_93K75 0x06U  // 93.75 kbit/s
#define DSDPV1_REG_BAUD_RATE_45K45 0x07U  // 45.45 kbit/s
#define DSDPV1_REG_BAUD_RATE_19K2 0x08U  // 19.2 kbit/s
#define DSDPV1_REG_BAUD_RATE_9K6 0x09U  // 9.6 kbit/s
#define DSDPV1_REG_BAUD_SEARCHING 0x0FU  // The baud rate is being searched.

// Values of prm_mode
#define DSDPV1_REG_PRM_MODE_AT_MOST 0x00U  // The chip judges: user parameter length <= B02A.
#define DSDPV1_REG_PRM_MODE_EXACTLY 0x01U  // The chip judges: user parameter length = B02A.
#define DSDPV1_REG_PRM_MODE_USER 0x02U  // The user judges: verdict in B00C.0, handed over with B010.7.

// Values of cfg_mode
#define DSDPV1_REG_CFG_MODE_AT_MOST 0x00U  // The chip judges: 0 < configuration length <= B02C.
#define DSDPV1_REG_CFG_MODE_EQUAL 0x01U  // The chip judges: configuration equal to B02F.. of the initialisation.
#define DSDPV1_REG_CFG_MODE_USER 0x02U  // The user judges: verdict in B00C.1, handed over with B010.6.

// Values of diag_type
#define DSDPV1_REG_DIAG_TYPE_EXTENDED 0x00U  // Low priority, extended diagnosis; ends external diagnosis (Ext_Diag 0).
#define DSDPV1_REG_DIAG_TYPE_EXTERNAL_GONE 0x01U  // High priority, external diagnosis: the station has no error.
#define DSDPV1_REG_DIAG_TYPE_EXTERNAL_PRESENT 0x81U  // High priority, external diagnosis: the station has an error (Ext_Diag).
#define DSDPV1_REG_DIAG_TYPE_STATIC_GONE 0x02U  // High priority, static diagnosis: the station has no error.
#define DSDPV1_REG_DIAG_TYPE_STATIC_PRESENT 0x82U  // High priority, static diagnosis: the station has an error (Stat_Diag).

// Values of function_num
#define DSDPV1_REG_FUNCTION_NUM_TRANSPORT 0x51U  // DS_Transport, class 2 only (table 31).
#define DSDPV1_REG_FUNCTION_NUM_READ 0x5EU  // DS_Read (table 26).
#define DSDPV1_REG_FUNCTION_NUM_WRITE 0x5FU  // DS_Write (table 26).
#define DSDPV1_REG_FUNCTION_NUM_TRANSPORT_ERROR 0xD1U  // Transport error, class 2 only (table 32).
#define DSDPV1_REG_FUNCTION_NUM_READ_ERROR 0xDEU  // Read error (table 27).
#define DSDPV1_REG_FUNCTION_NUM_WRITE_ERROR 0xDFU  // Write error (table 27).

#endif
