// The frame around the data: delimiters, addresses, function codes, SAPs, and the service of a telegram.
#include "bus/telegram/explain.hpp"

#include <fmt/format.h>

#include <iterator>

#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus {

namespace {

using detail::DataWords;

const char* request_function(std::uint8_t function) {
  switch (function) {
    case fc::kSdaLow: return "SDA low";
    case fc::kSdnLow: return "SDN low";
    case fc::kSdaHigh: return "SDA high";
    case fc::kSdnHigh: return "SDN high";
    case fc::kMsrd: return "MSRD";
    case fc::kFdlStatus: return "FDL status";
    case fc::kSrdLow: return "SRD low";
    case fc::kSrdHigh: return "SRD high";
    case fc::kIdent: return "Ident";
    case fc::kLsapStatus: return "LSAP status";
    default: return "reserved function";
  }
}

const char* response_function(std::uint8_t function) {
  switch (function) {
    case fc::kOk: return "OK";
    case fc::kUe: return "UE (user error)";
    case fc::kRr: return "RR (no resource)";
    case fc::kRs: return "RS (SAP not enabled)";
    case fc::kDl: return "DL (data low)";
    case fc::kNr: return "NR (no data)";
    case fc::kDh: return "DH (data high)";
    case fc::kRdl: return "RDL (data low, no resource)";
    case fc::kRdh: return "RDH (data high, no resource)";
    default: return "reserved code";
  }
}

const char* station_type(std::uint8_t fc) {
  static constexpr const char* kTypes[4] = {"passive station", "active station, not ready", "active station, ready",
                                            "active station, in the ring"};
  return kTypes[(fc >> 4) & 3];
}

/// The master's SAP: SSAP of a request, DSAP of an answer.
std::optional<std::uint8_t> master_sap(const Telegram& t) { return t.is_request() ? t.ssap : t.dsap; }

/// The SAPs below that of Initiate belong to C2 between them and the master's SAP 50 (table 24) or that of an Initiate,
/// else to anything: S7 and MPI use them, too.
bool is_msac2(const Telegram& t, std::uint8_t slave_sap, const ExplainContext& context) {
  return slave_sap < sap::kMs2Rm && (context.msac2 || master_sap(t) == sap::kMs2Master);
}

bool is_dpv1(const Telegram& t, std::uint8_t slave_sap, const ExplainContext& context) {
  return is_msac2(t, slave_sap, context) || (slave_sap >= sap::kMs2Rm && slave_sap <= sap::kMs1);
}

/// nullptr without one.
const char* service_name(const Telegram& t, std::uint8_t slave_sap, const ExplainContext& context) {
  switch (slave_sap) {
    case sap::kExtUserPrm: return "Ext_User_Prm";
    case sap::kSetSlaveAddress: return "Set_Slave_Address";
    case sap::kReadInputs: return "Read_Inputs";
    case sap::kReadOutputs: return "Read_Outputs";
    case sap::kGlobalControl: return "Global_Control";
    case sap::kGetCfg: return "Get_Cfg";
    case sap::kSlaveDiag: return "Slave_Diag";
    case sap::kSetPrm: return "Set_Prm";
    case sap::kChkCfg: return "Chk_Cfg";
    case sap::kMs1: return "MSAC1";
    case sap::kMs1Alarm: return "MSAC1 alarm";
    case sap::kMs2Rm: return "MSAC2 Initiate";
    default: return is_msac2(t, slave_sap, context) ? "MSAC2" : nullptr;
  }
}

/// The slave's SAP, which determines the service: DSAP of a request, SSAP of an answer.
std::optional<std::uint8_t> slave_sap(const Telegram& t) { return t.is_request() ? t.dsap : t.ssap; }

/// An address extension that is a region or segment address instead of a SAP.
bool is_region(std::uint8_t extension) { return (extension & extension::kRegion) != 0; }

bool is_data_transfer(const Telegram& t) {
  if (!t.is_request()) return t.function() >= fc::kDl || !t.data.empty();
  return t.function() != fc::kFdlStatus && t.function() != fc::kIdent && t.function() != fc::kLsapStatus;
}

DataWords default_sap_words(const Telegram& t) {
  return detail::plain_words(t.is_request() ? "output" : "input", t.data);
}

DataWords request_words(const Telegram& t, std::uint8_t sap, const ExplainContext& context) {
  switch (sap) {
    case sap::kSetPrm: return detail::set_prm_words(t.data);
    case sap::kChkCfg: return detail::cfg_words(t.data);
    case sap::kGlobalControl: return detail::global_control_words(t.data);
    case sap::kSetSlaveAddress: return detail::set_slave_address_words(t.data);
    case sap::kExtUserPrm: return detail::plain_words("parameter", t.data);
    default: return is_dpv1(t, sap, context) ? detail::dpv1_words(t.data, false) : detail::plain_words("data", t.data);
  }
}

DataWords response_words(const Telegram& t, std::uint8_t sap, const ExplainContext& context) {
  switch (sap) {
    case sap::kSlaveDiag: return detail::diag_words(t.data, context.dpv1);
    case sap::kGetCfg: return detail::cfg_words(t.data);
    case sap::kReadInputs: return detail::plain_words("input", t.data);
    case sap::kReadOutputs: return detail::plain_words("output", t.data);
    default: return is_dpv1(t, sap, context) ? detail::dpv1_words(t.data, true) : detail::plain_words("data", t.data);
  }
}

DataWords data_words(const Telegram& t, const ExplainContext& context) {
  const std::optional<std::uint8_t> sap = slave_sap(t);
  if (!sap) return default_sap_words(t);
  return t.is_request() ? request_words(t, *sap, context) : response_words(t, *sap, context);
}

/// True if the summary of the data adds to the name of the service.
bool has_essentials(const Telegram& t, const ExplainContext& context) {
  if (!t.data.empty()) return true;
  if (!slave_sap(t)) return is_data_transfer(t);
  return is_dpv1(t, *slave_sap(t), context) && t.is_request();
}

/// `service`: at this SAP, null without one.
std::string sap_words(const char* name, std::uint8_t byte, const char* service) {
  if (is_region(byte))
    return fmt::format("{}: region/segment address {}{}", name, byte & extension::kValue,
                       (byte & extension::kFollows) != 0 ? ", another extension follows" : "");
  return service != nullptr ? fmt::format("{}: {} ({})", name, byte, service) : fmt::format("{}: {}", name, byte);
}

std::string address_words(const char* name, std::uint8_t byte) {
  const unsigned address = byte & 0x7FU;
  return fmt::format("{}: {}{}{}", name, address, address == kBroadcast ? " (all stations)" : "",
                     (byte & extension::kFollows) != 0 ? ", SAP byte follows" : "");
}

class ByteExplainer {
 public:
  ByteExplainer(const Decoded& decoded, const ExplainContext& context)
      : decoded_(decoded), telegram_(decoded.telegram), context_(context) {}

  std::vector<ExplainedByte> explain() {
    if (decoded_.bytes.empty()) return {};
    if (!decoded_.readable) return explain_unreadable();
    explain_header();
    if (telegram_.kind == TelegramKind::kSc) return std::move(result_);
    say(address_words("DA", peek()));
    say(address_words("SA", peek()));
    if (telegram_.kind != TelegramKind::kSd4) explain_body();
    return std::move(result_);
  }

 private:
  void explain_header() {
    switch (telegram_.kind) {
      case TelegramKind::kSd1: return say("SD1: no data");
      case TelegramKind::kSd3: return say("SD3: 8 bytes of data");
      case TelegramKind::kSd4: return say("SD4: token");
      case TelegramKind::kSc: return say("SC: short acknowledge");
      case TelegramKind::kSd2: break;
    }
    say("SD2: data of variable length");
    say(fmt::format("LE: {} bytes from DA to the data", peek()));
    say(fmt::format("LEr: {}", peek()));
    say("SD2 repeated");
  }

  void explain_body() {
    say("FC: " + explain_fc(peek()));
    const bool request = telegram_.is_request();
    if (telegram_.dsap) say(sap_words("DSAP", *telegram_.dsap, request ? service_at(*telegram_.dsap) : nullptr));
    if (telegram_.ssap) say(sap_words("SSAP", *telegram_.ssap, request ? nullptr : service_at(*telegram_.ssap)));
    for (std::string& text : data_words(telegram_, context_).bytes) say(std::move(text));
    say(fcs_words());
    say(decoded_.error == DecodeError::kEndDelimiter ? "ED: wrong, 16 is right" : "ED");
  }

  const char* service_at(std::uint8_t sap) const { return service_name(telegram_, sap, context_); }

  std::string fcs_words() const {
    if (decoded_.error != DecodeError::kFcs) return "FCS";
    const std::size_t body = telegram_.kind == TelegramKind::kSd2 ? 4 : 1;
    return fmt::format("FCS: wrong, {:02X} is right", frame_check_sequence(&decoded_.bytes[body], at_ - body));
  }

  std::vector<ExplainedByte> explain_unreadable() {
    static constexpr const char* kVariable[] = {"SD2", "LE", "LEr", "SD2 repeated", "DA", "SA", "FC"};
    static constexpr const char* kFixed[] = {"start delimiter", "DA", "SA", "FC"};
    const bool variable = decoded_.bytes[0] == sd::k2;
    const std::size_t known = variable ? std::size(kVariable) : std::size(kFixed);
    while (at_ < decoded_.bytes.size()) say(at_ >= known ? "not decoded" : variable ? kVariable[at_] : kFixed[at_]);
    result_.back().meaning += fmt::format(": {}", describe(decoded_.error));
    return std::move(result_);
  }

  std::uint8_t peek() const { return decoded_.bytes[at_]; }
  void say(std::string text) {
    result_.push_back({at_, peek(), std::move(text)});
    ++at_;
  }

  const Decoded& decoded_;
  const Telegram& telegram_;
  const ExplainContext& context_;
  std::size_t at_ = 0;
  std::vector<ExplainedByte> result_;
};

}  // namespace

std::string explain_fc(std::uint8_t fc) {
  const auto function = static_cast<std::uint8_t>(fc & fc::kFunction);
  if ((fc & fc::kRequest) == 0) return fmt::format("response {}, {}", response_function(function), station_type(fc));
  return fmt::format("request {} FCB={} FCV={}", request_function(function), (fc & fc::kFcb) != 0 ? 1 : 0,
                     (fc & fc::kFcv) != 0 ? 1 : 0);
}

std::string explain_service(const Telegram& t, const ExplainContext& context) {
  if (const auto sap = slave_sap(t)) {
    if (is_region(*sap)) return fmt::format("region/segment {}", *sap & extension::kValue);
    const char* name = service_name(t, *sap, context);
    return name != nullptr ? name : fmt::format("SAP {}", *sap);
  }
  return is_data_transfer(t) ? "Data_Exchange" : "";
}

std::string explain_line(const Telegram& t, const ExplainContext& context) {
  if (t.kind == TelegramKind::kSc) return "SC (short acknowledge)";
  if (t.kind == TelegramKind::kSd4) return fmt::format("{} -> {}  token", t.sa, t.da);
  std::string line = fmt::format("{} -> {}  {}", t.sa, t.da, explain_fc(t.fc));
  const std::string service = explain_service(t, context);
  if (!service.empty()) line += "  " + service;
  if (has_essentials(t, context)) line += ": " + data_words(t, context).summary;
  return line;
}

std::vector<ExplainedByte> explain_bytes(const Decoded& decoded, const ExplainContext& context) {
  return ByteExplainer(decoded, context).explain();
}

std::optional<bool> dpv1_enabled(const Telegram& telegram) { return detail::dpv1_enabled(telegram); }

}  // namespace dsdpv1::bus
