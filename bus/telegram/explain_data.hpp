#pragma once
// Internal to explain: the data of each service. One summary and one text for each byte of the data.
#include <optional>
#include <string>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1::bus::detail {

struct DataWords {
  std::string summary;
  std::vector<std::string> bytes;  ///< as many as there are data bytes
};

DataWords set_prm_words(const Bytes& data);
DataWords global_control_words(const Bytes& data);
DataWords set_slave_address_words(const Bytes& data);
/// Chk_Cfg request and Get_Cfg answer.
DataWords cfg_words(const Bytes& data);
/// `dpv1`: whether the slave is parameterised for DPV1; unset: unknown, device related blocks are read both ways.
DataWords diag_words(const Bytes& data, std::optional<bool> dpv1);
/// The DPV1 setting in a Set_Prm that locks its slave; nullopt for any other telegram.
std::optional<bool> dpv1_enabled(const Telegram& telegram);
/// "Alarm_Type: process alarm" and "Alarm_Specifier: appears, sequence number 3": of an alarm and of Alarm_Ack.
std::string alarm_type_words(std::uint8_t byte);
std::string alarm_specifier_words(std::uint8_t byte);
/// C1 and C2 PDUs, requests and answers.
DataWords dpv1_words(const Bytes& data, bool response);
/// Process data and everything without a structure: "<what> 0", "<what> 1", ...
DataWords plain_words(const std::string& what, const Bytes& data);

/// "Group_Ident: group 1, 3".
std::string group_words(const char* name, std::uint8_t byte, const char* zero);
/// The names of the set bits, least significant first: "Prm_Req, WD_On"; "none" without any. `names` has 8 entries, an
/// empty one is shown as "bit n".
std::string bit_names(std::uint8_t byte, const char* const (&names)[8]);
std::string hex(const Bytes& bytes);

}  // namespace dsdpv1::bus::detail
