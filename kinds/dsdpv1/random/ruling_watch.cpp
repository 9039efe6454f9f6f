#include "kinds/dsdpv1/random/ruling_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string_view>
#include <utility>

#include "kinds/dsdpv1/random/access_parts.hpp"
#include "model/dpram/reasons.hpp"
#include "model/profibus/baud.hpp"

namespace dsdpv1::cosim {
namespace {

bool is(const char* item, AccessPart part) { return std::strcmp(item, item_of(part)) == 0; }

/// B007, B0F9 and so on (P13). B014 to B01F are those of R10 where there are serial ports.
bool is_reserved(int address, Part part) {
  constexpr int kSerialFirst = regs::kOwnership, kSerialLast = 0x01F;
  if (has_serial_ports(part) && address >= kSerialFirst && address <= kSerialLast) return false;
  const auto cell = std::find_if(std::begin(regs::kMap), std::end(regs::kMap),
                                 [&](const auto& each) { return address <= each.last; });
  return std::string_view(cell->name).substr(0, 9) == "reserved_";
}

}  // namespace

void RulingWatch::reset() {
  access_ = {};
  min_tsdr_ = nullptr;
  early_ = {};
  asked_.clear();
  read_sap_ = 0;
  comes_ = waits_ = with_user_ = 0;
  withdrawn_ = false;
  reserved_written_.reset();
}

// --- D16, R6: the meaning of B00B.2 ----------------------------------------------------------------------------------

void RulingWatch::access_begins() {
  const unsigned command = model_->peek(regs::kUserCommand2), status = model_->peek(regs::kChipStatus2);
  access_ = {};
  access_.runs = true;
  access_.history = (command & regs::kUserCommand2InputHistory) != 0;
  access_.asked = (command & regs::kUserCommand2InputClear) != 0;
  access_.was_wrong = (status & regs::kChipStatus2InputCrc) != 0;
}

void RulingWatch::access_ended() {
  const Access access = std::exchange(access_, {});
  if (!access.runs) return;
  const bool is_wrong = (model_->peek(regs::kChipStatus2) & regs::kChipStatus2InputCrc) != 0;
  const bool cleared = access.asked && (model_->peek(regs::kUserCommand2) & regs::kUserCommand2InputClear) == 0;
  const bool right = access.inputs && !access.refused;
  const auto count = [&](const char* what) {
    situations_.count("B00B.2 and B011", fmt::format("{}: {}", access.history ? "history" : "present", what));
  };
  if (cleared) count("B011.7 falls");
  if (cleared && access.was_wrong && !access.inputs && is_wrong != access.history)
    count(access.history ? "B011.7 clears it" : "B011.7 leaves it");
  if (cleared && access.history && access.was_wrong && access.wrong && is_wrong) count("B011.7 with a wrong block");
  if (!access.asked && access.history && access.wrong && is_wrong) count("a wrong block sets it");
  if (!access.asked && access.history && access.was_wrong && right && is_wrong) count("a right block leaves it");
}

void RulingWatch::works_on(const char* item) {
  if (std::strcmp(item, "-") == 0) return access_ended();
  if (!access_.runs) access_begins();
  if (is(item, AccessPart::kInputs)) access_.inputs = true;
  if (is(item, AccessPart::kC2Answer)) with_user_ = 0;
  const bool c1 = is(item, AccessPart::kC1Request), c2 = is(item, AccessPart::kC2Request);
  if (!c1 && !c2) return;
  if (std::exchange(early_.at(c2 ? 1 : 0), false)) situations_.count("requests before answers", c1 ? "C1" : "C2");
}

// --- S11 -------------------------------------------------------------------------------------------------------------

void RulingWatch::min_tsdr(int bits) {
  constexpr int kLeast = 11;
  const auto rate = model_->status().baud;
  if (bits == 0 || !rate) return;
  const int most = profibus::kMaxTsdr.at(static_cast<std::size_t>(*rate));
  min_tsdr_ = bits < kLeast ? "below 11" : bits > most ? "above max_TSDR" : nullptr;
}

// --- V15 -------------------------------------------------------------------------------------------------------------

void RulingWatch::request(const bus::Telegram& telegram) {
  constexpr std::size_t kLength = 3;
  const bool reads = telegram.dsap && telegram.data.size() > kLength && telegram.data[0] == regs::kFunctionNumRead;
  read_sap_ = reads ? *telegram.dsap : 0;
  if (reads) read_bytes_ = telegram.data[kLength];
}

void RulingWatch::answer(const bus::Telegram& telegram) {
  if (min_tsdr_ != nullptr) situations_.count("min_TSDR", std::exchange(min_tsdr_, nullptr));
  if (const int sap = std::exchange(read_sap_, 0); sap != 0 && telegram.kind == bus::TelegramKind::kSc)
    asked_[sap] = read_bytes_;
}

/// `bytes`: of the answer's PDU.
void RulingWatch::answered(const char* who, int sap, int bytes) {
  constexpr int kHeader = 4;
  const auto asked = asked_.find(sap);
  if (asked == asked_.end() || bytes - kHeader == asked->second) return;
  situations_.count("answers to reads",
                    fmt::format("{} {}", who, bytes - kHeader < asked->second ? "shorter" : "longer"));
}

// --- V13 -------------------------------------------------------------------------------------------------------------

void RulingWatch::block_written(const char* item) {
  if (!is(item, AccessPart::kC2Request)) return;
  has_waited_ = comes_ == 0;
  with_user_ = std::exchange(has_waited_ ? waits_ : comes_, 0);
  withdrawn_ = false;
}

/// The channel `sap` is aborted or free again.
void RulingWatch::c2_ended(int sap, bool by_user_timer) {
  if (by_user_timer && sap == with_user_) {
    situations_.count("timer U", has_waited_ ? "ends after a turn" : "ends after a request");
    withdrawn_ = true;
  }
  for (int* each : {&comes_, &waits_, &with_user_})
    if (*each == sap) *each = 0;
}

// --- R9, and what the events say -------------------------------------------------------------------------------------

void RulingWatch::event(const profibus::Event& event) {
  using dpram::Reason;
  using profibus::Severity;
  access_.refused = access_.refused || profibus::severity(event.reason) == Severity::kRefusal;
  access_.wrong = access_.wrong || event.reason == Reason::kInputCrc;
  if (event.reason == Reason::kInitialised) comes_ = waits_ = with_user_ = 0;
  if (event.reason == profibus::Reason::kPrmAccepted) min_tsdr(event.b);
  acyclic_event(event);
}

void RulingWatch::acyclic_event(const profibus::Event& event) {
  using profibus::Reason;
  constexpr int kC2 = 2, kUser = 3, kByteBits = 8;
  const auto comes = [&](std::size_t which, unsigned bit) {
    early_.at(which) = chip_.part != Part::kDsdpv1 && (model_->peek(regs::kUserCommand2) & bit) != 0;
  };
  if (event.reason == Reason::kC1Request) comes(0, regs::kUserCommand2C1);
  if (event.reason == Reason::kC2Request) {
    comes(1, regs::kUserCommand2C2);
    (comes_ == 0 && with_user_ == 0 ? comes_ : waits_) = event.a >> kByteBits;
  }
  if (event.reason == Reason::kC1Answer && event.a == regs::kFunctionNumRead) answered("C1", bus::sap::kMs1, event.b);
  if (event.reason == Reason::kC2Answer && event.b == regs::kFunctionNumRead) answered("C2", event.a, event.c);
  if (event.reason == Reason::kC2Timeout) c2_ended(event.a, event.b == kUser);
  for (const Reason each : {Reason::kC2WrongRequest, Reason::kC2Abort, Reason::kC2AbortedByMaster, Reason::kC2Freed})
    if (event.reason == each) c2_ended(event.a, false);
  if (event.reason == Reason::kAcyclicNoRequest && event.a == kC2 && std::exchange(withdrawn_, false))
    situations_.count("timer U", "an answer after it");
}

// --- P13 -------------------------------------------------------------------------------------------------------------

void RulingWatch::written(int address) {
  if (is_reserved(address, chip_.part)) reserved_written_.set(static_cast<std::size_t>(address));
}

void RulingWatch::read(int address) {
  const auto cell = static_cast<std::size_t>(address);
  if (!reserved_written_.test(cell)) return;
  reserved_written_.reset(cell);
  situations_.count("reserved cells", "written and read");
}

}  // namespace dsdpv1::cosim
