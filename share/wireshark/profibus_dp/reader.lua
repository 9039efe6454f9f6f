-- SPDX-FileCopyrightText: 2026 the dsdpv1 authors
-- SPDX-License-Identifier: Apache-2.0 OR MIT
-- Walks over the bytes of a telegram and puts them into the tree; never beyond their end.
local fields = ...
if type(fields) ~= "table" then return end

local f, e = fields.f, fields.e
local Reader = {}
Reader.__index = Reader

function Reader.new(tvb, from, stop, tree)
    return setmetatable({tvb = tvb, at = from, stop = stop, tree = tree}, Reader)
end

function Reader:left() return self.stop - self.at end

-- The next n bytes; fewer are told as too short, and nothing is left then.
function Reader:take(n)
    if self:left() < n then
        self.tree:add_proto_expert_info(e.short, "Data too short for their service, at byte " .. self.at)
        self.at = self.stop
        return nil
    end
    local range = self.tvb(self.at, n)
    self.at = self.at + n
    return range
end

-- Value and range of a field of n bytes (1 when not said), nil when they are not there.
function Reader:add(name, n, tree)
    local range = self:take(n or 1)
    if not range then return nil end
    local item = (tree or self.tree):add(f[name], range)
    return range:len() <= 4 and range:uint() or range, range, item
end

-- A byte with the fields that are parts of it below.
function Reader:add_parts(name, parts)
    local value, range, item = self:add(name)
    if not value then return nil end
    for _, part in ipairs(parts) do item:add(type(part) == "string" and f[part] or part, range) end
    return value, range, item
end

-- A byte of flags; the item's text names those that are set.
function Reader:add_flags(name, also)
    local bits = f[name .. ".flags"]
    local value, range, item = self:add_parts(name, bits)
    if value and also then item:add(f[also], range) end
    return value, range, item
end

function Reader:rest(name)
    if self:left() > 0 then return self:add(name, self:left()) end
end

return Reader
