#pragma once
// The initialisation block B020.. (tables 2, 12 to 14; rulings D7, D11).
#include "model/profibus/event_log.hpp"
#include "model/profibus/slave_store.hpp"

namespace dsdpv1::dpram {

/// Reads the block that starts with B020 (`size` bytes with its length byte, CRC already right) into `config`. If a
/// length, the address or a mode is out of range, reports an event that names the byte and returns false.
bool parse_init(const std::uint8_t* block, int size, profibus::Cycle now, profibus::EventLog& log,
                profibus::SlaveConfig& config);

}  // namespace dsdpv1::dpram
