-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- Every field and expert info of the two protocols: pbdl (data link layer) and pbdp (DP, DPV0 and DPV1).
local words = ...
if type(words) ~= "table" then return end -- Wireshark also loads each file of the folder by itself

local f, link, dp = {}, {}, {}

local function keep(list, name, field)
    f[name] = field
    list[#list + 1] = field
end

-- number(list, kind)(name, label, values, display, mask, about): all fields of a protocol are kept in its list.
local function number(list, kind)
    return function(name, label, values, display, mask, about)
        keep(list, name, ProtoField[kind](name, label, display or base.DEC, values, mask, about))
    end
end
local function plain(list, kind)
    return function(name, label, about) keep(list, name, ProtoField[kind](name, label, about)) end
end
local function truth(list)
    return function(name, label, mask, about)
        keep(list, name, ProtoField.bool(name, label, mask and 8 or base.NONE, nil, mask, about))
    end
end

-- A byte of flags: f[prefix] is the byte, f[prefix .. ".flags"] the list of its bits.
local function flags(list, prefix, label, names)
    keep(list, prefix, ProtoField.uint8(prefix, label, base.HEX))
    local bits = {}
    for _, each in ipairs(names) do
        local mask, name = each[1], each[2]
        local key = prefix .. "." .. name:lower():gsub("[^%w]+", "_")
        keep(list, key, ProtoField.bool(key, name, 8, nil, mask))
        bits[#bits + 1] = f[key]
    end
    f[prefix .. ".flags"] = bits
end

local u8, text, bytes, bool = number(link, "uint8"), plain(link, "string"), plain(link, "bytes"), truth(link)
text("pbdl.type", "Telegram", "SD1, SD2, SD3, SD4 or SC; wrong for none of them")
text("pbdl.wrong", "Wrong", "why it is no right telegram")
u8("pbdl.sd", "Start delimiter", words.start, base.HEX)
u8("pbdl.le", "LE (length)")
u8("pbdl.ler", "LEr (length repeated)")
u8("pbdl.sd2r", "Start delimiter repeated", nil, base.HEX)
u8("pbdl.da", "DA (destination address)", nil, nil, 0x7F)
bool("pbdl.da.extension", "SAP follows", 0x80)
u8("pbdl.sa", "SA (source address)", nil, nil, 0x7F)
bool("pbdl.sa.extension", "SAP follows", 0x80)
u8("pbdl.addr", "Station", nil, nil, 0x7F, "DA or SA")
u8("pbdl.fc", "FC (function code)", nil, base.HEX)
bool("pbdl.fc.request", "Request", 0x40)
bool("pbdl.fc.fcb", "FCB (frame count bit)", 0x20)
bool("pbdl.fc.fcv", "FCV (frame count bit valid)", 0x10)
u8("pbdl.fc.function", "Function", words.request, nil, 0x0F)
u8("pbdl.fc.station_type", "Station type", words.station_type, nil, 0x30)
u8("pbdl.fc.response", "Function", words.response, nil, 0x0F)
u8("pbdl.dsap", "DSAP", nil, nil, 0x3F)
u8("pbdl.ssap", "SSAP", nil, nil, 0x3F)
bytes("pbdl.data", "Data")
u8("pbdl.fcs", "FCS (frame check sequence)", nil, base.HEX)
u8("pbdl.fcs.expected", "Right FCS", nil, base.HEX)
bool("pbdl.fcs.right", "FCS is right")
u8("pbdl.ed", "End delimiter", nil, base.HEX)
bytes("pbdl.surplus", "Bytes that belong to no telegram")
number(link, "uint32")("pbdl.baud", "Baud rate / bit/s")
plain(link, "relative_time")("pbdl.duration", "Time on the line")
keep(link, "pbdl.response_in", ProtoField.framenum("pbdl.response_in", "Answer in", base.NONE, frametype.RESPONSE))
keep(link, "pbdl.response_to", ProtoField.framenum("pbdl.response_to", "Answer to", base.NONE, frametype.REQUEST))
plain(link, "relative_time")("pbdl.tsdr", "TSDR (response time)")
plain(link, "double")("pbdl.tsdr_bits", "TSDR / bit times")
keep(link, "pbdl.unanswered", ProtoField.framenum("pbdl.unanswered", "Not answered before this", base.NONE))
u8("pbdl.unanswered.station", "Station that did not answer")
u8("pbdl.station", "Answering station", nil, nil, nil, "the slave of a request or answer, also of SC")
bool("pbdl.damaged", "Damaged on the line", nil, "packet flags of the capture")

u8, text, bytes, bool = number(dp, "uint8"), plain(dp, "string"), plain(dp, "bytes"), truth(dp)
local u16 = number(dp, "uint16")
text("pbdp.service", "Service")
bytes("pbdp.outputs", "Outputs")
bytes("pbdp.inputs", "Inputs")
bytes("pbdp.data", "Data")

flags(dp, "pbdp.prm.station_status", "Station_status", {
    {0x80, "Lock_Req"}, {0x40, "Unlock_Req"}, {0x20, "Sync_Req"}, {0x10, "Freeze_Req"}, {0x08, "WD_On"},
})
u8("pbdp.prm.lock", "Lock", words.lock, nil, 0xC0)
u8("pbdp.prm.wd_fact_1", "WD_Fact_1")
u8("pbdp.prm.wd_fact_2", "WD_Fact_2")
number(dp, "uint32")("pbdp.prm.wd_ms", "Watchdog / ms")
u8("pbdp.prm.min_tsdr", "min_TSDR / bit times (0: unchanged)")
u16("pbdp.ident", "Ident_Number", nil, base.HEX)
local groups = {}
for group = 1, 8 do groups[group] = {2 ^ (group - 1), "Group " .. group} end
flags(dp, "pbdp.prm.group_ident", "Group_Ident", groups)
flags(dp, "pbdp.prm.dpv1_status_1", "DPV1_Status_1", {
    {0x80, "DPV1_Enable"}, {0x40, "Fail_Safe"}, {0x20, "Publisher_Enable"}, {0x04, "WD_Base_1ms"},
    {0x02, "Dis_Stopbit"}, {0x01, "Dis_Startbit"},
})
flags(dp, "pbdp.prm.dpv1_status_2", "DPV1_Status_2", {
    {0x80, "Enable_Pull_Plug_Alarm"}, {0x40, "Enable_Process_Alarm"}, {0x20, "Enable_Diagnostic_Alarm"},
    {0x10, "Enable_Manufacturer_Specific_Alarm"}, {0x08, "Enable_Status_Alarm"}, {0x04, "Enable_Update_Alarm"},
    {0x01, "Check_Cfg_Mode"},
})
flags(dp, "pbdp.prm.dpv1_status_3", "DPV1_Status_3", {{0x80, "PrmCmd"}, {0x10, "IsoM_Req"}, {0x08, "Prm_Structure"}})
u8("pbdp.prm.alarm_mode", "Alarm_Mode", words.alarm_mode, nil, 0x07)
bytes("pbdp.prm.user", "User_Prm_Data")
bytes("pbdp.prm.block", "Block")
u8("pbdp.prm.block.length", "Structure_Length")
u8("pbdp.prm.block.type", "Structure_Type", words.prm_block)
u8("pbdp.prm.block.slot", "Slot_Number")
u8("pbdp.prm.block.specifier", "Specifier", nil, base.HEX)
bytes("pbdp.prm.block.data", "Data")

bytes("pbdp.cfg.module", "Module")
u8("pbdp.cfg.id", "Identifier", nil, base.HEX)
u8("pbdp.cfg.direction", "Direction", words.cfg_direction, nil, 0x30)
u8("pbdp.cfg.special", "Special format", words.cfg_special, nil, 0xC0)
u8("pbdp.cfg.special.specific", "Manufacturer data (15: none, not compared)", nil, nil, 0x0F)
u8("pbdp.cfg.consistency", "Consistency", words.cfg_consistency, nil, 0x80)
u8("pbdp.cfg.unit", "Unit", words.cfg_unit, nil, 0x40)
u8("pbdp.cfg.length", "Length - 1", nil, nil, 0x0F)
u8("pbdp.cfg.out", "Length of output", nil, base.HEX)
u8("pbdp.cfg.in", "Length of input", nil, base.HEX)
u8("pbdp.cfg.special.length", "Length - 1", nil, nil, 0x3F)
bytes("pbdp.cfg.specific", "Manufacturer data")
u16("pbdp.cfg.input_bytes", "Input bytes in all")
u16("pbdp.cfg.output_bytes", "Output bytes in all")

flags(dp, "pbdp.diag.status_1", "Station_status_1", words.diag_status_1)
flags(dp, "pbdp.diag.status_2", "Station_status_2", {
    {0x80, "Deactivated"}, {0x20, "Sync_Mode"}, {0x10, "Freeze_Mode"}, {0x08, "WD_On"}, {0x04, "DP slave"},
    {0x02, "Stat_Diag"}, {0x01, "Prm_Req"},
})
flags(dp, "pbdp.diag.status_3", "Station_status_3", {{0x80, "Ext_Diag_Overflow"}})
u8("pbdp.diag.master", "Master_Add (255: none)")
bytes("pbdp.diag.block", "Block")
u8("pbdp.diag.block.type", "Block", words.diag_block, nil, 0xC0)
u8("pbdp.diag.block.length", "Length", nil, nil, 0x3F)
u8("pbdp.diag.modules", "Modules with diagnosis", nil, base.HEX)
u8("pbdp.diag.module", "Module", nil, nil, 0x3F)
u8("pbdp.diag.channel", "Channel", nil, nil, 0x3F)
u8("pbdp.diag.channel.direction", "Direction", words.channel_direction, nil, 0xC0)
u8("pbdp.diag.channel.type", "Type", words.channel_type, nil, 0xE0)
u8("pbdp.diag.channel.error", "Error", words.channel_error, nil, 0x1F)
u8("pbdp.diag.alarm_type", "Alarm_Type", words.alarm_type, nil, 0x7F)
u8("pbdp.diag.status_type", "Status_Type", words.status_type, nil, 0x7F)
u8("pbdp.diag.slot", "Slot_Number")
u8("pbdp.diag.specifier", "Specifier", words.specifier, nil, 0x03)
bool("pbdp.diag.add_ack", "Add_Ack", 0x04)
u8("pbdp.diag.sequence", "Sequence number", nil, nil, 0xF8)
bytes("pbdp.diag.user", "Diagnosis_User_Data")

flags(dp, "pbdp.control.command", "Control_Command", words.control_command)
flags(dp, "pbdp.control.groups", "Group_Select (0: all)", groups)
u8("pbdp.new_address", "New_Slave_Address")
bool("pbdp.no_change", "No_Add_Chg (no later change)")
bytes("pbdp.remote_data", "Rem_Slave_Data")

u8("pbdp.v1.function", "Function_Num", words.function_num, base.HEX, 0x7F)
bool("pbdp.v1.error", "Error", 0x80)
u8("pbdp.v1.slot", "Slot_Number")
u8("pbdp.v1.index", "Index")
u8("pbdp.v1.length", "Length")
bytes("pbdp.v1.data", "Data")
u8("pbdp.v1.error_decode", "Error_Decode (0x80: DPV1)", nil, base.HEX)
u8("pbdp.v1.error_code_1", "Error_Code_1", words.error_code, base.HEX)
u8("pbdp.v1.error_class", "Error class", words.error_class, nil, 0xF0)
u8("pbdp.v1.error_code", "Error code", nil, nil, 0x0F)
u8("pbdp.v1.error_code_2", "Error_Code_2", nil, base.HEX)
bytes("pbdp.v1.reserved", "Reserved")
u16("pbdp.v1.send_timeout", "Send_Timeout / 10 ms")
u8("pbdp.v1.max_length", "Max_Len_Data_Unit")
u16("pbdp.v1.features", "Features_Supported", nil, base.HEX)
u16("pbdp.v1.profile_features", "Profile_Features_Supported", nil, base.HEX)
u16("pbdp.v1.profile_ident", "Profile_Ident_Number", nil, base.HEX)
bytes("pbdp.v1.address", "Add_Addr")
u8("pbdp.v1.sap", "SAP of the channel")
u8("pbdp.v1.subnet", "Subnet", words.subnet)
u8("pbdp.v1.instance", "Instance", words.instance, nil, 0x30)
u8("pbdp.v1.reason", "Reason_Code", nil, nil, 0x0F)
bytes("pbdp.v1.detail", "Additional_Detail")

local e = {}
local function expert_info(name, words_of, group, severity)
    e[name] = ProtoExpert.new("pbdl." .. name, words_of, expert.group[group], expert.severity[severity])
end
expert_info("fcs_wrong", "Wrong FCS", "CHECKSUM", "ERROR")
expert_info("shape", "No right telegram", "PROTOCOL", "ERROR")
expert_info("damage", "Damaged on the line", "PROTOCOL", "ERROR")
expert_info("no_answer", "Not answered", "SEQUENCE", "WARN")
expert_info("before_unanswered", "The request before was not answered", "SEQUENCE", "NOTE")
expert_info("unexpected", "An answer that nobody has asked for", "SEQUENCE", "WARN")
expert_info("repeated", "A request again, with the same FCB", "SEQUENCE", "NOTE")
expert_info("refused", "Refused by the data link layer", "RESPONSE_CODE", "WARN")
expert_info("no_data", "NR: no data", "RESPONSE_CODE", "CHAT")
expert_info("short", "Data too short for their service", "PROTOCOL", "WARN")
expert_info("diagnosis", "Diagnosis", "RESPONSE_CODE", "NOTE")
expert_info("dpv1_refused", "DPV1 service refused", "RESPONSE_CODE", "WARN")
expert_info("aborted", "Connection aborted", "RESPONSE_CODE", "WARN")

return {f = f, e = e, link = link, dp = dp}
