-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- Telegrams by type, service and station, and response times: printed by tshark at its end, a window in Wireshark.
local words = ...
if type(words) ~= "table" then return end

local statistics = {}

-- Field extractors must be there before the first packet.
local names = {"type", "station", "fc.request", "fc.response", "tsdr", "tsdr_bits", "unanswered.station",
               "damaged", "wrong"}
local get = {}
for _, name in ipairs(names) do get[name] = Field.new("pbdl." .. name) end
local service_of = Field.new("pbdp.service")

local function value(name)
    local info = get[name]()
    if info == nil then return nil end
    return info.value
end

local function count(list, key) list[key] = (list[key] or 0) + 1 end

local function station(counts, address)
    local all = counts.stations
    all[address] = all[address] or {requests = 0, answers = 0, unanswered = 0, refused = 0, times = 0, sum = 0}
    return all[address]
end

local function add_time(entry, seconds, bits)
    entry.times, entry.sum = entry.times + 1, entry.sum + seconds
    if not entry.min or seconds < entry.min then entry.min, entry.min_bits = seconds, bits end
    if not entry.max or seconds > entry.max then entry.max, entry.max_bits = seconds, bits end
end

local function count_station(counts, request)
    local address = value("station")
    local silent = value("unanswered.station")
    if silent then station(counts, silent).unanswered = station(counts, silent).unanswered + 1 end
    if not address then return end
    local entry = station(counts, address)
    if request then
        entry.requests = entry.requests + 1
        return
    end
    entry.answers = entry.answers + 1
    local code = value("fc.response")
    if code and code >= 1 and code <= 3 then entry.refused = entry.refused + 1 end
    local tsdr = value("tsdr")
    if tsdr then add_time(entry, tsdr:tonumber(), value("tsdr_bits")) end
end

local function add(counts)
    local wrong = value("wrong") ~= nil
    counts.all = counts.all + 1
    if value("damaged") then counts.damaged = counts.damaged + 1 end
    count(counts.types, wrong and "wrong" or value("type"))
    if wrong then return end
    local request, service = value("fc.request"), service_of()
    if service then count(counts.services, tostring(service.value) .. (request and " request" or " response")) end
    count_station(counts, request)
end

local function new_counts() return {all = 0, damaged = 0, types = {}, services = {}, stations = {}} end

local function sorted(list)
    local keys = {}
    for key in pairs(list) do keys[#keys + 1] = key end
    table.sort(keys)
    return keys
end

local function text_of(counts)
    local lines = {}
    local function say(...) lines[#lines + 1] = string.format(...) end
    say("PROFIBUS telegrams: %d, damaged on the line: %d", counts.all, counts.damaged)
    for _, kind in ipairs(sorted(counts.types)) do say("  %-26s %8d", kind, counts.types[kind]) end
    say("Services")
    for _, name in ipairs(sorted(counts.services)) do say("  %-26s %8d", name, counts.services[name]) end
    say("Station  requests   answers  unanswered  refused   TSDR min / us   mean / us    max / us   bit times")
    for _, address in ipairs(sorted(counts.stations)) do
        local s = counts.stations[address]
        local times = s.min and string.format("%16.3f %11.3f %11.3f   %.2f .. %.2f", s.min * 1e6, s.sum / s.times * 1e6,
                                              s.max * 1e6, s.min_bits, s.max_bits) or ""
        say("%7d %9d %9d %11d %8d%s", address, s.requests, s.answers, s.unanswered, s.refused, times)
    end
    return table.concat(lines, "\n")
end

local function listener(counts)
    local tap = Listener.new("frame", "pbdl")
    function tap.packet() add(counts[1]) end
    function tap.reset() counts[1] = new_counts() end
    return tap
end

local printer
function statistics.enable(wanted)
    if wanted and not printer and not gui_enabled() then
        local counts = {new_counts()}
        printer = listener(counts)
        function printer.draw() print(text_of(counts[1])) end
    elseif not wanted and printer then
        printer:remove()
        printer = nil
    end
end

local function show_window()
    local counts, window = {new_counts()}, TextWindow.new("PROFIBUS statistics")
    local tap = listener(counts)
    function tap.draw() window:set(text_of(counts[1])) end
    window:set_atclose(function() tap:remove() end)
    retap_packets()
end

function statistics.add_menu()
    if gui_enabled() then register_menu("PROFIBUS telegrams", show_window, MENU_STAT_UNSORTED) end
end

return statistics
