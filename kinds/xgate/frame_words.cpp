#include "kinds/xgate/frame_words.hpp"

#include <fmt/format.h>

#include "model/xgate/mailbox.hpp"

namespace dsdpv1::xgate {
namespace {

const char* name_of(unsigned command, unsigned asked) {
  const bool answer = asked != 0;
  switch (command) {
    case 0x01: return "read device";
    case 0x02: return "write device";
    case 0x03: return "set rate";
    case 0x04: return "initialise";
    case 0x12: return "set mode";
    case 0x13: return "set step";
    case 0x15: return "set LEDs";
    case 0x16: return "set watchdog";
    case 0x20: return answer ? "outputs" : "exchange";
    case 0x21:
      if (!answer) return "exchange, user parameters known";
      return asked == 0x20 ? "outputs, new user parameters" : "outputs";
    case 0x22: return "read user parameters";
    case 0x23: return "read configuration";
    case 0x24: return "read lengths";
    case 0x30: return answer ? "requests" : "answers";
    case 0x31: return "diagnosis";
    default: return "unknown command";
  }
}

const char* error_name(unsigned type, unsigned code) {
  switch (type << 8 | code) {
    case 0x101: return "XOR of the initialisation";
    case 0x102: return "address";
    case 0x103: return "length of the I/O configuration";
    case 0x104: return "configuration";
    case 0x201: return "overflow";
    case 0x202: return "too few bytes";
    case 0x203: return "sending";
    case 0x204: return "XOR";
    case 0x210: return "ring buffer overflow";
    case 0x301: return "parameters differ";
    case 0x302: return "configuration differs";
    case 0x303: return "data exchange";
    case 0x304: return "not connected";
    case 0x401: return "command";
    case 0x402: return "parameter of the command";
    case 0x403: return "resource";
    case 0x404: return "hardware";
    case 0x405: return "time value";
    case 0x406: return "rate";
    default: return "unknown";
  }
}

/// Table 4.7; an answer of an error, table 4.8.
std::string mailbox_words(const Mailbox& box) {
  if (box.size < 4) return fmt::format("id {}, {} bytes", box.id, box.size);
  const std::uint8_t* pdu = box.data;
  if ((pdu[0] & 0x80) != 0) return fmt::format("id {}, {:02X} refused {:02X} {:02X}", box.id, pdu[0], pdu[2], pdu[3]);
  const char* name = pdu[0] == 0x5E ? "read" : pdu[0] == 0x5F ? "write" : pdu[0] == 0x51 ? "transport" : "function";
  return fmt::format("id {}, {} slot {} index {} length {}", box.id, name, pdu[1], pdu[2], pdu[3]);
}

std::string requests_words(const Frame& frame, MailboxForm form) {
  std::string words;
  Mailbox box;
  for (MailboxReader reader(frame, form); !reader.at_end() && reader.read(box);) words += ": " + mailbox_words(box);
  return words;
}

}  // namespace

std::string error_words(unsigned type, unsigned code) {
  return fmt::format("error {}/{}: {}", type, code, error_name(type, code));
}

std::string words_of(const Frame& frame, MailboxForm form, std::uint8_t asked) {
  const bool answer = asked != 0;
  const std::string name = fmt::format("{:02X} {}", frame.command, name_of(frame.command, asked));
  const std::string flag = (frame.special & kAlarmFlag) == 0 ? ""
                           : answer                          ? ", alarm acknowledged"
                                                             : ", acknowledgement known";
  if (answer && (frame.special & kErrorFlag) != 0 && frame.size() >= 2)
    return fmt::format("{:02X} {}{}", frame.command, error_words(frame.at(0), frame.at(1)), flag);
  if (frame.command == 0x30) return name + requests_words(frame, form) + flag;
  return fmt::format("{}, {} bytes{}", name, frame.size(), flag);
}

}  // namespace dsdpv1::xgate
