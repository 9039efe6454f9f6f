#pragma once
// Alarms of DPV1 as a class-1 master handles them (rulings AL1 to AL8): it enables them in Set_Prm, finds them in
// Slave_Diag and acknowledges each with Alarm_Ack at SAP 51 or 50.
#include <cstdint>
#include <optional>

#include "bus/master/acyclic.hpp"

namespace dsdpv1::bus {

/// The alarms that a master asks of a slave.
struct AlarmParameters {
  /// Bits of DPV1_Status_2: 7 pull and plug, 6 process, 5 diagnostic, 4 manufacturer, 3 status, 2 update; 0: none.
  std::uint8_t enabled = 0;
  int mode = 0;              ///< Alarm_Mode 0 to 7: one of each type, or 2, 4, 8, 12, 16, 24, 32 in all
  bool extra_sap = false;    ///< acknowledges at SAP 50 (GSD: Extra_Alarm_SAP_supp), not between reads and writes at 51
  bool acknowledged = true;  ///< false: never, to test a slave's limits
};

/// The Alarm_Ack for the alarm in the data of a Slave_Diag answer of a slave with DPV1; nullopt: it has none.
std::optional<AcyclicRequest> alarm_ack_for(const Bytes& diagnosis);

}  // namespace dsdpv1::bus
