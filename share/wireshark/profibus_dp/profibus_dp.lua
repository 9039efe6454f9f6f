-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- PROFIBUS DP for Wireshark and tshark: data link layer (pbdl), DP with DPV0 and DPV1 (pbdp).
-- docs/captures.md of dsdpv1 says how to install it and what its filters are.
if not __DIR__ then return end
local function load(name, ...) return assert(loadfile(__DIR__ .. "/" .. name .. ".lua"))(...) end
local words = load("words")
local fields = load("fields", words)
local Reader = load("reader", fields)
local dp = load("dp", fields, Reader, words)
local dpv1 = load("dpv1", fields, words)
local pairing = load("pairing")
local f, e = fields.f, fields.e

local pbdl = Proto("pbdl", "PROFIBUS Data Link")
local pbdp = Proto("pbdp", "PROFIBUS DP")
pbdl.fields, pbdp.fields, pbdl.experts = fields.link, fields.dp, fields.e
pbdl.prefs.links = Pref.range("Link types", "147-162", "USER link types whose packets are PROFIBUS telegrams", 162)
pbdl.prefs.baud = Pref.uint("Baud rate / bit/s", 0, "0: as the capture says")
pbdl.prefs.statistics = Pref.bool("Statistics", false, "tshark lists telegrams by type, service and station at the end")

local packet_flags = Field.new("frame.packet_flags")
local comment = Field.new("frame.comment")
local description = Field.new("frame.interface_description")

local kSlaveDiag, kSetPrm, kDefaultSap = 60, 61, 255
local kinds = {[0x10] = "SD1", [0x68] = "SD2", [0xA2] = "SD3", [0xDC] = "SD4", [0xE5] = "SC"}

-- ---------------------------------------------------------------------------------------------------- the frame's form
-- Where the body (DA to the last data byte) stands and how long the telegram is; nil and why when it is none.
local function shape_of(tvb)
    local sd, size = tvb(0, 1):uint(), tvb:len()
    local kind = kinds[sd]
    if not kind then return nil, string.format("0x%02X is no start delimiter", sd) end
    if kind == "SC" then return {kind = kind, size = 1} end
    if kind == "SD4" then return {kind = kind, body = 1, stop = 3, size = 3} end
    if kind == "SD1" then return {kind = kind, body = 1, stop = 4, size = 6} end
    if kind == "SD3" then return {kind = kind, body = 1, stop = 12, size = 14} end
    if size < 4 then return nil, "cut off" end
    local le, ler = tvb(1, 1):uint(), tvb(2, 1):uint()
    if le < 4 or le > 249 then return nil, "LE is " .. le .. ", expected 4 to 249" end
    if le ~= ler then return nil, "LE and LEr differ" end
    if tvb(3, 1):uint() ~= 0x68 then return nil, "the fourth byte is no second SD2" end
    return {kind = kind, body = 4, stop = 4 + le, size = 6 + le}
end

local function sum_of(tvb, from, stop)
    local sum = 0
    for at = from, stop - 1 do sum = sum + tvb(at, 1):uint() end
    return sum % 256
end

-- The telegram as a table; `wrong` says why it is none.
local function parse(tvb)
    local t, why = shape_of(tvb)
    if not t then return {kind = "wrong", wrong = why, size = tvb:len()} end
    if tvb:len() < t.size then
        t.wrong = "cut off"
        return t
    end
    if t.kind == "SC" then return t end
    t.da, t.sa = bit.band(tvb(t.body, 1):uint(), 0x7F), bit.band(tvb(t.body + 1, 1):uint(), 0x7F)
    if t.kind == "SD4" then
        t.token = true
        return t
    end
    t.fc, t.data = tvb(t.body + 2, 1):uint(), t.body + 3
    t.fcs = sum_of(tvb, t.body, t.stop)
    if tvb(t.stop, 1):uint() ~= t.fcs then t.wrong = "wrong FCS" end
    if tvb(t.stop + 1, 1):uint() ~= 0x16 then t.wrong = t.wrong or "wrong end delimiter" end
    for name, address in pairs({dsap = t.body, ssap = t.body + 1}) do t[name] = tvb(address, 1):uint() >= 0x80 end
    if (t.dsap and 1 or 0) + (t.ssap and 1 or 0) > t.stop - t.data then
        t.wrong = t.wrong or "missing SAP"
        t.dsap, t.ssap = nil, nil
        return t
    end
    for _, name in ipairs({"dsap", "ssap"}) do
        if t[name] then
            t[name] = bit.band(tvb(t.data, 1):uint(), 0x3F)
            t.data = t.data + 1
        else
            t[name] = nil
        end
    end
    return t
end

local function describe_request(t)
    if not t.fc then return end
    t.request = bit.band(t.fc, 0x40) ~= 0
    t.function_code = bit.band(t.fc, 0x0F)
    if not t.request then return end
    t.fcb, t.fcv = bit.band(t.fc, 0x20) ~= 0, bit.band(t.fc, 0x10) ~= 0
    local sdn = t.function_code == 4 or t.function_code == 6
    t.wants_answer = not sdn and t.da ~= 127
end

-- ----------------------------------------------------------------------------------------------------- what surrounds it
local function baud_of()
    if pbdl.prefs.baud ~= 0 then return pbdl.prefs.baud end
    local told = description()
    return told and tonumber(tostring(told.value):match("(%d+) bit/s"))
end

local function nstime(seconds)
    local ns = math.floor(seconds * 1e9 + 0.5)
    return NSTime.new(math.floor(ns / 1e9), ns % 1e9)
end

local function add_duration(tree, t)
    t.baud = baud_of()
    if not t.baud or t.baud == 0 then return end
    tree:add(f["pbdl.baud"], t.baud):set_generated()
    tree:add(f["pbdl.duration"], nstime(t.size * 11 / t.baud)):set_generated()
end

local function add_damage(tree)
    local flags = packet_flags()
    if not flags or bit.band(flags.value, 0xFFFF0000) == 0 then return end
    local item = tree:add(f["pbdl.damaged"], true)
    item:set_generated()
    local said = {}
    for _, each in ipairs({comment()}) do said[#said + 1] = tostring(each.value) end
    item:add_proto_expert_info(e.damage, "Damaged on the line: " .. table.concat(said, "; "))
end

local function add_response_time(tree, pinfo, info, baud)
    if not baud or baud == 0 then return end
    local tsdr = pinfo.rel_ts - (info.request_time + info.request_size * 11 / baud)
    tree:add(f["pbdl.tsdr"], nstime(tsdr)):set_generated()
    tree:add(f["pbdl.tsdr_bits"], math.floor(tsdr * baud * 100 + 0.5) / 100):set_generated()
end

local function add_pairing(tree, pinfo, info, baud)
    if info.station then tree:add(f["pbdl.station"], info.station):set_generated() end
    if info.before then
        tree:add(f["pbdl.unanswered"], info.before):set_generated()
        local item = tree:add(f["pbdl.unanswered.station"], info.before_station)
        item:set_generated()
        item:add_proto_expert_info(e.before_unanswered)
    end
    if info.response then tree:add(f["pbdl.response_in"], info.response):set_generated() end
    if info.unanswered then tree:add_proto_expert_info(e.no_answer) end
    if info.repeated then tree:add_proto_expert_info(e.repeated) end
    if info.unexpected then tree:add_proto_expert_info(e.unexpected) end
    if not info.request then return end
    tree:add(f["pbdl.response_to"], info.request):set_generated()
    add_response_time(tree, pinfo, info, baud)
end

-- ------------------------------------------------------------------------------------------------------ the tree's items
local function add_address(tree, tvb, at, name)
    tree:add(f[name], tvb(at, 1))
    tree:add(f[name .. ".extension"], tvb(at, 1))
    tree:add(f["pbdl.addr"], tvb(at, 1)):set_hidden()
end

local function add_function(tree, tvb, t)
    local range = tvb(t.body + 2, 1)
    local item = tree:add(f["pbdl.fc"], range)
    local function add(name) return item:add(f["pbdl.fc." .. name], range) end
    add("request")
    if t.request then
        add("fcb")
        add("fcv")
        return add("function")
    end
    add("station_type")
    local code, response = t.function_code, add("response")
    if code >= 1 and code <= 3 then
        response:add_proto_expert_info(e.refused, "Refused: " .. words.response[code])
    elseif code == 9 then
        response:add_proto_expert_info(e.no_data)
    end
end

local function add_end(tree, tvb, t)
    local item = tree:add(f["pbdl.fcs"], tvb(t.stop, 1))
    item:add(f["pbdl.fcs.right"], t.fcs == tvb(t.stop, 1):uint()):set_generated()
    if t.fcs ~= tvb(t.stop, 1):uint() then
        item:add(f["pbdl.fcs.expected"], t.fcs):set_generated()
        item:add_proto_expert_info(e.fcs_wrong, string.format("Wrong FCS, 0x%02X is right", t.fcs))
    end
    tree:add(f["pbdl.ed"], tvb(t.stop + 1, 1))
end

local function add_frame(tree, tvb, t)
    tree:add(f["pbdl.type"], t.kind):set_generated()
    tree:add(f["pbdl.sd"], tvb(0, 1))
    if t.kind == "SD2" and t.body then
        tree:add(f["pbdl.le"], tvb(1, 1))
        tree:add(f["pbdl.ler"], tvb(2, 1))
        tree:add(f["pbdl.sd2r"], tvb(3, 1))
    end
    if not t.da then return end
    add_address(tree, tvb, t.body, "pbdl.da")
    add_address(tree, tvb, t.body + 1, "pbdl.sa")
    if not t.fc then return end
    add_function(tree, tvb, t)
    local at = t.body + 3
    for _, name in ipairs({"dsap", "ssap"}) do
        if t[name] then
            tree:add(f["pbdl." .. name], tvb(at, 1))
            at = at + 1
        end
    end
    if t.stop > t.data then tree:add(f["pbdl.data"], tvb(t.data, t.stop - t.data)) end
    add_end(tree, tvb, t)
end

local function add_wrong(tree, tvb, t)
    local item = tree:add(f["pbdl.wrong"], t.wrong)
    item:set_generated()
    item:add_proto_expert_info(e.shape, "No right telegram: " .. t.wrong)
    local known = t.kind == "wrong" and 0 or t.size
    if tvb:len() > known then tree:add(f["pbdl.surplus"], tvb(known)) end
end

-- ---------------------------------------------------------------------------------------------------------------- services
-- The slave's SAP of a telegram with data for a DP service, nil for others (FDL status, a negative answer).
local function service_of(t, info)
    if t.wrong or not t.fc then return nil end
    local sap = t.request and t.dsap or not t.request and t.ssap or nil
    if sap then return sap end
    if t.request then return (t.function_code >= 12 and t.function_code <= 13) and kDefaultSap or nil end
    local asked = info.function_asked
    local answered = info.sap == kDefaultSap and asked and asked >= 12 and asked <= 13
    return (answered and (t.function_code >= 8 and t.function_code ~= 9)) and kDefaultSap or nil
end

-- MSAC2 is between the slave's SAPs below 49 and the master's SAP 50 or that of an Initiate; other protocols use these, too.
local function is_msac2(t, sap, info)
    local master
    if t.request then master = t.ssap else master = t.dsap end
    return sap < 49 and (master == 50 or info.msac2)
end

local function dissect_service(t, info, tvb, tree, root)
    local sap = service_of(t, info)
    if not sap then return nil end
    local known_sap = sap >= 49 or is_msac2(t, sap, info)
    local name = sap == kDefaultSap and "Data_Exchange" or known_sap and words.service[sap] or "SAP " .. sap
    local title = string.format("PROFIBUS DP, %s %s", name, t.request and "request" or "response")
    local item = root:add(pbdp, tvb(t.data, t.stop - t.data), title)
    item:add(f["pbdp.service"], name):set_generated()
    local reader = Reader.new(tvb, t.data, t.stop, item)
    local said
    if sap <= 51 and known_sap then
        said = dpv1(reader, not t.request)
    elseif t.stop == t.data and sap ~= kDefaultSap and not (t.request and dp.requests[sap]) then
        said = ""
    else
        local known = (t.request and dp.requests or dp.responses)[sap] or dp.other
        said = known(reader, info.dpv1)
    end
    if said ~= "" then item:append_text(": " .. said) end
    return name, said
end

local function note_dpv1(t, info, tvb)
    if t.wrong or not t.fc then return end
    if t.request and t.dsap == kSetPrm then
        local enabled = dp.enables_dpv1(tvb, t.data, t.stop)
        if enabled ~= nil then pairing.note_dpv1(t.da, enabled) end
    elseif t.ssap == kSlaveDiag then
        info.dpv1 = pairing.dpv1_of(t.sa)
    end
end

-- ---------------------------------------------------------------------------------------------------------------- in words
local function link_words(t)
    if t.kind == "SC" then return "Short acknowledge" end
    if t.token then return "Token" end
    if t.request then return words.request[t.function_code] or "reserved function" end
    return words.response[t.function_code] or "reserved code"
end

local function fill_columns(pinfo, t, info, service, said)
    local source = t.sa or info.station
    pinfo.cols.protocol = service and (service:find("^MSAC") and "DPV1" or "DP") or "PBDL"
    if source and not t.wrong then pinfo.cols.src = tostring(source) end
    if t.da then pinfo.cols.dst = tostring(t.da) end
    local text = service and string.format("%s %s", service, t.request and "request" or "response") or link_words(t)
    if service and not t.request and t.function_code ~= 8 and t.function_code ~= 0 and t.function_code ~= 10 then
        text = text .. " " .. link_words(t)
    end
    if said and said ~= "" then text = text .. ": " .. said end
    pinfo.cols.info = t.wrong and "Wrong telegram: " .. t.wrong or text
end

local kMs2Rm, kImmediate, kAbort = 49, 0x56, 0x58

local function note_msac2(t, info, tvb)
    if t.wrong or not (t.dsap and t.ssap) then return end
    local pdu = t.stop > t.data and tvb(t.data, 1):uint()
    if not t.request and t.ssap == kMs2Rm and pdu == kImmediate and t.stop > t.data + 1 then
        pairing.open_msac2(t, tvb(t.data + 1, 1):uint())
    end
    info.msac2 = pairing.is_msac2(t)
    if info.msac2 and pdu == kAbort then pairing.close_msac2(t) end
end

local function see(t, tvb, pinfo)
    if pinfo.visited then return pairing.of(pinfo.number) end
    t.frame, t.time, t.right = pinfo.number, pinfo.rel_ts, not t.wrong
    local info = pairing.see(t)
    note_dpv1(t, info, tvb)
    note_msac2(t, info, tvb)
    return info
end

function pbdl.dissector(tvb, pinfo, root)
    if tvb:len() == 0 then return 0 end
    local t = parse(tvb)
    if tvb:len() > t.size then t.wrong = t.wrong or "more bytes than one telegram has" end
    describe_request(t)
    local info = see(t, tvb, pinfo)
    local tree = root:add(pbdl, tvb())
    add_frame(tree, tvb, t)
    if t.wrong then add_wrong(tree, tvb, t) end
    add_duration(tree, t)
    add_pairing(tree, pinfo, info, t.baud)
    add_damage(tree)
    local service, said = dissect_service(t, info, tvb, tree, root)
    fill_columns(pinfo, t, info, service, said)
    return tvb:len()
end

function pbdl.init() pairing.reset() end

-- ------------------------------------------------------------------------------------------------------------- registration
-- A link type of a capture that this Wireshark has no name for, 257 among them.
local function looks_like_profibus(tvb)
    local told = description()
    return told and tostring(told.value):find("^PROFIBUS") or kinds[tvb(0, 1):uint()]
end

local unknown_link = Proto("pbdl_unknown_link", "PROFIBUS in a capture of unknown link type")
function unknown_link.dissector(tvb, pinfo, root)
    if tvb:len() == 0 or not looks_like_profibus(tvb) then return 0 end
    return pbdl.dissector(tvb, pinfo, root)
end

local encapsulations, table_of_links = wtap_encaps or wtap, DissectorTable.get("wtap_encap")
local kFirstUser = 147
table_of_links:add(encapsulations.PROFIBUS_DL or encapsulations.UNKNOWN, encapsulations.PROFIBUS_DL and pbdl or unknown_link)

local function registered(links)
    local wanted = {}
    for first, last in tostring(links):gmatch("(%d+)%-?(%d*)") do
        for link = tonumber(first), tonumber(last) or tonumber(first) do wanted[link] = true end
    end
    return wanted
end

local now = {}
local function register(links)
    local wanted = registered(links)
    for number = 0, 15 do
        local link, encapsulation = kFirstUser + number, encapsulations["USER" .. number]
        if wanted[link] and not now[link] then table_of_links:add(encapsulation, pbdl) end
        if now[link] and not wanted[link] then table_of_links:remove(encapsulation, pbdl) end
    end
    now = wanted
end
register(pbdl.prefs.links)

local statistics = load("statistics", words)
function pbdl.prefs_changed()
    register(pbdl.prefs.links)
    statistics.enable(pbdl.prefs.statistics)
end
statistics.add_menu()
