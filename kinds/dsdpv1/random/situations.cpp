#include "kinds/dsdpv1/random/situations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#include "kinds/dsdpv1/random/chip_blocks.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::cosim {
namespace {

using Words = std::vector<std::string>;

/// A detail that distinguishes events: `format` makes a word of 0 a, 1 b, 2 c, 3 and 4 the bytes of a, 5 the DP state.
struct Detail {
  const char* code;
  const char* format;
  Words known;
};

Words both_channels(const Words& words) {
  Words both;
  for (const char* sap : {"48", "47"})
    for (const std::string& word : words) both.push_back(fmt::format(fmt::runtime(word), sap));
  return both;
}

const std::vector<Detail>& details() {
  static const Words channels = both_channels({"SAP {}"});
  static const Words states = {"WAIT_PRM", "WAIT_CFG", "DATA_EXCH"};
  static const std::vector<Detail> all = {
      {"SAP_STATE",
       "SAP {0} in {1}",
       {"SAP 0 in 1", "SAP 0 in 2", "SAP 51 in 1", "SAP 51 in 2", "SAP 55 in 2", "SAP 55 in 3", "SAP 56 in 1",
        "SAP 56 in 2", "SAP 57 in 1", "SAP 57 in 2", "SAP 58 in 1", "SAP 58 in 2", "SAP 58 in 3", "SAP 62 in 1"}},
      {"SAP_MASTER", "SAP {0}", {"SAP 0", "SAP 51", "SAP 61", "SAP 62"}},
      {"SAP_DATA", "SAP {0}", {"SAP 56", "SAP 57", "SAP 59", "SAP 60"}},
      {"PRM_USER_LENGTH", "mode {2}", {"mode 0", "mode 1"}},
      {"GC_SYNC", "B024.2 {0}", {"B024.2 0", "B024.2 1"}},
      {"GC_FREEZE", "B024.1 {0}", {"B024.1 0", "B024.1 1"}},
      {"ADDRESS_DISABLED", "B024.0 {0}, locked {1}", {"B024.0 0, locked 0", "B024.0 1, locked 1"}},
      {"BAUD_FOUND", "{0}", {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"}},
      {"BAUD_LOST", "{5}", states},
      {"WD_ON", "{1} ms", {"1 ms", "10 ms"}},
      {"WD_EXPIRED", "{5}", states},
      {"DIAG", "{0:02X}", {"00", "01", "02", "81", "82"}},
      {"VERDICT_UNEXPECTED", "{0}", {"0", "1"}},
      {"VERDICT_SUPERSEDED", "{0}", {"0", "1"}},
      {"INIT_LIMIT", "B{0:03X}", {"B027", "B028", "B029", "B02A", "B02B", "B02C", "B02D", "B02E"}},
      {"DPV1_SSAP", "SAP {0}", {"SAP 51", "SAP 49", "SAP 48", "SAP 47"}},
      {"DPV1_OPEN", "SAP {0}", {"SAP 51", "SAP 48", "SAP 47"}},
      {"DPV1_REQUEST", "{2:X}", {"A9", "B8", "B1"}},
      {"DPV1_NO_REQUEST", "C{0}", {"C1", "C2"}},
      {"DPV1_ANSWER", "C{3} byte {4}", {"C1 byte 0", "C1 byte 1", "C1 byte 2", "C2 byte 0", "C2 byte 1", "C2 byte 2"}},
      {"DPV1_LENGTH", "C{0}", {"C1", "C2"}},
      {"C1_REQUEST", "{0:X}", {"5E", "5F"}},
      {"C1_ANSWER", "{0:X}", {"5E", "5F", "DE", "DF"}},
      {"C2_INITIATE", "SAP {0}", channels},
      {"C2_INITIATE_REFUSED", "SAP {0}", channels},
      {"C2_ADD_ADDR", "SAP {0}", channels},
      {"C2_CONNECTED", "SAP {0}", channels},
      {"C2_NOT_IN_USE", "SAP {0}", channels},
      {"C2_MASTER", "SAP {0}", channels},
      {"C2_MASTER_ABORT", "SAP {0}", channels},
      {"C2_FREED", "SAP {0}", channels},
      {"C2_REQUEST", "{4:X} on SAP {3}", both_channels({"5E on SAP {}", "5F on SAP {}", "51 on SAP {}"})},
      {"C2_ANSWER", "{1:X} on SAP {0}",
       both_channels({"5E on SAP {}", "5F on SAP {}", "51 on SAP {}", "DE on SAP {}", "DF on SAP {}", "D1 on SAP {}"})},
      {"C2_TIMEOUT", "timer {1} on SAP {0}",
       both_channels({"timer 1 on SAP {}", "timer 2 on SAP {}", "timer 3 on SAP {}"})},
      {"C2_WRONG_REQUEST", "reason {2} on SAP {0}", both_channels({"reason 1 on SAP {}", "reason 2 on SAP {}"})},
      {"C2_ABORT", "{1:X} on SAP {0}", both_channels({"11 on SAP {}", "12 on SAP {}", "13 on SAP {}", "17 on SAP {}"})},
      {"RM_REGISTRY", "row {2} of SAP {0}",
       both_channels({"row 0 of SAP {}", "row 1 of SAP {}", "row 3 of SAP {}", "row 7 of SAP {}"})},
      {"HOST_NOT_OWNER", "R_REQ {1}, R_STA {2}", {"R_REQ 0, R_STA 0", "R_REQ 0, R_STA 1", "R_REQ 1, R_STA 0"}},
      {"HANDSHAKE_HELD_THROUGH_RESET",
       "R_REQ {0}, R_STA {1}",
       {"R_REQ 0, R_STA 1", "R_REQ 1, R_STA 0", "R_REQ 1, R_STA 1"}},
      {"STRAP_CHANGED", "{0}", {"0", "1", "2", "3"}},
      {"SPI_SCK_IDLE", "{0}", {"0", "1"}},
      {"SPI_WRITE_GAP", "heard {2}", {"heard 0", "heard 1"}},
      {"SPI_NO_CLAIM", "{2}", {"0", "1"}},
      {"SPI_BUSY", "{0}", {"0", "1", "2"}},
      {"TELEGRAM_ADDRESS", "{1}", {"0", "1", "2"}},
  };
  return all;
}

const Detail* detail_of(const std::string& code) {
  const auto found =
      std::find_if(details().begin(), details().end(), [&](const Detail& detail) { return code == detail.code; });
  return found == details().end() ? nullptr : &*found;
}

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

/// The port cannot have such an event, whatever its host does (R14, SP15, UA6).
bool is_foreign(const std::string& code, Part part, HostMode mode) {
  const bool parallel = mode == HostMode::kParallel;
  const bool strap = code == "STRAP_CHANGED", shared = code == "HOST_READ_ONLY" || code == "HOST_SETS_BIT";
  if (begins(code, "SPI_")) return mode != HostMode::kSpi;
  if (begins(code, "UART_")) return mode != HostMode::kUart;
  if (begins(code, "TELEGRAM_")) return parallel;
  if (strap) return !dsdpv1::has_serial_ports(part);
  if (shared || parallel) return false;
  const bool crc = begins(code, "INIT_CRC") || begins(code, "INPUT_CRC") || begins(code, "DIAG_CRC") ||
                   begins(code, "C1_CRC") || begins(code, "C2_CRC");
  return crc || begins(code, "HOST_") || begins(code, "HANDSHAKE_");
}

/// The address of an exchange, which only the UART has (UA9).
bool names_area(const std::string& code, const std::string& word) { return code == "TELEGRAM_ADDRESS" && word != "0"; }

void add(std::vector<Situation>& all, const char* group, const Words& items) {
  for (const std::string& item : items) all.emplace_back(group, item);
}

/// S13, S14, S20: the possible answers to a service in each state.
Words services() {
  struct Service {
    const char* name;
    const char* answers[3];  ///< in WAIT_PRM, WAIT_CFG, DATA_EXCH
  };
  static constexpr Service kServices[] = {
      {"Data_Exchange", {"RS", "RS", "data,data of high priority,SC,high priority,RR,RS"}},
      {"Set_Slave_Add", {"SC,RR,RS", "RS", "RS"}},
      {"RD_Inp", {"RS", "RS", "data,SC,RR"}},
      {"RD_Outp", {"RS", "RS", "data,SC,RR"}},
      {"Get_Cfg", {"data,SC,RR", "data,SC,RR", "data,RR"}},
      {"Slave_Diag", {"data,RR", "data,RR", "data,RR"}},
      {"Set_Prm", {"SC,RS", "SC,RS", "SC,RS"}},
      {"Chk_Cfg", {"RS", "SC,RR,RS", "SC,RR,RS"}},
      {"SRD to SAP 58", {"RS", "RS", "RS"}},
      {"C1", {"RS", "RS", "data,SC,RR,RS"}},
      {"Initiate", {"data,RS,SC", "data,RS,SC", "data,RS,SC"}},
      {"C2", {"data,SC,RR,RS", "data,SC,RR,RS", "data,SC,RR,RS"}},
      {"another SAP", {"RS", "RS", "RS"}},
      {"FDL status", {"OK", "OK", "OK"}},
      {"another function", {"RS", "RS", "RS"}},
  };
  Words all;
  for (const Service& service : kServices) {
    for (unsigned state = 1; state <= 3; ++state) {
      const std::string answers = service.answers[state - 1];
      for (std::size_t at = 0; at <= answers.size();) {
        const std::size_t comma = std::min(answers.find(',', at), answers.size());
        all.push_back(fmt::format("{} in {}: {}", service.name, dp_state_name(state), answers.substr(at, comma - at)));
        at = comma + 1;
      }
    }
  }
  return all;
}

Words transfers() { return {std::begin(kAccessParts) + kFirstTransfer, std::end(kAccessParts)}; }

Words cells_read() {
  Words all;
  for (const ChipBlock& block : kChipBlocks)
    for (const char* cells : kBlockCells) all.push_back(fmt::format("{}, {}", item_of(block.part), cells));
  return all;
}

/// Relative to the chip's accesses: in none, in each part of one.
Words phases() {
  Words all = {"-"};
  all.insert(all.end(), std::begin(kAccessParts), std::end(kAccessParts));
  return all;
}

Words sync_and_freeze() {
  Words all;
  for (const char* held : {"nothing held", "Sync", "Freeze", "Sync and Freeze"})
    for (const char* command :
         {"Sync", "Unsync", "Freeze", "Unfreeze", "Sync and Freeze", "Unsync and Unfreeze", "Clear_Data"})
      all.push_back(fmt::format("{}: {}", held, command));
  return all;
}

Words accesses() {
  Words all;
  for (const char* what : {"read", "write"})
    for (const char* owner : {"owned", "R_REQ alone", "R_STA alone", "not owned"})
      for (const char* chip : {"the chip away", "the chip in an access"}) {
        if (std::strcmp(owner, "owned") == 0 && std::strcmp(chip, "the chip in an access") == 0) continue;
        all.push_back(fmt::format("{}, {}, {}", what, owner, chip));
      }
  all.insert(all.end(), {"read, owned, the chip in an access", "write, owned, the chip in an access"});
  return all;
}

Words host_telegrams(HostMode mode) {
  Words all;
  const char* third = mode == HostMode::kSpi ? "read and write" : "exchange";
  for (const std::string kind : {"read", "write", third}) {
    const bool names_address = mode == HostMode::kUart || kind != third;
    for (const char* code : {"00", "01", "04"}) all.push_back(kind + ", code " + code);
    if (kind != "read") all.push_back(kind + ", code 0C");  // a read is never too long
    if (kind != "read" && names_address) all.push_back(kind + ", code 0E");
    for (const char* code : {"02", "06"})
      if (names_address) all.push_back(kind + ", code " + code);
    if (mode == HostMode::kSpi && kind != "read") all.push_back(kind + ", refused");
  }
  return all;
}

/// D16. With a serial port no CRC of inputs is checked (SP15).
Words meanings(HostMode mode) {
  Words all = {"history: B011.7 falls", "present: B011.7 falls"};
  if (mode == HostMode::kParallel)
    all.insert(all.end(),
               {"history: B011.7 clears it", "history: B011.7 with a wrong block", "history: a wrong block sets it",
                "history: a right block leaves it", "present: B011.7 leaves it"});
  return all;
}

Words replies_of_exchanges() {
  Words all;
  for (const char* news : {"outputs", "parameters", "configuration", "C1", "C2"})
    for (const char* state : {"", " in DATA_EXCH"}) all.push_back(std::string(news) + state);
  return all;
}

}  // namespace

std::vector<Situation> known_situations(Part part, HostMode mode) {
  std::vector<Situation> all;
  add(all, "DP states",
      {"OFFLINE to WAIT_PRM", "WAIT_PRM to OFFLINE", "WAIT_PRM to WAIT_CFG", "WAIT_CFG to OFFLINE",
       "WAIT_CFG to WAIT_PRM", "WAIT_CFG to DATA_EXCH", "DATA_EXCH to OFFLINE", "DATA_EXCH to WAIT_PRM",
       "DATA_EXCH to WAIT_CFG"});
  add(all, "services", services());
  for (const profibus::Reason reason : dsdpv1::reasons()) {
    const std::string code = profibus::code(reason);
    if (code == "DP_STATE" || is_foreign(code, part, mode)) continue;
    const Detail* detail = detail_of(code);
    add(all, "events", detail == nullptr ? Words{code} : Words{});
    if (detail == nullptr) continue;
    for (const std::string& word : detail->known)
      if (!names_area(code, word) || mode == HostMode::kUart)
        all.emplace_back("events", fmt::format("{} {}", code, word));
  }
  add(all, "Sync and Freeze", sync_and_freeze());
  add(all, "transfers", transfers());
  add(all, "written and read", cells_read());
  add(all, "B00B.2 and B011", meanings(mode));
  add(all, "reserved cells", {"written and read"});
  add(all, "min_TSDR", {"below 11", "above max_TSDR"});
  add(all, "answers to reads", {"C1 shorter", "C1 longer", "C2 shorter", "C2 longer"});
  add(all, "timer U", {"ends after a request", "ends after a turn", "an answer after it"});
  if (part != Part::kDsdpv1) add(all, "requests before answers", {"C1", "C2"});
  add(all, "RESET falls in", phases());
  if (mode == HostMode::kParallel) {
    add(all, "R_REQ rises in", phases());
    add(all, "accesses of the user", accesses());
    return all;
  }
  add(all, mode == HostMode::kSpi ? "XSS falls in" : "RXD falls in", phases());
  add(all, "telegrams of the host", host_telegrams(mode));
  if (mode == HostMode::kUart) add(all, "replies of exchanges", replies_of_exchanges());
  return all;
}

namespace {

/// Rulings of a group's situations that begin, and end, with these words; all that fit count. Where several rulings may
/// have decided, the events tell which.
struct RulingRow {
  const char *group, *begin, *end, *rulings;
};

constexpr RulingRow kRulingRows[] = {
    {"DP states", "OFFLINE", "", "D7"},
    {"DP states", "", "OFFLINE", "D7"},
    {"DP states", "WAIT_PRM", "WAIT_CFG", "S6"},
    {"DP states", "WAIT_CFG", "WAIT_PRM", "S15"},
    {"DP states", "WAIT_CFG", "DATA_EXCH", "D8, P3"},
    {"DP states", "DATA_EXCH", "", "D1, P3, S18"},
    {"DP states", "DATA_EXCH to WAIT", "", "S15"},
    {"services", "", "", "S2, S3, S20"},
    {"services", "", ": data", "S21"},
    {"services", "", ": data of high priority", "S21"},
    {"services", "Data_Exchange", "", "S13"},
    {"services", "Data_Exchange", "high priority", "D9"},
    {"services", "Data_Exchange", ": high priority", "S19"},
    {"services", "Data_Exchange", ": SC", "S19"},
    {"services", "Data_Exchange", ": RR", "S19"},
    {"services", "Set_Slave_Add", "", "S5, S13"},
    {"services", "Set_Slave_Add", ": SC", "S25"},
    {"services", "Set_Slave_Add", ": RR", "S14"},
    {"services", "Set_Slave_Add in WAIT_PRM: RS", "", "S25"},
    {"services", "RD_", "", "S13"},
    {"services", "Get_Cfg", "", "S13"},
    {"services", "Slave_Diag", "", "S13"},
    {"services", "Slave_Diag in DATA_EXCH: data", "", "S23"},
    {"services", "Set_Prm", "", "S13"},
    {"services", "Set_Prm", ": SC", "S14"},
    {"services", "Chk_Cfg", "", "S13"},
    {"services", "Chk_Cfg", ": SC", "S14"},
    {"services", "Chk_Cfg", ": RR", "S14"},
    {"services", "Chk_Cfg in DATA_EXCH: SC", "", "S16"},
    {"services", "SRD to SAP 58", "", "S29"},
    {"services", "another function", "", "S29"},
    {"services", "C1", "", "V1"},
    {"services", "C1 in DATA_EXCH: SC", "", "V8"},
    {"services", "C1 in DATA_EXCH: RR", "", "V8"},
    {"services", "Initiate", ": data", "V2, V7, V10"},
    {"services", "Initiate", ": SC", "V8"},
    {"services", "C2", ": data", "V11"},
    {"services", "C2", ": SC", "V11"},
    {"services", "C2", ": RR", "V8"},
    {"services", "C2 in WAIT", ": data", "V7"},
    {"Sync and Freeze", "", "Sync", "S4"},
    {"Sync and Freeze", "", "Unsync", "S4, S27"},
    {"Sync and Freeze", "", "Freeze", "S4, S27"},
    {"Sync and Freeze", "", "Unfreeze", "S4, S27"},
    {"Sync and Freeze", "", "Clear_Data", "S18"},
    {"transfers", "start-up", "", "H6, D1"},
    {"transfers", "commands", "", "H3"},
    {"transfers", "initialisation", "", "H3, H4, H5"},
    {"transfers", "", "verdict", "H3, H4, H5, D4"},
    {"transfers", "inputs", "", "H3, H4, H5"},
    {"transfers", "diagnosis", "", "H3, H4, H5"},
    {"transfers", "", "answer", "H3, H4, H5"},
    {"transfers", "Set_Prm", "Set_Prm", "H3, H4, P7, D6, D15"},
    {"transfers", "Chk_Cfg", "Chk_Cfg", "H3, H4, P7, D6, D15"},
    {"transfers", "outputs", "", "H3, H4"},
    {"transfers", "", "request", "H3, H4"},
    {"transfers", "status", "", "H3"},
    {"transfers", "status B00B", "", "D5, D13"},
    {"written and read", "", "CRC", "D2, D3"},
    {"written and read", "Set_Prm", "data", "D6"},
    {"written and read", "Chk_Cfg", "header", "D6"},
    {"written and read", "Chk_Cfg", "data", "D6"},
    {"written and read", "C1 request", "header", "V5"},
    {"written and read", "C2 request", "header", "V5"},
    {"B00B.2 and B011", "", "", "D16"},
    {"reserved cells", "", "", "P13"},
    {"min_TSDR", "", "", "S11"},
    {"answers to reads", "", "", "V15"},
    {"timer U", "", "", "V13"},
    {"requests before answers", "", "", "R9"},
    {"RESET falls in", "", "", "P1, P10"},
    {"R_REQ rises in", "", "", "H1, P9"},
    {"accesses of the user", "", "", "P5"},
    {"accesses of the user", "write", "", "P8"},
    {"accesses of the user", "read, R_", "", "P12"},
    {"accesses of the user", "read, not owned", "", "P12"},
    {"accesses of the user", "read, owned", "the chip in an access", "H2, P12"},
    {"accesses of the user", "write, R_", "", "P12"},
    {"accesses of the user", "write, not owned", "", "P12"},
    {"accesses of the user", "write, owned", "the chip in an access", "H2"},
};
/// Both serial ports.
constexpr RulingRow kSerialRows[] = {
    {"DP states", "DATA_EXCH", "", "R4, R12"},  {"DP states", "", "DATA_EXCH", "R12"},
    {"transfers", "start-up", "", "R14"},       {"transfers", "initialisation", "", "SP15"},
    {"transfers", "inputs", "", "SP15"},        {"transfers", "diagnosis", "", "SP15"},
    {"transfers", "", "answer", "SP15"},        {"transfers", "Set_Prm", "Set_Prm", "R12"},
    {"transfers", "Chk_Cfg", "Chk_Cfg", "R12"}, {"written and read", "", "CRC", "SP15"},
    {"RESET falls in", "", "", "R14"},          {"B00B.2 and B011", "", "", "R6"},
    {"telegrams of the host", "", "", "R15"}};
/// The host's telegrams, and the begin of its accesses, have the same names at both.
constexpr RulingRow kSpiRows[] = {{"XSS falls in", "", "", "SP1, R14"},
                                  {"transfers", "initialisation", "", "SP18"},
                                  {"transfers", "", "verdict", "SP18"},
                                  {"transfers", "", "answer", "SP18"},
                                  {"telegrams of the host", "", "", "SP4, SP5, SP6, SP10, SP11"},
                                  {"telegrams of the host", "read, code 00", "", "SP8"},
                                  {"telegrams of the host", "write, code 00", "", "SP9"},
                                  {"telegrams of the host", "read and write", "", "SP16"},
                                  {"telegrams of the host", "", "refused", "SP13"}};
constexpr RulingRow kUartRows[] = {{"RXD falls in", "", "", "UA2"},
                                   {"transfers", "", "verdict", "UA15"},
                                   {"telegrams of the host", "", "", "UA1, UA4"},
                                   {"telegrams of the host", "", "code 00", "UA6"},
                                   {"telegrams of the host", "read", "", "UA5"},
                                   {"telegrams of the host", "write", "", "UA5"},
                                   {"telegrams of the host", "exchange", "", "UA7, UA8"},
                                   {"telegrams of the host", "exchange, code 00", "", "UA9"},
                                   {"telegrams of the host", "exchange, code 01", "", "UA13"},
                                   {"telegrams of the host", "exchange, code 02", "", "UA9, UA13"},
                                   {"telegrams of the host", "exchange, code 04", "", "UA9, UA13"},
                                   {"telegrams of the host", "exchange, code 06", "", "UA9, UA13"},
                                   {"telegrams of the host", "exchange, code 0C", "", "UA9, UA13"},
                                   {"telegrams of the host", "exchange, code 0E", "", "UA9, UA13"},
                                   {"replies of exchanges", "", "", "UA8, UA10, UA11, UA12"}};

bool ends(const std::string& text, const std::string& with) {
  return text.size() >= with.size() && text.compare(text.size() - with.size(), with.size(), with) == 0;
}

template <class Rows>
void add_rulings(std::string& all, const Rows& rows, const Situation& situation) {
  for (const RulingRow& row : rows)
    if (situation.first == row.group && begins(situation.second, row.begin) && ends(situation.second, row.end))
      all += (all.empty() ? "" : ", ") + std::string(row.rulings);
}

}  // namespace

std::string rulings_of(const Situation& situation, HostMode mode) {
  if (situation.first == "events") {
    const std::string code = situation.second.substr(0, situation.second.find(' '));
    for (const profibus::Reason reason : dsdpv1::reasons())
      if (code == profibus::code(reason)) return reason.row().source;
    return {};
  }
  std::string all;
  add_rulings(all, kRulingRows, situation);
  if (mode != HostMode::kParallel) add_rulings(all, kSerialRows, situation);
  if (mode == HostMode::kSpi) add_rulings(all, kSpiRows, situation);
  if (mode == HostMode::kUart) add_rulings(all, kUartRows, situation);
  return all;
}

const char* dp_state_name(unsigned state) {
  static constexpr const char* kNames[] = {"OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH"};
  return kNames[state % std::size(kNames)];
}

std::string event_item(const profibus::Event& event, const std::string& state) {
  std::string code = profibus::code(event.reason);
  const Detail* detail = detail_of(code);
  if (detail == nullptr) return code;
  const std::string word =
      fmt::format(fmt::runtime(detail->format), event.a, event.b, event.c, event.a >> 8, event.a & 0xFF, state);
  const bool known = std::find(detail->known.begin(), detail->known.end(), word) != detail->known.end();
  return code + " " + (known ? word : "other");
}

}  // namespace dsdpv1::cosim
