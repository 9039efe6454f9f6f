#pragma once
// Reads telegrams from pcap and pcapng files of either byte order.
#include <iosfwd>
#include <string_view>

#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

/// True if a file with this beginning (at least 4 bytes) is a pcapng or a pcap file.
bool begins_as_pcapng(std::string_view beginning);
bool begins_as_pcap(std::string_view beginning);

/// Passes on the packets one by one and keeps none. Time counts from 1970 if the first packet is of that day, as in
/// captures of simulations; else from the first packet. Throws CaptureError, after the telegrams before the fault were
/// passed on.
/// told.
void read_pcapng(std::istream& in, const TakeTelegram& take);
void read_pcap(std::istream& in, const TakeTelegram& take);

}  // namespace dsdpv1::bus::capture
