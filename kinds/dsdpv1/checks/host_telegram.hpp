#pragma once
// The requests of the host to a DSDPV1-RSU, under the names used by the checks.
#include "kinds/dsdpv1/port/host_telegram.hpp"

namespace dsdpv1::checks {

using HostTelegram = tb::HostRequest;
using tb::HostReply;
using SerialPort = tb::HostLink;
using tb::TelegramKind;

constexpr unsigned kOwnershipCell = 0x014, kUartIntervalCell = 0x019, kUartTsdrCell = 0x01A;

}  // namespace dsdpv1::checks
