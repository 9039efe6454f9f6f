-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- The data of DPV0's services.
local fields, Reader, words = ...
if type(fields) ~= "table" then return end

local f, e = fields.f, fields.e
local dp = {}

local function prm_block(r)
    local length = r.tvb(r.at, 1):uint()
    local size = math.min(math.max(length, 1), r:left())
    local block = Reader.new(r.tvb, r.at, r.at + size, r.tree:add(f["pbdp.prm.block"], r.tvb(r.at, size)))
    r.at = r.at + size
    block:add("pbdp.prm.block.length")
    if length < 4 or length > size then
        block.tree:add_proto_expert_info(e.short, "Structure_Length " .. length .. " does not fit")
    end
    for _, name in ipairs({"type", "slot", "specifier"}) do
        if block:left() > 0 then block:add("pbdp.prm.block." .. name) end
    end
    block:rest("pbdp.prm.block.data")
end

local function prm_user(r)
    local status_1 = r:add_flags("pbdp.prm.dpv1_status_1")
    if status_1 < 0x80 then return r:rest("pbdp.prm.user") end
    if r:left() > 0 then r:add_flags("pbdp.prm.dpv1_status_2") end
    if r:left() == 0 then return end
    local status_3 = r:add_flags("pbdp.prm.dpv1_status_3", "pbdp.prm.alarm_mode")
    if bit.band(status_3, 0x08) == 0 then return r:rest("pbdp.prm.user") end
    while r:left() > 0 do prm_block(r) end
end

-- The watchdog's time from its two factors and its base, behind which the user's bytes stand.
local function add_watchdog(r, status, factor_1, factor_2)
    if not (status and factor_1 and factor_2) or bit.band(status, 0x08) == 0 then return end
    local base_1ms = r:left() > 4 and bit.band(r.tvb(r.at + 4, 1):uint(), 0x04) ~= 0
    local ms = factor_1 * factor_2 * (base_1ms and 1 or 10)
    r.tree:add(f["pbdp.prm.wd_ms"], ms):set_generated()
end

function dp.set_prm(r)
    local status = r:add_flags("pbdp.prm.station_status", "pbdp.prm.lock")
    local factor_1, factor_2 = r:add("pbdp.prm.wd_fact_1"), r:add("pbdp.prm.wd_fact_2")
    add_watchdog(r, status, factor_1, factor_2)
    r:add("pbdp.prm.min_tsdr")
    local ident = r:add("pbdp.ident", 2)
    r:add_flags("pbdp.prm.group_ident")
    if r:left() > 0 then prm_user(r) end
    return ident and string.format("ident 0x%04X", ident) or ""
end

-- Whether a Set_Prm locks its slave with DPV1; nil for one that does not lock.
function dp.enables_dpv1(tvb, from, stop)
    if stop - from < 7 or bit.rshift(tvb(from, 1):uint(), 6) ~= 2 then return nil end
    return stop - from > 7 and tvb(from + 7, 1):uint() >= 0x80
end

local function module_bytes(format, length) return (bit.band(format, 0x40) ~= 0 and 2 or 1) * (length + 1) end

local function cfg_length(r, name)
    local format = r:add_parts(name, {"pbdp.cfg.consistency", "pbdp.cfg.unit", "pbdp.cfg.special.length"})
    return format and module_bytes(format, bit.band(format, 0x3F)) or 0
end

local function cfg_special(r, id, sum)
    if id >= 0x80 then sum.output = sum.output + cfg_length(r, "pbdp.cfg.out") end
    if bit.band(id, 0x40) ~= 0 then sum.input = sum.input + cfg_length(r, "pbdp.cfg.in") end
    local specific = bit.band(id, 0x0F)
    if specific > 0 and specific < 15 then r:add("pbdp.cfg.specific", specific) end
end

local general = {"pbdp.cfg.direction", "pbdp.cfg.consistency", "pbdp.cfg.unit", "pbdp.cfg.length"}
local special = {"pbdp.cfg.direction", "pbdp.cfg.special", "pbdp.cfg.special.specific"}

local function cfg_module(r, sum)
    local begin, outer = r.at, r.tree
    local id = r.tvb(begin, 1):uint()
    local direction = bit.band(bit.rshift(id, 4), 3)
    r.tree = outer:add(f["pbdp.cfg.module"], r.tvb(begin, 1))
    r:add_parts("pbdp.cfg.id", direction == 0 and special or general)
    if direction == 0 then
        cfg_special(r, id, sum)
    else
        local count = module_bytes(id, bit.band(id, 0x0F))
        if bit.band(direction, 1) ~= 0 then sum.input = sum.input + count end
        if direction >= 2 then sum.output = sum.output + count end
    end
    r.tree:set_len(r.at - begin)
    r.tree = outer
end

function dp.cfg(r)
    local sum = {input = 0, output = 0}
    while r:left() > 0 do cfg_module(r, sum) end
    r.tree:add(f["pbdp.cfg.input_bytes"], sum.input):set_generated()
    r.tree:add(f["pbdp.cfg.output_bytes"], sum.output):set_generated()
    return string.format("output %d bytes, input %d bytes", sum.output, sum.input)
end

-- A status or an alarm of a slot, as DPV1 has it.
local function diag_slot(r)
    local alarm = r.tvb(r.at, 1):uint() < 0x80
    r:add(alarm and "pbdp.diag.alarm_type" or "pbdp.diag.status_type")
    r:add("pbdp.diag.slot")
    local _, range = r:add("pbdp.diag.specifier")
    if alarm and range then
        r.tree:add(f["pbdp.diag.add_ack"], range)
        r.tree:add(f["pbdp.diag.sequence"], range)
    end
    r:rest("pbdp.diag.user")
end

local function diag_channel(r)
    r:add("pbdp.diag.module")
    local _, channel = r:add("pbdp.diag.channel")
    if channel then r.tree:add(f["pbdp.diag.channel.direction"], channel) end
    local _, kind = r:add("pbdp.diag.channel.type")
    if kind then r.tree:add(f["pbdp.diag.channel.error"], kind) end
end

local function diag_block(r, dpv1)
    local header = r.tvb(r.at, 1):uint()
    local kind, length = bit.rshift(header, 6), bit.band(header, 0x3F)
    if kind == 2 then length = 3 elseif kind == 3 then length = 1 end
    local size = math.min(math.max(length, 1), r:left())
    local range = r.tvb(r.at, size)
    local tree = r.tree:add(f["pbdp.diag.block"], range)
    tree:add(f["pbdp.diag.block.type"], range(0, 1))
    if length ~= size then tree:add_proto_expert_info(e.short, "Block of " .. length .. " bytes does not fit") end
    local block = Reader.new(r.tvb, r.at, r.at + size, tree)
    r.at = r.at + size
    if kind == 2 then return diag_channel(block) end
    if kind == 3 then return end
    block:add("pbdp.diag.block.length")
    if kind == 0 and size >= 4 and dpv1 then return diag_slot(block) end
    while kind == 1 and block:left() > 0 do block:add("pbdp.diag.modules") end
    block:rest("pbdp.diag.user")
end

-- The names of the bits of a byte that are set.
local function names_of_set(bits, value)
    local set = {}
    for _, each in ipairs(bits) do
        if bit.band(value, each[1]) ~= 0 then set[#set + 1] = each[2] end
    end
    return table.concat(set, ", ")
end

function dp.diagnosis(r, dpv1)
    local status_1, _, item = r:add_flags("pbdp.diag.status_1")
    r:add_flags("pbdp.diag.status_2")
    r:add_flags("pbdp.diag.status_3")
    r:add("pbdp.diag.master")
    r:add("pbdp.ident", 2)
    while r:left() > 0 do diag_block(r, dpv1) end
    if not status_1 or status_1 == 0 then return "" end
    local set = names_of_set(words.diag_status_1, status_1)
    item:add_proto_expert_info(e.diagnosis, "Diagnosis: " .. set)
    return set
end

function dp.global_control(r)
    local command = r:add_flags("pbdp.control.command")
    local groups = r:add_flags("pbdp.control.groups")
    if r:left() > 0 then r:rest("pbdp.data") end
    if not groups then return "" end
    local set = names_of_set(words.control_command, command)
    return (set == "" and "operate" or set) .. (groups == 0 and ", all groups" or string.format(", groups 0x%02X", groups))
end

function dp.set_slave_address(r)
    local address = r:add("pbdp.new_address")
    r:add("pbdp.ident", 2)
    r:add("pbdp.no_change")
    r:rest("pbdp.remote_data")
    return address and "new address " .. address or ""
end

local function plain(name)
    return function(r)
        local size = r:left()
        r:rest(name)
        return size == 0 and "" or size .. (size == 1 and " byte" or " bytes")
    end
end

-- By the slave's SAP; 0xFF is the default SAP.
dp.requests = {
    [55] = dp.set_slave_address, [58] = dp.global_control, [61] = dp.set_prm, [62] = dp.cfg,
    [255] = plain("pbdp.outputs"),
}
dp.responses = {
    [56] = plain("pbdp.inputs"), [57] = plain("pbdp.outputs"), [59] = dp.cfg, [60] = dp.diagnosis,
    [255] = plain("pbdp.inputs"),
}
dp.other = plain("pbdp.data")

return dp
