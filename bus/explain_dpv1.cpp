// DPV1: the PDUs of C1 and C2 (rulings V1 to V6, tables 26 to 32). Each PDU is a list of field names; what a list does not name is data.
#include <fmt/format.h>

#include <initializer_list>

#include "bus/explain_data.hpp"

namespace bus::detail {

namespace {

constexpr std::uint8_t kErrorBit = 0x80;
enum : std::uint8_t {
  kIdle = 0x48,
  kTransport = 0x51,
  kResourceManager = 0x56,
  kInitiate = 0x57,
  kAbort = 0x58,
  kRead = 0x5E,
  kWrite = 0x5F
};

const char* function_name(std::uint8_t function) {
  switch (function) {
    case kIdle: return "Idle";
    case kTransport: return "Data_Transport";
    case kResourceManager: return "Initiate, channel given";
    case kInitiate: return "Initiate";
    case kAbort: return "Abort";
    case kRead: return "DS_Read";
    case kWrite: return "DS_Write";
    default: return nullptr;
  }
}

std::string error_code_1(std::uint8_t code) {
  static constexpr const char* kApplication[] = {"read error", "write error", "module failure"};
  static constexpr const char* kAccess[] = {"invalid index",     "write length error", "invalid slot",  "type conflict",
                                            "invalid area",      "state conflict",     "access denied", "invalid range",
                                            "invalid parameter", "invalid type"};
  static constexpr const char* kResource[] = {"read constrain conflict", "write constrain conflict", "resource busy",
                                              "resource unavailable"};
  const unsigned kind = code >> 4, detail = code & 0x0FU;
  if (kind == 10 && detail < 3) return fmt::format("application: {}", kApplication[detail]);
  if (kind == 10 && detail == 8) return "application: version conflict";
  if (kind == 10 && detail == 9) return "application: feature not supported";
  if (kind == 11 && detail < 10) return fmt::format("access: {}", kAccess[detail]);
  if (kind == 12 && detail < 4) return fmt::format("resource: {}", kResource[detail]);
  return fmt::format("0x{:02X}", code);
}

void name_fields(DataWords& words, std::initializer_list<const char*> names, const Bytes& data) {
  std::size_t i = 1;
  for (const char* name : names) {
    if (i >= data.size()) return;
    words.bytes[i] = fmt::format("{}: 0x{:02X}", name, data[i]);
    ++i;
  }
}

void read_error(DataWords& words, const Bytes& data, const char* name) {
  name_fields(words, {"Error_Decode", "Error_Code_1", "Error_Code_2"}, data);
  const std::string reason = data.size() > 2 ? error_code_1(data[2]) : "no Error_Code_1";
  if (data.size() > 2) words.bytes[2] = "Error_Code_1: " + reason;
  words.summary = fmt::format("{} refused, {}", name, reason);
}

void read_data_set(DataWords& words, const Bytes& data, const char* name) {
  if (data.size() < 4) {
    words.summary = fmt::format("{}, {} bytes, at least 4 are needed", name, data.size());
    return;
  }
  words.bytes[1] = fmt::format("Slot_Number: {}", data[1]);
  words.bytes[2] = fmt::format("Index: {}", data[2]);
  words.bytes[3] = fmt::format("Length: {}", data[3]);
  words.summary = fmt::format("{} slot {} index {} length {}", name, data[1], data[2], data[3]);
}

void read_initiate(DataWords& words, const Bytes& data, bool response) {
  if (response) {
    name_fields(words,
                {"Max_Len_Data_Unit", "Features_Supported 1", "Features_Supported 2", "Profile_Features_Supported 1",
                 "Profile_Features_Supported 2", "Profile_Ident_Number high", "Profile_Ident_Number low"},
                data);
    return;
  }
  name_fields(words,
              {"reserved", "reserved", "reserved", "Send_Timeout high (unit 10 ms)", "Send_Timeout low",
               "Features_Supported 1", "Features_Supported 2", "Profile_Features_Supported 1",
               "Profile_Features_Supported 2", "Profile_Ident_Number high", "Profile_Ident_Number low"},
              data);
  if (data.size() > 5) words.summary = fmt::format("Initiate, Send_Timeout {} ms", ((data[4] << 8) | data[5]) * 10);
}

void read_function(DataWords& words, const Bytes& data, const char* name, bool response) {
  switch (data[0]) {
    case kRead:
    case kWrite:
    case kTransport: return read_data_set(words, data, name);
    case kInitiate: return read_initiate(words, data, response);
    case kResourceManager:
      return name_fields(words, {"SAP of the channel", "Send_Timeout high (unit 10 ms)", "Send_Timeout low"}, data);
    case kAbort: return name_fields(words, {"Subnet", "Instance and Reason_Code", "Additional_Detail"}, data);
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
  const bool error = (data[0] & kErrorBit) != 0;
  const auto function = static_cast<std::uint8_t>(data[0] & ~kErrorBit);
  const char* name = function_name(function);
  if (name == nullptr) name = "unknown function";
  words.summary = name;
  words.bytes[0] = fmt::format("Function_Num: {}{}", name, error ? ", error" : "");
  if (error) {
    read_error(words, data, name);
  } else {
    read_function(words, data, name, response);
  }
  return words;
}

}  // namespace bus::detail
