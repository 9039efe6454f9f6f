#pragma once
// Telegrams of the data link layer (EN 50170 / IEC 61158-4 type 3) as types; encodes and decodes them with exact
// reasons.
#include <cstdint>
#include <optional>

#include "bus/address.hpp"
#include "bus/bytes.hpp"

namespace dsdpv1::bus {

enum class TelegramKind : std::uint8_t {
  kSd1,  ///< 10 DA SA FC FCS 16: no data
  kSd2,  ///< 68 LE LEr 68 DA SA FC data FCS 16: 0..246 bytes of data
  kSd3,  ///< A2 DA SA FC data(8) FCS 16
  kSd4,  ///< DC DA SA: the token
  kSc,   ///< E5: short acknowledge
};

namespace sd {
constexpr std::uint8_t k1 = 0x10, k2 = 0x68, k3 = 0xA2, k4 = 0xDC, kSc = 0xE5, kEnd = 0x16;
}

/// Function codes. A request has bit 6 set.
namespace fc {
constexpr std::uint8_t kRequest = 0x40, kFcb = 0x20, kFcv = 0x10, kFunction = 0x0F;
constexpr std::uint8_t kSdaLow = 3, kSdnLow = 4, kSdaHigh = 5, kSdnHigh = 6, kMsrd = 7, kFdlStatus = 9, kSrdLow = 0xC,
                       kSrdHigh = 0xD, kIdent = 0xE, kLsapStatus = 0xF;
constexpr std::uint8_t kOk = 0, kUe = 1, kRr = 2, kRs = 3, kDl = 8, kNr = 9, kDh = 0xA, kRdl = 0xC, kRdh = 0xD;
}  // namespace fc

/// Service access points of DP and DPV1; the slave's unless noted.
namespace sap {
constexpr std::uint8_t kSetSlaveAddress = 55, kReadInputs = 56, kReadOutputs = 57, kGlobalControl = 58, kGetCfg = 59,
                       kSlaveDiag = 60, kSetPrm = 61, kChkCfg = 62;
constexpr std::uint8_t kExtUserPrm = 53;
constexpr std::uint8_t kMaster = 62;    ///< SSAP of a DP master
constexpr std::uint8_t kMs1 = 51;       ///< class 1 acyclic, both sides
constexpr std::uint8_t kMs1Alarm = 50;  ///< alarm acknowledge of class 1
constexpr std::uint8_t kMs2Rm = 49;     ///< Initiate of class 2
constexpr std::uint8_t kMs2Master = 50;
}  // namespace sap

/// Bits of an address byte and of the address extensions after FC (EN 50170).
namespace extension {
constexpr std::uint8_t kFollows = 0x80;  ///< an extension, or another one
constexpr std::uint8_t kRegion = 0x40;   ///< region or segment address, not a SAP
constexpr std::uint8_t kValue = 0x3F;
}  // namespace extension

/// Bits of Control_Command (table 23).
namespace global_control {
constexpr std::uint8_t kClearData = 0x02, kUnfreeze = 0x04, kFreeze = 0x08, kUnsync = 0x10, kSync = 0x20;
}

constexpr std::size_t kMaxDataUnit = 246;  ///< data of SD2, SAP bytes included (LE at most 249)
constexpr std::size_t kMaxData = 244;      ///< ... without the two SAP bytes

struct Telegram {
  TelegramKind kind = TelegramKind::kSd1;
  std::uint8_t da = 0, sa = 0;                       ///< 0..127, without the extension bit; 0 in SC
  std::uint8_t fc = 0;                               ///< 0 in SD4 and SC
  std::optional<std::uint8_t> dsap = {}, ssap = {};  ///< the extension bytes, if bit 7 of DA or SA is set
  Bytes data = {};                                   ///< after the SAP bytes

  /// SD1, SD2 or SD3 with bit 6 of FC set.
  bool is_request() const;
  /// SC, or SD1, SD2, SD3 with bit 6 of FC clear.
  bool is_response() const;
  /// A request that its receiver must answer: all except SDN, and none to the broadcast address.
  bool wants_answer() const;
  std::uint8_t function() const { return fc & fc::kFunction; }
};

bool operator==(const Telegram& a, const Telegram& b);

/// SD1 without data and SAPs, else SD2.
Telegram make_telegram(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const Bytes& data = {},
                       std::optional<std::uint8_t> dsap = {}, std::optional<std::uint8_t> ssap = {});
/// SD3 instead of SD2 if exactly 8 bytes, SAP bytes included, are to be sent; else unchanged.
Telegram prefer_sd3(Telegram telegram);
Telegram make_token(std::uint8_t da, std::uint8_t sa);
Telegram make_sc();

/// The bytes on the wire. Throws std::invalid_argument if the data do not fit the kind.
Bytes encode(const Telegram& telegram);

enum class DecodeError : std::uint8_t {
  kNone,
  kStartDelimiter,        ///< the first byte is not 10, 68, A2, DC or E5
  kLengthRange,           ///< LE below 4 or above 249
  kLengthMismatch,        ///< LE and LEr differ
  kSecondStartDelimiter,  ///< the fourth byte of SD2 is not 68
  kFcs,
  kEndDelimiter,
  kMissingSap,  ///< bit 7 of DA or SA announces an extension byte that is missing
  kTruncated,   ///< the line fell silent (the input ended) inside the telegram
};

/// As text: "wrong FCS".
const char* describe(DecodeError error);

struct Decoded {
  DecodeError error = DecodeError::kNone;
  bool readable = false;  ///< `telegram` is filled: without an error, or if only FCS or ED are wrong
  Telegram telegram = {};
  Bytes bytes = {};  ///< the bytes received
};

/// True for exactly one valid telegram.
bool is_telegram(const std::uint8_t* bytes, std::size_t size);

/// Decodes consecutive telegrams byte by byte.
class TelegramDecoder {
 public:
  /// Returns a result if `byte` completes a telegram or makes it invalid. Length errors are found at their byte; FCS,
  /// ED and SAPs are checked at the end, in this order.
  std::optional<Decoded> feed(std::uint8_t byte);
  /// The end of the input or an idle line: kTruncated inside a telegram.
  std::optional<Decoded> finish();
  bool begun() const { return !bytes_.empty(); }
  const Bytes& bytes() const { return bytes_; }

 private:
  DecodeError check_header();
  Decoded take(DecodeError error);

  Bytes bytes_;
  std::size_t expected_ = 0;  ///< length of the telegram according to its header, 0 = unknown
};

/// The first telegram of `bytes`; kTruncated if they end inside it.
Decoded decode(const Bytes& bytes);

/// The sum of DA..data modulo 256.
std::uint8_t frame_check_sequence(const std::uint8_t* first, std::size_t count);

}  // namespace dsdpv1::bus
