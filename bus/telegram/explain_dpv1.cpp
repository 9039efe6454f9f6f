// DPV1: the PDUs of C1 and C2 (rulings V1 to V6, V9 to V11, tables 26 to 32). Each PDU is a list of field names; the
// rest is data.
#include <fmt/format.h>

#include <initializer_list>

#include "bus/telegram/dpv1_words.hpp"
#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus::detail {

namespace {

constexpr std::size_t kNegative = 4;       // fn, Error_Decode, Error_Code_1, Error_Code_2
constexpr std::size_t kAlarmAck = 4;       // fn, Slot_Number, Alarm_Type, Alarm_Specifier
constexpr std::size_t kRequestFixed = 12;  // Initiate before Add_Addr
constexpr std::size_t kResponseFixed = 8;  // its answer
constexpr std::size_t kShortAddress = 2, kLongAddress = 4;

int word(const Bytes& data, std::size_t at) { return (data[at] << 8) | data[at + 1]; }

void name_fields(DataWords& words, std::initializer_list<const char*> names, const Bytes& data) {
  std::size_t i = 1;
  for (const char* name : names) {
    if (i >= data.size()) return;
    words.bytes[i] = fmt::format("{}: 0x{:02X}", name, data[i]);
    ++i;
  }
}

std::string too_short(const char* name, const Bytes& data, std::size_t least) {
  return fmt::format("{}, {} bytes, at least {} are needed", name, data.size(), least);
}

void read_error(DataWords& words, const Bytes& data, const char* name) {
  name_fields(words, {"Error_Decode", "Error_Code_1", "Error_Code_2"}, data);
  if (data.size() > 1 && *error_decode_name(data[1]) != '\0')
    words.bytes[1] += fmt::format(" ({})", error_decode_name(data[1]));
  if (data.size() > 2 && data[1] == kDpv1Decode) words.bytes[2] = "Error_Code_1: " + error_code_words(data[2]);
  if (data.size() < kNegative) {
    words.summary = too_short(name, data, kNegative);
    return;
  }
  words.summary = fmt::format("{} refused, {}", name, error_words(data[1], data[2], data[3]));
}

void read_data_set(DataWords& words, const Bytes& data, const char* name) {
  if (data.size() < kNegative) {
    words.summary = too_short(name, data, kNegative);
    return;
  }
  words.bytes[1] = fmt::format("Slot_Number: {}", data[1]);
  words.bytes[2] = fmt::format("Index: {}", data[2]);
  words.bytes[3] = fmt::format("Length: {}", data[3]);
  words.summary = fmt::format("{} slot {} index {} length {}", name, data[1], data[2], data[3]);
}

void read_alarm_ack(DataWords& words, const Bytes& data, const char* name) {
  name_fields(words, {"Slot_Number"}, data);
  if (data.size() < kAlarmAck) {
    words.summary = too_short(name, data, kAlarmAck);
    return;
  }
  words.bytes[1] = fmt::format("Slot_Number: {}", data[1]);
  words.bytes[2] = alarm_type_words(data[2]);
  words.bytes[3] = alarm_specifier_words(data[3]);
  words.summary = fmt::format("{} slot {}, {}, {}", name, data[1], words.bytes[2], words.bytes[3]);
}

/// Add_Addr from `at` on (V10): two APIs, or types, lengths and addresses of exactly these lengths.
std::string read_address(DataWords& words, const Bytes& data, std::size_t at) {
  const std::size_t size = data.size() - at;
  if (size == kShortAddress) {
    words.bytes[at] = fmt::format("S_API: {}", data[at]);
    words.bytes[at + 1] = fmt::format("D_API: {}", data[at + 1]);
    return fmt::format("Add_Addr API {} to API {}", data[at], data[at + 1]);
  }
  if (size < kLongAddress || size != kLongAddress + data[at + 1] + data[at + 3])
    return fmt::format("Add_Addr of {} bytes, neither 2 nor what its lengths say", size);
  words.bytes[at] = fmt::format("S_Type: {}", data[at]);
  words.bytes[at + 1] = fmt::format("S_Len: {}", data[at + 1]);
  words.bytes[at + 2] = fmt::format("D_Type: {}", data[at + 2]);
  words.bytes[at + 3] = fmt::format("D_Len: {}", data[at + 3]);
  const std::size_t source = at + kLongAddress, destination = source + data[at + 1];
  for (std::size_t i = source; i < destination; ++i) words.bytes[i] = fmt::format("S_Addr {}", i - source);
  for (std::size_t i = destination; i < data.size(); ++i) words.bytes[i] = fmt::format("D_Addr {}", i - destination);
  const auto part = [&](std::size_t from, std::size_t to) {
    const Bytes bytes(data.begin() + static_cast<std::ptrdiff_t>(from), data.begin() + static_cast<std::ptrdiff_t>(to));
    return bytes.empty() ? std::string("none") : hex(bytes);
  };
  return fmt::format("Add_Addr type {} {} to type {} {}", data[at], part(source, destination), data[at + 2],
                     part(destination, data.size()));
}

void read_initiate(DataWords& words, const Bytes& data) {
  name_fields(words,
              {"reserved", "reserved", "reserved", "Send_Timeout high (unit 10 ms)", "Send_Timeout low",
               "Features_Supported 1", "Features_Supported 2", "Profile_Features_Supported 1",
               "Profile_Features_Supported 2", "Profile_Ident_Number high", "Profile_Ident_Number low"},
              data);
  if (data.size() < kRequestFixed) {
    words.summary = too_short("Initiate", data, kRequestFixed);
    return;
  }
  words.summary = fmt::format("Initiate, Send_Timeout {} ms, {}", word(data, 4) * 10,
                              (data[6] & 1U) != 0 ? "DS_Read and DS_Write" : "no DS_Read and DS_Write");
  const std::string address = read_address(words, data, kRequestFixed);
  words.summary += ", " + address;
}

void read_initiate_answer(DataWords& words, const Bytes& data) {
  name_fields(words,
              {"Max_Len_Data_Unit", "Features_Supported 1", "Features_Supported 2", "Profile_Features_Supported 1",
               "Profile_Features_Supported 2", "Profile_Ident_Number high", "Profile_Ident_Number low"},
              data);
  if (data.size() < kResponseFixed) {
    words.summary = too_short("Initiate", data, kResponseFixed);
    return;
  }
  const std::string address = read_address(words, data, kResponseFixed);
  words.summary = fmt::format("Initiate accepted, at most {} bytes, {}", data[1], address);
}

void read_immediate(DataWords& words, const Bytes& data) {
  name_fields(words, {"SAP of the channel", "Send_Timeout high (unit 10 ms)", "Send_Timeout low"}, data);
  words.summary = data.size() < kNegative ? too_short("Immediate answer", data, kNegative)
                                          : fmt::format("Immediate answer, channel 0x{:02X}, Send_Timeout {} ms",
                                                        data[1], word(data, 2) * 10);
}

void read_abort(DataWords& words, const Bytes& data) {
  name_fields(words, {"Subnet", "Instance and Reason_Code", "Additional_Detail"}, data);
  constexpr std::size_t kLeast = 3;  // some devices, including this chip, omit Additional_Detail (V2)
  if (data.size() < kLeast) {
    words.summary = too_short("Abort", data, kLeast);
    return;
  }
  words.bytes[1] = "Subnet: " + subnet_words(data[1]);
  words.bytes[2] += ", " + abort_reason_words(data[2]);
  words.summary = fmt::format("Abort, {}, {}", abort_reason_words(data[2]), subnet_words(data[1]));
  if (data.size() > kLeast) words.summary += fmt::format(", detail {}", data[kLeast]);
}

void read_function(DataWords& words, const Bytes& data, const char* name, bool response) {
  switch (data[0]) {
    case function_num::kRead:
    case function_num::kWrite:
    case function_num::kTransport: return read_data_set(words, data, name);
    case function_num::kAlarmAck: return read_alarm_ack(words, data, name);
    case function_num::kInitiate: return response ? read_initiate_answer(words, data) : read_initiate(words, data);
    case function_num::kImmediate: return read_immediate(words, data);
    case function_num::kAbort: return read_abort(words, data);
    default: return;
  }
}

}  // namespace

DataWords dpv1_words(const Bytes& data, bool response) {
  DataWords words = plain_words("data", data);
  if (data.empty()) {
    words.summary = "poll";
    return words;
  }
  const bool error = (data[0] & function_num::kError) != 0;
  const char* name = function_name(data[0]);
  words.summary = name;
  words.bytes[0] = fmt::format("Function_Num: {}{}", name, error ? ", error" : "");
  if (error)
    read_error(words, data, name);
  else
    read_function(words, data, name, response);
  return words;
}

}  // namespace dsdpv1::bus::detail
