-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- The words of PROFIBUS: function codes, services, error codes, as tables from number to name.
local words = {}

words.start = {
    [0x10] = "SD1, no data", [0x68] = "SD2, data of variable length", [0xA2] = "SD3, 8 bytes of data",
    [0xDC] = "SD4, token", [0xE5] = "SC, short acknowledge",
}

words.request = {
    [3] = "SDA low", [4] = "SDN low", [5] = "SDA high", [6] = "SDN high", [7] = "MSRD", [9] = "FDL status",
    [12] = "SRD low", [13] = "SRD high", [14] = "Ident", [15] = "LSAP status",
}

words.response = {
    [0] = "OK", [1] = "UE (user error)", [2] = "RR (no resource)", [3] = "RS (SAP not enabled)",
    [8] = "DL (data low)", [9] = "NR (no data)", [10] = "DH (data high)", [12] = "RDL (data low, no resource)",
    [13] = "RDH (data high, no resource)",
}

words.station_type = {
    [0] = "passive station", [1] = "active station, not ready", [2] = "active station, ready",
    [3] = "active station, in the ring",
}

-- By the slave's SAP; without one it is Data_Exchange.
words.service = {
    [49] = "MSAC2 Initiate", [50] = "MSAC1 alarm", [51] = "MSAC1", [53] = "Ext_User_Prm", [55] = "Set_Slave_Add",
    [56] = "RD_Inp", [57] = "RD_Outp", [58] = "Global_Control", [59] = "Get_Cfg", [60] = "Slave_Diag",
    [61] = "Set_Prm", [62] = "Chk_Cfg",
}
for sap = 0, 48 do words.service[sap] = "MSAC2" end

words.lock = {
    [0] = "only min_TSDR changes", [1] = "released for other masters", [2] = "locked for this master",
    [3] = "released for other masters",
}

words.alarm_mode = {
    [0] = "1 alarm of each type", [1] = "2 alarms in all", [2] = "4 alarms in all", [3] = "8 alarms in all",
    [4] = "12 alarms in all", [5] = "16 alarms in all", [6] = "24 alarms in all", [7] = "32 alarms in all",
}

words.prm_block = {
    [2] = "PrmCmd", [3] = "DXB_Linktable", [4] = "IsoM_Parameter", [5] = "F_Parameter",
    [7] = "DXB_Subscribertable", [8] = "Time_AR_Parameter", [129] = "User_Prm_Data",
}
for kind = 32, 128 do words.prm_block[kind] = "manufacturer specific" end

words.cfg_direction = {
    [0] = "special format", [1] = "input", [2] = "output", [3] = "input and output",
}
words.cfg_special = { [0] = "empty slot", [1] = "input", [2] = "output", [3] = "output and input" }
words.cfg_unit = { [0] = "bytes", [1] = "words" }
words.cfg_consistency = { [0] = "over a byte or word", [1] = "over the whole module" }

-- Bits with their names.
words.diag_status_1 = {
    {0x80, "Master_Lock"}, {0x40, "Prm_Fault"}, {0x20, "Invalid_Slave_Response"}, {0x10, "Not_Supported"},
    {0x08, "Ext_Diag"}, {0x04, "Cfg_Fault"}, {0x02, "Station_Not_Ready"}, {0x01, "Station_Non_Existent"},
}
words.control_command = {
    {0x20, "Sync"}, {0x10, "Unsync"}, {0x08, "Freeze"}, {0x04, "Unfreeze"}, {0x02, "Clear_Data"},
}

words.diag_block = {
    [0] = "device related", [1] = "identifier related", [2] = "channel related", [3] = "revision number",
}
words.channel_direction = { [0] = "reserved", [1] = "input", [2] = "output", [3] = "input/output" }
words.channel_type = {
    [0] = "unspecified", [1] = "bit", [2] = "2 bits", [3] = "4 bits", [4] = "byte", [5] = "word", [6] = "2 words",
    [7] = "reserved",
}
words.channel_error = {
    [0] = "reserved", [1] = "short circuit", [2] = "undervoltage", [3] = "overvoltage", [4] = "overload",
    [5] = "overtemperature", [6] = "line break", [7] = "upper limit exceeded", [8] = "lower limit exceeded",
    [9] = "error",
}
for code = 10, 15 do words.channel_error[code] = "reserved" end
for code = 16, 31 do words.channel_error[code] = "manufacturer's error" end

words.alarm_type = {
    [1] = "diagnosis", [2] = "process", [3] = "pull", [4] = "plug", [5] = "status", [6] = "update",
}
words.status_type = {
    [1] = "status message", [2] = "Module_Status", [3] = "DXB_Link_Status", [30] = "PrmCmdAck", [31] = "Red_State",
}
for kind = 32, 126 do
    words.alarm_type[kind] = "manufacturer specific"
    words.status_type[kind] = "manufacturer specific"
end
words.specifier = {
    [0] = "no further differentiation", [1] = "appears", [2] = "disappears, slot all right",
    [3] = "disappears, slot still disturbed",
}

words.function_num = {
    [0x48] = "Idle", [0x51] = "DS_Transport", [0x56] = "RM answer", [0x57] = "Initiate", [0x58] = "Abort",
    [0x5C] = "Alarm_Ack", [0x5E] = "DS_Read", [0x5F] = "DS_Write",
}

words.error_class = { [10] = "application", [11] = "access", [12] = "resource" }
for class = 0, 9 do words.error_class[class] = "reserved" end
for class = 13, 15 do words.error_class[class] = "user specific" end
-- By Error_Code_1, both halves.
words.error_code = {
    [0xA0] = "read error", [0xA1] = "write error", [0xA2] = "module failure", [0xA8] = "version conflict",
    [0xA9] = "feature not supported",
    [0xB0] = "invalid index", [0xB1] = "write length error", [0xB2] = "invalid slot", [0xB3] = "type conflict",
    [0xB4] = "invalid area", [0xB5] = "state conflict", [0xB6] = "access denied", [0xB7] = "invalid range",
    [0xB8] = "invalid parameter", [0xB9] = "invalid type",
    [0xC0] = "read constrain conflict", [0xC1] = "write constrain conflict", [0xC2] = "resource busy",
    [0xC3] = "resource unavailable",
}

words.subnet = { [0] = "no subnet", [1] = "local subnet", [2] = "remote subnet" }
words.instance = { [0] = "FDL", [1] = "MSAC_C2", [2] = "user", [3] = "reserved" }
-- By instance and reason.
words.abort = {
    [0x01] = "UE", [0x02] = "RR", [0x03] = "RS", [0x09] = "NR", [0x0A] = "DH", [0x0B] = "LR", [0x0C] = "RDL",
    [0x0D] = "RDH", [0x0E] = "DS (master is not in the ring)", [0x0F] = "NA (no answer)",
    [0x11] = "ABT_SE (sequence error)", [0x12] = "ABT_FE (invalid request PDU)",
    [0x13] = "ABT_TO (timeout of the connection)", [0x14] = "ABT_RE (invalid response PDU)",
    [0x15] = "ABT_IV (invalid service from the user)", [0x16] = "ABT_STO (Send_Timeout too small)",
    [0x17] = "ABT_IA (invalid additional address)", [0x18] = "ABT_OC (waiting for FDL_DATA_REPLY.con)",
    [0x1F] = "ABT_RES (resource error)",
}

return words
