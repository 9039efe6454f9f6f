#include "bus/telegram/telegram.hpp"

#include <stdexcept>
#include <string>

namespace dsdpv1::bus {

namespace {

constexpr std::size_t kMinLe = 4, kMaxLe = 249;  // DA, SA, FC and 1..246 bytes
constexpr std::size_t kSd1Size = 6, kSd3Size = 14, kSd4Size = 3, kSd2Overhead = 6;
constexpr std::size_t kSd3Data = 8;

std::size_t unit_size(const Telegram& t) { return t.data.size() + (t.dsap ? 1U : 0U) + (t.ssap ? 1U : 0U); }

std::uint8_t address_byte(std::uint8_t address, bool extended) {
  return static_cast<std::uint8_t>((address & 0x7FU) | (extended ? extension::kFollows : 0U));
}

void check_unit(const Telegram& t) {
  const std::size_t size = unit_size(t);
  const auto fail = [size](const char* what) {
    throw std::invalid_argument(std::string(what) + ", not " + std::to_string(size));
  };
  if (t.kind == TelegramKind::kSd1 && size != 0) fail("SD1 carries 0 bytes of data");
  if (t.kind == TelegramKind::kSd2 && (size == 0 || size > kMaxDataUnit)) fail("SD2 carries 1 to 246 bytes of data");
  if (t.kind == TelegramKind::kSd3 && size != kSd3Data) fail("SD3 carries 8 bytes of data");
}

void append_body(Bytes& out, const Telegram& t) {
  const std::size_t first = out.size();
  out.push_back(address_byte(t.da, t.dsap.has_value()));
  out.push_back(address_byte(t.sa, t.ssap.has_value()));
  out.push_back(t.fc);
  if (t.dsap) out.push_back(*t.dsap);
  if (t.ssap) out.push_back(*t.ssap);
  out.insert(out.end(), t.data.begin(), t.data.end());
  out.push_back(frame_check_sequence(&out[first], out.size() - first));
  out.push_back(sd::kEnd);
}

void append_header(Bytes& out, const Telegram& t) {
  if (t.kind == TelegramKind::kSd1) out.push_back(sd::k1);
  if (t.kind == TelegramKind::kSd3) out.push_back(sd::k3);
  if (t.kind != TelegramKind::kSd2) return;
  const auto le = static_cast<std::uint8_t>(3 + unit_size(t));
  out.insert(out.end(), {sd::k2, le, le, sd::k2});
}

/// The place of DA in a complete telegram.
std::size_t body_offset(std::uint8_t start) { return start == sd::k2 ? 4 : 1; }

/// Whether every SAP byte announced by DA and SA comes before FCS.
bool saps_present(const std::uint8_t* bytes, std::size_t size) {
  const std::size_t body = body_offset(bytes[0]);
  const std::size_t saps = (bytes[body] >> 7) + (bytes[body + 1] >> 7);
  return size - 2 - body - 3 >= saps;
}

DecodeError check_frame(const std::uint8_t* bytes, std::size_t size) {
  const std::size_t body = body_offset(bytes[0]);
  const std::size_t fcs = size - 2;
  if (frame_check_sequence(bytes + body, fcs - body) != bytes[fcs]) return DecodeError::kFcs;
  if (bytes[size - 1] != sd::kEnd) return DecodeError::kEndDelimiter;
  return saps_present(bytes, size) ? DecodeError::kNone : DecodeError::kMissingSap;
}

/// The lengths and delimiters at the begin match a telegram of this size.
bool header_fits(const std::uint8_t* bytes, std::size_t size) {
  switch (bytes[0]) {
    case sd::k1: return size == kSd1Size;
    case sd::k3: return size == kSd3Size;
    case sd::k4: return size == kSd4Size;
    case sd::kSc: return size == 1;
    case sd::k2: break;
    default: return false;
  }
  return size >= kMinLe + kSd2Overhead && bytes[1] >= kMinLe && bytes[1] <= kMaxLe && bytes[2] == bytes[1] &&
         bytes[3] == sd::k2 && size == bytes[1] + kSd2Overhead;
}

/// SD4 and SC have neither FCS nor ED.
bool has_frame(std::uint8_t start) { return start != sd::k4 && start != sd::kSc; }

TelegramKind kind_of(std::uint8_t start) {
  switch (start) {
    case sd::k1: return TelegramKind::kSd1;
    case sd::k2: return TelegramKind::kSd2;
    case sd::k3: return TelegramKind::kSd3;
    case sd::k4: return TelegramKind::kSd4;
    default: return TelegramKind::kSc;
  }
}

Telegram parse(const Bytes& bytes) {
  Telegram t;
  t.kind = kind_of(bytes[0]);
  if (t.kind == TelegramKind::kSc) return t;
  std::size_t at = body_offset(bytes[0]);
  const std::uint8_t da = bytes[at++], sa = bytes[at++];
  t.da = da & 0x7F;
  t.sa = sa & 0x7F;
  if (t.kind == TelegramKind::kSd4) return t;
  t.fc = bytes[at++];
  if ((da & extension::kFollows) != 0) t.dsap = bytes[at++];
  if ((sa & extension::kFollows) != 0) t.ssap = bytes[at++];
  t.data.assign(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end() - 2);
  return t;
}

}  // namespace

bool Telegram::is_request() const {
  return kind != TelegramKind::kSd4 && kind != TelegramKind::kSc && (fc & fc::kRequest) != 0;
}

bool Telegram::is_response() const {
  return kind == TelegramKind::kSc || (kind != TelegramKind::kSd4 && (fc & fc::kRequest) == 0);
}

bool Telegram::wants_answer() const {
  return is_request() && da != kBroadcast && function() != fc::kSdnLow && function() != fc::kSdnHigh;
}

bool operator==(const Telegram& a, const Telegram& b) {
  return a.kind == b.kind && a.da == b.da && a.sa == b.sa && a.fc == b.fc && a.dsap == b.dsap && a.ssap == b.ssap &&
         a.data == b.data;
}

Telegram make_telegram(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const Bytes& data,
                       std::optional<std::uint8_t> dsap, std::optional<std::uint8_t> ssap) {
  Telegram t{TelegramKind::kSd2, da, sa, fc, dsap, ssap, data};
  if (unit_size(t) == 0) t.kind = TelegramKind::kSd1;
  return t;
}

Telegram prefer_sd3(Telegram telegram) {
  if (telegram.kind == TelegramKind::kSd2 && unit_size(telegram) == kSd3Data) telegram.kind = TelegramKind::kSd3;
  return telegram;
}

Telegram make_token(std::uint8_t da, std::uint8_t sa) { return {TelegramKind::kSd4, da, sa}; }

Telegram make_sc() { return {TelegramKind::kSc}; }

Bytes encode(const Telegram& telegram) {
  if (telegram.kind == TelegramKind::kSc) return {sd::kSc};
  if (telegram.kind == TelegramKind::kSd4)
    return {sd::k4, address_byte(telegram.da, false), address_byte(telegram.sa, false)};
  check_unit(telegram);
  Bytes bytes;
  append_header(bytes, telegram);
  append_body(bytes, telegram);
  return bytes;
}

Decoded decode(const Bytes& bytes) {
  if (is_telegram(bytes.data(), bytes.size())) return {DecodeError::kNone, true, parse(bytes), bytes};
  TelegramDecoder decoder;
  for (const std::uint8_t byte : bytes)
    if (const auto decoded = decoder.feed(byte)) return *decoded;
  return decoder.finish().value_or(Decoded{DecodeError::kTruncated});
}

std::uint8_t frame_check_sequence(const std::uint8_t* first, std::size_t count) {
  unsigned sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += first[i];
  return static_cast<std::uint8_t>(sum);
}

const char* describe(DecodeError error) {
  switch (error) {
    case DecodeError::kNone: return "right";
    case DecodeError::kStartDelimiter: return "no start delimiter (10, 68, A2, DC or E5)";
    case DecodeError::kLengthRange: return "LE out of range (4 to 249)";
    case DecodeError::kLengthMismatch: return "LE and LEr differ";
    case DecodeError::kSecondStartDelimiter: return "second start delimiter is not 68";
    case DecodeError::kFcs: return "wrong FCS";
    case DecodeError::kEndDelimiter: return "end delimiter is not 16";
    case DecodeError::kMissingSap: return "an address announces a SAP byte that is not there";
    case DecodeError::kTruncated: return "truncated";
  }
  return "";
}

DecodeError TelegramDecoder::check_header() {
  if (bytes_.size() == 1) {
    switch (bytes_[0]) {
      case sd::k1: expected_ = kSd1Size; return DecodeError::kNone;
      case sd::k2: return DecodeError::kNone;  // known with LE
      case sd::k3: expected_ = kSd3Size; return DecodeError::kNone;
      case sd::k4: expected_ = kSd4Size; return DecodeError::kNone;
      case sd::kSc: expected_ = 1; return DecodeError::kNone;
      default: return DecodeError::kStartDelimiter;
    }
  }
  if (bytes_[0] != sd::k2) return DecodeError::kNone;
  if (bytes_.size() == 2 && (bytes_[1] < kMinLe || bytes_[1] > kMaxLe)) return DecodeError::kLengthRange;
  if (bytes_.size() == 3 && bytes_[2] != bytes_[1]) return DecodeError::kLengthMismatch;
  if (bytes_.size() == 4 && bytes_[3] != sd::k2) return DecodeError::kSecondStartDelimiter;
  if (bytes_.size() == 4) expected_ = bytes_[1] + kSd2Overhead;
  return DecodeError::kNone;
}

std::optional<Decoded> TelegramDecoder::feed(std::uint8_t byte) {
  constexpr std::size_t kShort = 16;  // most telegrams fit, and then allocate once
  if (bytes_.empty()) bytes_.reserve(kShort);
  bytes_.push_back(byte);
  const DecodeError header = check_header();
  if (bytes_.capacity() < expected_) bytes_.reserve(expected_);
  if (header != DecodeError::kNone) return take(header);
  if (bytes_.size() != expected_) return std::nullopt;
  return take(has_frame(bytes_[0]) ? check_frame(bytes_.data(), bytes_.size()) : DecodeError::kNone);
}

std::optional<Decoded> TelegramDecoder::finish() {
  if (!begun()) return std::nullopt;
  return take(DecodeError::kTruncated);
}

Decoded TelegramDecoder::take(DecodeError error) {
  Decoded result;
  result.error = error;
  const bool only_sum_or_end = error == DecodeError::kFcs || error == DecodeError::kEndDelimiter;
  result.readable = error == DecodeError::kNone || (only_sum_or_end && saps_present(bytes_.data(), bytes_.size()));
  if (result.readable) result.telegram = parse(bytes_);
  result.bytes = std::move(bytes_);
  bytes_.clear();
  expected_ = 0;
  return result;
}

bool is_telegram(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0 || !header_fits(bytes, size)) return false;
  return !has_frame(bytes[0]) || check_frame(bytes, size) == DecodeError::kNone;
}

}  // namespace dsdpv1::bus
