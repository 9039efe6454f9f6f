-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- Which answer belongs to which request. Learnt when telegrams are seen the first time, in order; kept by frame.
local pairing = {}

local frames, pending, last_fcb, dpv1, channels

function pairing.reset()
    frames, last_fcb, dpv1, channels, pending = {}, {}, {}, {}, nil
end
pairing.reset()

-- What is known of a frame: request or response (the other's frame), station, service (the slave's SAP), ...
function pairing.of(frame) return frames[frame] or {} end

local function give_up(info)
    if not pending then return end
    pending.unanswered = true
    info.before, info.before_station = pending.frame, pending.da
    pending = nil
end

-- FCV says that FCB alternates; FCB without FCV begins anew.
local function is_repeated(t)
    local key = t.da .. "/" .. t.sa
    local before = last_fcb[key]
    if t.fcv then
        last_fcb[key] = t.fcb
    elseif t.fcb then
        last_fcb[key] = nil
    end
    return t.fcv and before == t.fcb
end

local function request(t, info)
    give_up(info)
    if not t.request then return end -- the token
    info.station, info.sap, info.repeated = t.da, t.dsap or 255, is_repeated(t)
    info.frame, info.time, info.da, info.size = t.frame, t.time, t.da, t.size
    if t.wants_answer then pending = info end
end

local function response(t, info)
    local asked = pending
    if not asked or (t.sa and t.sa ~= asked.da) then
        info.unexpected = true
        return
    end
    info.station, info.sap, info.function_asked = asked.da, asked.sap, asked.function_code
    info.request, info.request_time, info.request_size = asked.frame, asked.time, asked.size
    asked.response = t.frame
    pending = nil
end

-- A telegram: frame, time, size, request, token, wants_answer, da, sa, dsap, fcv, fcb, function_code; right: whether
-- it can be read.
function pairing.see(t)
    local info = {function_code = t.function_code}
    frames[t.frame] = info
    if not t.right then
        pending = nil -- answered, though wrongly
    elseif t.request or t.token then
        request(t, info)
    else
        response(t, info)
    end
    return info
end

-- Whether the slave was parameterised for DPV1 when the frame was on the line; nil: not known.
function pairing.note_dpv1(slave, enabled) dpv1[slave] = enabled end
function pairing.dpv1_of(slave) return dpv1[slave] end

-- Channels of MSAC2, by the slave and its SAP: the master and its SAP. The answer to an Initiate opens one, an Abort ends it.
local function ends_of(t)
    if t.request then return t.da .. "/" .. t.dsap, t.sa .. "/" .. t.ssap end
    return t.sa .. "/" .. t.ssap, t.da .. "/" .. t.dsap
end
function pairing.open_msac2(t, sap)
    local _, master = ends_of(t)
    channels[t.sa .. "/" .. sap] = master
end
function pairing.is_msac2(t)
    local slave, master = ends_of(t)
    return channels[slave] == master
end
function pairing.close_msac2(t) channels[ends_of(t)] = nil end

return pairing
