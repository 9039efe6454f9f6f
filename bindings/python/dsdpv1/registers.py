# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Addresses, bits and values of the DPRAM. A word (CRC, count) is at its high byte, the low byte follows.

Generated from registers/dsdpv1.rdl by registers/generate.py. Do not edit.
"""

# DPRAM
DPRAM_SIZE = 2048  # bytes

# Status and command bytes
VERSION = 0x000  # Version code
VERSION_RESET = 0x01  # value after reset
VERSION_YEAR = 0x001  # Version, year
VERSION_YEAR_RESET = 0x0D  # value after reset
VERSION_MONTH = 0x002  # Version, month
VERSION_MONTH_RESET = 0x07  # value after reset
VERSION_DAY = 0x003  # Version, day
VERSION_DAY_RESET = 0x01  # value after reset
VALID_FLAG = 0x004  # Valid flag
DPV1_ENABLE = 0x005  # DPV1 enable
ACCESS_COUNT = 0x006  # DPRAM access count
OFFLINE_COUNT = 0x008  # Count of leaving data exchange
CHIP_STATUS_1 = 0x00A  # Chip status byte 1
CHIP_STATUS_1_INITIALISED = 0x01  # The initialisation succeeded; the user may clear it afterwards (ruling D7).
CHIP_STATUS_2 = 0x00B  # Chip status byte 2
CHIP_STATUS_2_INIT_CRC = 0x01  # Initialisation data, CRC wrong.
CHIP_STATUS_2_V1_INIT_CRC = 0x02  # V1 initialisation, CRC wrong; the chip never sets it (ruling R5).
CHIP_STATUS_2_INPUT_CRC = 0x04  # Input data, CRC wrong.
CHIP_STATUS_2_DIAG_CRC = 0x08  # Diagnosis data, CRC wrong.
CHIP_STATUS_2_C1_CRC = 0x10  # C1 answer, CRC wrong.
CHIP_STATUS_2_C2_CRC = 0x20  # C2 answer, CRC wrong.
USER_STATUS_1 = 0x00C  # User status byte 1
USER_STATUS_1_PRM_WRONG = 0x01  # The user judges the parameters wrong; counts with B010.7 (ruling D4).
USER_STATUS_1_CFG_WRONG = 0x02  # The user judges the configuration wrong; counts with B010.6 (ruling D4).
USER_STATUS_2 = 0x00D  # User status byte 2
USER_STATUS_2_CFG_CRC = 0x01  # Configuration data, CRC wrong.
USER_STATUS_2_PRM_CRC = 0x02  # Parameter data, CRC wrong.
USER_STATUS_2_OUTPUT_CRC = 0x04  # Output data, CRC wrong.
USER_STATUS_2_C2_CRC = 0x08  # C2 request, CRC wrong.
USER_STATUS_2_C1_CRC = 0x10  # C1 request, CRC wrong.
CHIP_COMMAND_1 = 0x00E  # Chip command byte 1
CHIP_COMMAND_1_OUTPUT = 0x01  # Output data valid.
CHIP_COMMAND_1_PRM = 0x02  # Parameter data valid.
CHIP_COMMAND_1_CFG = 0x04  # Configuration data valid.
CHIP_COMMAND_2 = 0x00F  # Chip command byte 2
CHIP_COMMAND_2_C1 = 0x01  # C1 request valid.
CHIP_COMMAND_2_C2 = 0x02  # C2 request valid.
USER_COMMAND_1 = 0x010  # User command byte 1
USER_COMMAND_1_INPUT = 0x01  # Input data valid.
USER_COMMAND_1_DIAG = 0x02  # Diagnosis data valid.
USER_COMMAND_1_INIT = 0x04  # Initialisation data valid.
USER_COMMAND_1_CFG_VERDICT = 0x40  # Verdict on the configuration valid, see B00C.1 (ruling D4).
USER_COMMAND_1_PRM_VERDICT = 0x80  # Verdict on the parameters valid, see B00C.0 (ruling D4).
USER_COMMAND_2 = 0x011  # User command byte 2
USER_COMMAND_2_C1 = 0x01  # C1 answer valid.
USER_COMMAND_2_C2 = 0x02  # C2 answer valid.
USER_COMMAND_2_INPUT_HISTORY = 0x40  # 1: B00B.2 shows the history of the inputs' CRC, a right block does not clear it; 0: the present. The user sets and clears it, the chip only reads it (ruling D16).
USER_COMMAND_2_INPUT_CLEAR = 0x80  # Asks the chip to clear B00B.2, which it does once when B011.6 is 1; it sets this bit back to 0 whatever B011.6 is (ruling D16).
CHIP_STATUS_3 = 0x012  # Chip status byte 3
CHIP_STATUS_3_DP_STATE = 0x0C  # State of the DP slave.
CHIP_STATUS_3_DP_STATE_SHIFT = 2  # lowest bit
CHIP_STATUS_3_BAUD_RATE = 0xF0  # Baud rate.
CHIP_STATUS_3_BAUD_RATE_SHIFT = 4  # lowest bit
CHIP_STATUS_4 = 0x013  # Chip status byte 4
CHIP_STATUS_4_INIT_LIMIT = 0x01  # A length or the address of the initialisation is out of its limits (ruling D7).
CHIP_STATUS_4_C2_LIMIT = 0x02  # Number of C2 channels over its limit; always 0 (ruling R5).
CHIP_STATUS_4_SLOT_LIMIT = 0x04  # Number of slots and indices over its limit; always 0 (ruling R5).
OWNERSHIP = 0x014  # Ownership
OWNERSHIP_CHIP = 0x01  # The chip is in an access.
OWNERSHIP_HOST = 0x02  # The host is in an access.
U_TIMER = 0x015  # U_Timer
U_TIMER_ENABLE = 0x01  # Enabled: the ownership ends by itself.
UART_INTERVAL = 0x019  # Interval between characters
UART_TSDR = 0x01A  # TSDR

# Initialisation data
INIT = 0x020  # first byte
INIT_SIZE = 215  # bytes, without the CRC
INIT_LENGTH = 0x020  # Length
INIT_ADDRESS = 0x021  # Station address
INIT_ADDRESS_LIMIT = 126  # largest value accepted
INIT_IDENT_HIGH = 0x022  # Ident number, high byte
INIT_IDENT_LOW = 0x023  # Ident number, low byte
INIT_COMMAND = 0x024  # Initialisation command byte
INIT_COMMAND_ADDRESS_CHANGE = 0x01  # Set_Slave_Address is supported.
INIT_COMMAND_FREEZE = 0x02  # Freeze is supported.
INIT_COMMAND_SYNC = 0x04  # Sync is supported.
INIT_COMMAND_FAIL_SAFE = 0x08  # Fail-safe mode is supported.
INIT_MAX_INPUT = 0x027  # Largest input data length
INIT_MAX_INPUT_LIMIT = 244  # largest value accepted
INIT_MAX_OUTPUT = 0x028  # Largest output data length
INIT_MAX_OUTPUT_LIMIT = 244  # largest value accepted
INIT_MAX_DIAG = 0x029  # User diagnosis length
INIT_MAX_DIAG_LIMIT = 238  # largest value accepted
INIT_MAX_PRM = 0x02A  # Largest user parameter length
INIT_MAX_PRM_LIMIT = 237  # largest value accepted
PRM_MODE = 0x02B  # Judging mode of the user parameters
INIT_MAX_CFG = 0x02C  # Largest configuration length
INIT_MAX_CFG_LIMIT = 200  # largest value accepted
CFG_MODE = 0x02D  # Judging mode of the configuration
INIT_CFG_LENGTH = 0x02E  # Configuration length
INIT_CFG_LENGTH_LIMIT = 200  # largest value accepted
INIT_CFG = 0x02F  # Configuration bytes
INIT_CFG_SIZE = 200  # bytes
INIT_CRC = 0x0F7  # CRC

# Input data
INPUT = 0x130  # first byte
INPUT_SIZE = 245  # bytes, without the CRC
INPUT_LENGTH = 0x130  # Length
INPUT_DATA = 0x131  # Input bytes
INPUT_DATA_SIZE = 244  # bytes
INPUT_CRC = 0x225  # CRC

# Diagnosis data
DIAG = 0x227  # first byte
DIAG_SIZE = 240  # bytes, without the CRC
DIAG_TYPE = 0x227  # Type of diagnosis
DIAG_LENGTH = 0x228  # Length
DIAG_DATA = 0x229  # Diagnosis bytes
DIAG_DATA_SIZE = 238  # bytes
DIAG_CRC = 0x317  # CRC

# Output data
OUTPUT = 0x319  # first byte
OUTPUT_SIZE = 245  # bytes, without the CRC
OUTPUT_LENGTH = 0x319  # Length
OUTPUT_DATA = 0x31A  # Output bytes
OUTPUT_DATA_SIZE = 244  # bytes
OUTPUT_CRC = 0x40E  # CRC

# User parameters
PRM = 0x410  # first byte
PRM_SIZE = 238  # bytes, without the CRC
PRM_LENGTH = 0x410  # Length
PRM_DATA = 0x411  # User parameter bytes
PRM_DATA_SIZE = 237  # bytes
PRM_CRC = 0x4FE  # CRC

# Configuration
CFG = 0x500  # first byte
CFG_SIZE = 203  # bytes, without the CRC
CFG_OUTPUT_LENGTH = 0x500  # Output data length
CFG_INPUT_LENGTH = 0x501  # Input data length
CFG_LENGTH = 0x502  # Length
CFG_DATA = 0x503  # Configuration bytes
CFG_DATA_SIZE = 200  # bytes
CFG_CRC = 0x5CB  # CRC

# Non-cyclic data, class 1
C1 = 0x5D0  # first byte
C1_SIZE = 244  # bytes, without the CRC
C1_FUNCTION_NUM = 0x5D0  # Function_Num
C1_SLOT = 0x5D1  # Slot number or Error_Decode
C1_INDEX = 0x5D2  # Index or Error_Code_1
C1_LENGTH = 0x5D3  # Data length or Error_Code_2
C1_DATA = 0x5D4  # Data
C1_DATA_SIZE = 240  # bytes
C1_CRC = 0x6C4  # CRC

# Non-cyclic data, class 2
C2 = 0x6D0  # first byte
C2_SIZE = 244  # bytes, without the CRC
C2_FUNCTION_NUM = 0x6D0  # Function_Num
C2_SLOT = 0x6D1  # Slot number or Error_Decode
C2_INDEX = 0x6D2  # Index or Error_Code_1
C2_LENGTH = 0x6D3  # Data length or Error_Code_2
C2_DATA = 0x6D4  # Data
C2_DATA_SIZE = 240  # bytes
C2_CRC = 0x7C4  # CRC

# Values of valid_flag
VALID_FLAG_VALID = 0xC5  # The chip has begun to work.

# Values of dpv1_enable
DPV1_ENABLE_ON = 0x1D  # DPV1 is enabled; every other value disables it.

# Values of dp_state
DP_STATE_OFFLINE = 0x00  # OFFLINE
DP_STATE_WAIT_PRM = 0x01  # WAIT_PRM
DP_STATE_WAIT_CFG = 0x02  # WAIT_CFG
DP_STATE_DATA_EXCHANGE = 0x03  # DATA_EXCHANGE

# Values of baud
BAUD_RATE_12M = 0x00  # 12 MBaud
BAUD_RATE_6M = 0x01  # 6 MBaud
BAUD_RATE_3M = 0x02  # 3 MBaud
BAUD_RATE_1M5 = 0x03  # 1.5 MBaud
BAUD_RATE_500K = 0x04  # 500 kBaud
BAUD_RATE_187K5 = 0x05  # 187.5 kBaud
BAUD_RATE_93K75 = 0x06  # 93.75 kBaud
BAUD_RATE_45K45 = 0x07  # 45.45 kBaud
BAUD_RATE_19K2 = 0x08  # 19.2 kBaud
BAUD_RATE_9K6 = 0x09  # 9.6 kBaud
BAUD_SEARCHING = 0x0F  # The baud rate is being searched.

# Values of prm_mode
PRM_MODE_AT_MOST = 0x00  # The chip judges: user parameter length <= B02A.
PRM_MODE_EXACTLY = 0x01  # The chip judges: user parameter length = B02A.
PRM_MODE_USER = 0x02  # The user judges: verdict in B00C.0, handed over with B010.7.

# Values of cfg_mode
CFG_MODE_AT_MOST = 0x00  # The chip judges: 0 < configuration length <= B02C.
CFG_MODE_EQUAL = 0x01  # The chip judges: configuration equal to B02F.. of the initialisation.
CFG_MODE_USER = 0x02  # The user judges: verdict in B00C.1, handed over with B010.6.

# Values of diag_type
DIAG_TYPE_EXTENDED = 0x00  # Low priority, extended diagnosis.
DIAG_TYPE_EXTERNAL_GONE = 0x01  # High priority, external diagnosis: the station has no error.
DIAG_TYPE_EXTERNAL_PRESENT = 0x81  # High priority, external diagnosis: the station has an error (Ext_Diag).
DIAG_TYPE_STATIC_GONE = 0x02  # High priority, static diagnosis: the station has no error.
DIAG_TYPE_STATIC_PRESENT = 0x82  # High priority, static diagnosis: the station has an error (Stat_Diag).

# Values of function_num
FUNCTION_NUM_TRANSPORT = 0x51  # DS_Transport, class 2 only (table 31).
FUNCTION_NUM_READ = 0x5E  # DS_Read (table 26).
FUNCTION_NUM_WRITE = 0x5F  # DS_Write (table 26).
FUNCTION_NUM_TRANSPORT_ERROR = 0xD1  # Transport error, class 2 only (table 32).
FUNCTION_NUM_READ_ERROR = 0xDE  # Read error (table 27).
FUNCTION_NUM_WRITE_ERROR = 0xDF  # Write error (table 27).
