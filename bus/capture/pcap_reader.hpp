#pragma once
// Telegrams out of pcap and pcapng files, of either byte order.
#include <iosfwd>
#include <string_view>

#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

/// Whether a file that begins so (4 bytes at least) is a pcapng or a pcap file.
bool begins_as_pcapng(std::string_view beginning);
bool begins_as_pcap(std::string_view beginning);

/// Tells one packet after the other and keeps none. Its time counts from 1970 when the first packet is of that day, as
/// those of simulations are; else from the first packet. Throws CaptureError, after what stood before the fault was
/// told.
void read_pcapng(std::istream& in, const TakeTelegram& take);
void read_pcap(std::istream& in, const TakeTelegram& take);

}  // namespace dsdpv1::bus::capture
