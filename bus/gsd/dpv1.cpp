// DPV1 as permitted by a GSD file.
#include <fmt/format.h>

#include "bus/gsd/setup.hpp"

namespace dsdpv1::bus {

namespace {

std::string alarm_name(unsigned types) {
  for (std::size_t i = 0; i < kAlarmNames.size(); ++i)
    if ((types >> (kFirstAlarmBit + i) & 1U) != 0) return kAlarmNames[i];
  return "";
}

}  // namespace

bool enables_dpv1(const Gsd& gsd, const Bytes& user_prm) {
  constexpr unsigned kEnable = 0x80;  // DPV1_Status_1.7
  return gsd.dpv1 && !user_prm.empty() && (user_prm.front() & kEnable) != 0;
}

std::string enable_dpv1(const Gsd& gsd, SlaveParameters& parameters) {
  if (!gsd.dpv1) return "the GSD file does not say DPV1_Slave = 1";
  if (!gsd.c1_read_write) return "the GSD file does not say C1_Read_Write_supp = 1";
  parameters.dpv1 = true;
  parameters.c1_response_timeout = gsd.c1_response_timeout.value_or(parameters.c1_response_timeout);
  return {};
}

std::string enable_alarms(const Gsd& gsd, const AlarmParameters& alarms, SlaveParameters& parameters) {
  const unsigned missing = alarms.enabled & ~unsigned{gsd.alarms.types};
  if (missing != 0) return "the GSD file does not say " + alarm_name(missing) + "_Alarm_supp = 1";
  if (alarms.extra_sap && !gsd.alarms.extra_sap) return "the GSD file does not say Extra_Alarm_SAP_supp = 1";
  if (alarms.mode == 0 && !gsd.alarms.type_mode) return "mode 0: the GSD file does not say Alarm_Type_Mode_supp = 1";
  if (const int most = alarms_in_mode(alarms.mode); most > gsd.alarms.sequence_count)
    return fmt::format("mode {}: {} alarms, Alarm_Sequence_Mode_Count of the GSD file is {}", alarms.mode, most,
                       gsd.alarms.sequence_count);
  parameters.alarms = alarms;
  return {};
}

}  // namespace dsdpv1::bus
