#pragma once
// The telegrams between masters and a station, from the two wires between the station and its line.
#include <optional>
#include <vector>

#include "lab/calibrate/line.hpp"

namespace dsdpv1::calibrate {

/// A request, and the chip's answer to it.
struct Exchange {
  const LineTelegram* request = nullptr;
  const LineTelegram* answer = nullptr;  ///< nullptr: none
  std::optional<Span> idle = {};         ///< bit times of silence on the line before it; absent: unknown
  bool repeats = false;                  ///< the chip may answer it from memory (S26)
  bool same = false;                     ///< repeats, and the request answered before was read: the same frame

  /// A right request to the station only: data exchanges and other SRD, FDL status, SDN ...
  bool is_request() const {
    return request->right && request->telegram.is_request() && request->telegram.da != bus::kBroadcast;
  }
  /// SRD to this SAP; absent: to the default SAP.
  bool is_srd(std::optional<std::uint8_t> dsap) const;
  /// A right answer of this kind.
  bool acknowledged() const;
  bool refused(std::uint8_t fc) const;
  /// A data exchange that was carried out.
  bool exchanged() const;
};

struct Conversation {
  std::vector<LineTelegram> received = {};        ///< by the station, without its own
  std::vector<LineTelegram> sent = {};            ///< by it
  std::vector<Exchange> exchanges = {};           ///< requests to it, answered or not
  std::vector<const LineTelegram*> unasked = {};  ///< sent without a request before them
};

/// `end`: of the capture. `address`: the station's; absent: that of the answered station.
Conversation conversation_of(const Trace& rxd, const Trace& txd, Tick end, const TimeBase& time,
                             std::optional<int> address);

}  // namespace dsdpv1::calibrate
