#include "bus/master/master2_connection.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace dsdpv1::bus {

namespace {

constexpr std::size_t kInitiateFixed = 12;  // of the request, before Add_Addr
constexpr std::size_t kMaxInitiate = kMaxData - kInitiateFixed;

std::uint8_t high(unsigned value) { return static_cast<std::uint8_t>(value >> 8); }
std::uint8_t low(unsigned value) { return static_cast<std::uint8_t>(value & 0xFFU); }

void check(bool right, const std::string& what) {
  if (!right) throw std::invalid_argument(what);
}

}  // namespace

const char* name(ConnectionState state) {
  switch (state) {
    case ConnectionState::kClosed: return "CLOSED";
    case ConnectionState::kInitiating: return "INITIATING";
    case ConnectionState::kConnecting: return "CONNECTING";
    case ConnectionState::kOpen: return "OPEN";
    case ConnectionState::kBusy: return "BUSY";
    case ConnectionState::kAborting: return "ABORTING";
  }
  return "";
}

Bytes short_add_addr(std::uint8_t source_api, std::uint8_t destination_api) { return {source_api, destination_api}; }

Bytes long_add_addr(const AddressEnd& source, const AddressEnd& destination) {
  check(source.address.size() + destination.address.size() + 4 <= kMaxInitiate, "Add_Addr does not fit the telegram");
  Bytes bytes;
  for (const AddressEnd* end : {&source, &destination}) {
    bytes.push_back(end->type);
    bytes.push_back(static_cast<std::uint8_t>(end->address.size()));
  }
  for (const AddressEnd* end : {&source, &destination})
    bytes.insert(bytes.end(), end->address.begin(), end->address.end());
  return bytes;
}

Connection::Connection(const ConnectionParameters& parameters, std::uint8_t master)
    : parameters_(parameters), master_(master) {
  check(parameters.slave <= kHighestAddress, fmt::format("slave address {}, expected 0 to 126", parameters.slave));
  check(parameters.features.size() == 2 && parameters.profile_features.size() == 2,
        "Features_Supported and Profile_Features_Supported have 2 bytes each");
  check(parameters.add_addr.size() <= kMaxInitiate, "Add_Addr does not fit the telegram");
  check(parameters.response_timeout >= 0 && parameters.poll_interval_us >= 0, "times are not negative");
}

Tick Connection::response_timeout() const {
  const int units = parameters_.response_timeout;
  return (units != 0 ? units : 2 * int{parameters_.send_timeout}) * kTimeUnit10ms;
}

// --- calls of the master's user --------------------------------------------------------------------------------------

void Connection::open() {
  if (state_ != ConnectionState::kClosed) return;
  behaviour_ = Behaviour::kNormal;
  acknowledged_initiate_ = idle_at_work_ = at_work_ = false;
  granted_ = {};
  go(ConnectionState::kInitiating);
}

void Connection::push(Tick now, AcyclicRequest request, AcyclicCallback done) {
  if (state_ == ConnectionState::kClosed) throw std::logic_error("the connection is closed");
  operations_.emplace_back(now, std::move(request), std::move(done));
}

void Connection::abort(Tick now, const AbortReason& reason) {
  if (state_ == ConnectionState::kClosed) return;
  abort_ = reason;
  abort_words_ = "aborted by the master";
  if (!granted_.sap) return end_aborted(now);
  go(ConnectionState::kAborting);
}

// --- the next telegram -----------------------------------------------------------------------------------------------

bool Connection::due(Tick now) {
  if (!raw_.empty()) return true;
  return behaviour_ != Behaviour::kSilent && normal_due(now);
}

bool Connection::normal_due(Tick now) {
  switch (state_) {
    case ConnectionState::kClosed: return false;
    case ConnectionState::kOpen: return open_due(now);
    case ConnectionState::kAborting: return true;
    case ConnectionState::kInitiating:
      if (!acknowledged_initiate_) return true;
      break;
    case ConnectionState::kConnecting:
    case ConnectionState::kBusy: break;
  }
  if (now - waiting_from_ >= response_timeout())
    abort_for(now, abort_reason::kTimeout, "aborted by the master, no answer");
  return state_ == ConnectionState::kAborting || (state_ != ConnectionState::kClosed && now >= next_poll_);
}

bool Connection::open_due(Tick now) const {
  if (behaviour_ == Behaviour::kPollOnly) return now >= next_poll_;
  // Half of the slave's I timer: Idle and its acknowledgement have the other half.
  return !operations_.empty() || now - last_answer_ >= granted_.send_timeout * kTimeUnit10ms;
}

Connection::Asked Connection::choose() const {
  if (!raw_.empty()) return Asked::kRaw;
  if (state_ == ConnectionState::kAborting) return Asked::kAbort;
  if (state_ == ConnectionState::kInitiating && !acknowledged_initiate_) return Asked::kInitiate;
  if (state_ != ConnectionState::kOpen || behaviour_ == Behaviour::kPollOnly) return Asked::kPoll;
  return operations_.empty() ? Asked::kIdle : Asked::kRequest;
}

Telegram Connection::telegram(const Bytes& pdu, std::uint8_t dsap) const {
  return make_telegram(parameters_.slave, master_, fc::kRequest | fc::kSrdLow, pdu, dsap, sap::kMs2Master);
}

Telegram Connection::raw_telegram() const {
  const RawAcyclic& raw = raw_.front();
  const std::uint8_t function = raw.sdn ? fc::kSdnLow : fc::kSrdLow;
  return make_telegram(parameters_.slave, master_, fc::kRequest | function, raw.pdu,
                       raw.dsap.value_or(granted_.sap.value_or(sap::kMs2Rm)), raw.ssap);
}

Bytes Connection::initiate_pdu() const {
  const ConnectionParameters& p = parameters_;
  Bytes pdu = {function_num::kInitiate, 0, 0, 0, high(p.send_timeout), low(p.send_timeout)};
  for (const Bytes* part : {&p.features, &p.profile_features}) pdu.insert(pdu.end(), part->begin(), part->end());
  pdu.insert(pdu.end(), {high(p.profile_ident), low(p.profile_ident)});
  pdu.insert(pdu.end(), p.add_addr.begin(), p.add_addr.end());
  return pdu;
}

Telegram Connection::next_request(Tick now) {
  asked_ = choose();
  asked_in_ = state_;
  next_poll_ = now + parameters_.poll_interval_us * kTicksPerUs;
  const std::uint8_t channel = granted_.sap.value_or(sap::kMs2Rm);
  switch (asked_) {
    case Asked::kRaw: return raw_telegram();
    case Asked::kInitiate: return telegram(initiate_pdu(), sap::kMs2Rm);
    case Asked::kPoll: return telegram({}, channel);
    case Asked::kIdle: return telegram({function_num::kIdle}, channel);
    case Asked::kRequest: at_work_ = true; return telegram(pdu_of(current().request), channel);
    case Asked::kAbort: break;
  }
  Telegram last = telegram({function_num::kAbort, abort_.subnet, abort_.code(), abort_.detail}, channel);
  if (abort_.sdn) last.fc = fc::kRequest | fc::kSdnLow;
  return last;
}

}  // namespace dsdpv1::bus
