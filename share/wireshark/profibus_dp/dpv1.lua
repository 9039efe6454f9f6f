-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- The PDUs of DPV1: MSAC1 and MSAC2.
local fields, words = ...
if type(fields) ~= "table" then return end

local f, e = fields.f, fields.e

local function refused(r, name)
    r:add("pbdp.v1.error_decode")
    local code, range, item = r:add_parts("pbdp.v1.error_code_1", {"pbdp.v1.error_class", "pbdp.v1.error_code"})
    r:add("pbdp.v1.error_code_2")
    r:rest("pbdp.v1.data")
    if not code then return name .. " refused" end
    local class = words.error_class[bit.rshift(code, 4)]
    local text = string.format("%s refused, %s: %s", name, class, words.error_code[code] or string.format("0x%02X", code))
    item:add_proto_expert_info(e.dpv1_refused, text)
    return text
end

local function data_set(r, name)
    local slot, index, length = r:add("pbdp.v1.slot"), r:add("pbdp.v1.index"), r:add("pbdp.v1.length")
    r:rest("pbdp.v1.data")
    return length and string.format("%s slot %d index %d length %d", name, slot, index, length) or name
end

local function features(r)
    r:add("pbdp.v1.features", 2)
    r:add("pbdp.v1.profile_features", 2)
    r:add("pbdp.v1.profile_ident", 2)
    r:rest("pbdp.v1.address")
end

local function initiate(r, name, response)
    if response then
        local length = r:add("pbdp.v1.max_length")
        features(r)
        return length and string.format("%s accepted, at most %d bytes", name, length) or name
    end
    r:add("pbdp.v1.reserved", 3)
    local timeout = r:add("pbdp.v1.send_timeout", 2)
    features(r)
    return timeout and string.format("%s, Send_Timeout %d ms", name, timeout * 10) or name
end

local function rm_answer(r, name)
    local sap = r:add("pbdp.v1.sap")
    local timeout = r:add("pbdp.v1.send_timeout", 2)
    r:rest("pbdp.v1.data")
    return timeout and string.format("%s, channel SAP %d, Send_Timeout %d ms", name, sap, timeout * 10) or name
end

local function abort(r, name)
    local subnet = r:add("pbdp.v1.subnet")
    local instance, range = r:add("pbdp.v1.instance")
    if not instance then return name end
    local reason = r.tree:add(f["pbdp.v1.reason"], range)
    local code = range:uint()
    r:rest("pbdp.v1.detail")
    local text = string.format("%s, %s: %s", name, words.instance[bit.rshift(bit.band(code, 0x30), 4)],
                               words.abort[bit.band(code, 0x3F)] or "reason " .. bit.band(code, 0x0F))
    reason:add_proto_expert_info(e.aborted, text)
    return text
end

local function alarm_ack(r, name)
    local slot = r:add("pbdp.v1.slot")
    local _, kind = r:add("pbdp.diag.alarm_type")
    local _, specifier = r:add("pbdp.diag.specifier")
    if specifier then r.tree:add(f["pbdp.diag.sequence"], specifier) end
    return kind and string.format("%s slot %d, %s", name, slot, words.alarm_type[bit.band(kind:uint(), 0x7F)] or "reserved")
        or name
end

local pdus = {
    [0x51] = data_set, [0x56] = rm_answer, [0x57] = initiate, [0x58] = abort, [0x5C] = alarm_ack, [0x5E] = data_set,
    [0x5F] = data_set,
}

-- One PDU; an empty one asks for the answer. Returns it in words.
return function(r, response)
    if r:left() == 0 then return "poll" end
    local _, range = r:add("pbdp.v1.function")
    r.tree:add(f["pbdp.v1.error"], range)
    local number = bit.band(range:uint(), 0x7F)
    local name = words.function_num[number] or string.format("function 0x%02X", number)
    if range:uint() >= 0x80 then return refused(r, name) end
    if pdus[number] then return pdus[number](r, name, response) end
    r:rest("pbdp.v1.data")
    return name
end
