// S3, S11: when an answer begins.
#include <fmt/format.h>

#include <algorithm>

#include "kinds/dsdpv1/claims/found.hpp"
#include "lab/calibrate/dp_service.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kTsdr = {
    "S3", "an answer begins min_TSDR after the request, and at most a cycle more", {wire::kPbrxd, wire::kPbtxd}};
const Claim kMinTsdr = {"S11",
                        "min_TSDR of Set_Prm counts from the answer to it, or the verdict, on, 11 at least",
                        {wire::kPbrxd, wire::kPbtxd}};

/// A min_TSDR as applied at the request's rate (S11, S30).
int bits_at(const LineTelegram& request, int bits) {
  return std::min(std::max(bits, bus::kMinTsdrBits), bus::baud(request.baud).max_tsdr_bits);
}

bool begins_at(const Span& cycles, const LineTelegram& request, int bits) {
  const double right = bits * request.bit();
  return overlap(cycles, {right, right + 1});
}

bool fits(const Span& cycles, const LineTelegram& request, int bits) {
  return begins_at(cycles, request, bits_at(request, bits));
}

class TsdrJudge {
 public:
  TsdrJudge(const Scene& scene, Found& found) : scene_(scene), found_(found) {}

  void judge(const Exchange& exchange) {
    const LineTelegram& request = *exchange.request;
    take_restarts(request.start);
    open_ = open_ || may_be_prm(exchange);
    if (!request.right || exchange.answer == nullptr) return;
    take(exchange);
    const Span cycles =
        scene_.time.between(request.last_start, exchange.answer->start) + -(bus::kCharacterBits * request.bit());
    if (narrows(cycles, exchange)) return hold();
    fail(cycles, request, exchange.answer->start);
  }

 private:
  struct Asked {
    int bits;
    std::uint8_t master;
    bool perhaps;  ///< may have been accepted before the present min_TSDR
  };

  void restart() {
    now_ = {bus::kMinTsdrBits};
    asked_.reset();
    before_.clear();
    changed_ = open_ = false;
  }
  /// BR falls at a new initialisation, or at the end of BAUD_CONTROL, which keeps min_TSDR.
  void take_restarts(Tick at) {
    for (const Wire wire : {wire::kReset, wire::kReady})
      if (has_edge(wire, at)) restart();
    if (has_edge(wire::kBr, at) && !now_.empty()) {
      give_up_asked();
      now_.push_back(bus::kMinTsdrBits);
    }
    looked_ = at;
  }
  bool has_edge(Wire wire, Tick until) const {
    const Trace& trace = scene_.record[wire];
    return trace.count_until(until) != trace.count_until(looked_);
  }

  void take(const Exchange& exchange) {
    const bus::Telegram& request = exchange.request->telegram;
    constexpr std::size_t kPlace = 3;
    switch (prm_kind(exchange)) {
      case PrmKind::kLock:
        give_up_asked();
        if (request.data[kPlace] != 0) asked_ = {request.data[kPlace], request.sa, false};
        return;
      case PrmKind::kMinTsdr:
        if (request.data[kPlace] == 0) return;
        change(request.data[kPlace], *exchange.request);
        if (asked_) asked_->perhaps = true;
        return;
      case PrmKind::kUnlock:
      case PrmKind::kShort: return give_up_asked();
      case PrmKind::kNone: break;
    }
    if (!asked_) return;
    const bool served =
        exchange.exchanged() || (exchange.is_srd(bus::sap::kChkCfg) && exchange.acknowledged());  // S12, S13
    if (served && !exchange.repeats && request.sa == asked_->master)
      take_verdict(*exchange.request);
    else if (diagnosis_has(exchange, kPrmFault, kPrmReq))
      asked_.reset();
  }

  void take_verdict(const LineTelegram& request) {
    if (asked_->perhaps)
      give_up_asked();
    else
      accept(request);
  }
  /// Whether the value asked for was accepted stays unknown, so both remain possible.
  void give_up_asked() {
    if (asked_ && !now_.empty()) now_.push_back(asked_->bits);
    asked_.reset();
  }
  void accept(const LineTelegram& request) {
    const int bits = asked_->bits;
    asked_.reset();
    change(bits, request);
  }
  void change(int bits, const LineTelegram& request) {
    const auto same = [&](int each) { return bits_at(request, each) == bits_at(request, bits); };
    changed_ = bits_at(request, bits) != bits || (!now_.empty() && std::none_of(now_.begin(), now_.end(), same));
    before_ = now_;
    now_ = {bits};
  }

  /// Keeps the possible values of min_TSDR that this answer allows; returns false if none is left.
  bool narrows(const Span& cycles, const Exchange& exchange) {
    const LineTelegram& request = *exchange.request;
    const bool as_asked = asked_ && fits(cycles, request, asked_->bits);
    if (now_.empty()) return as_asked || learns(cycles, request);
    std::vector<int> left;
    std::copy_if(now_.begin(), now_.end(), std::back_inserter(left),
                 [&](int bits) { return fits(cycles, request, bits); });
    if (!left.empty()) {
      now_ = std::move(left);
      if (exchange.exchanged() && !exchange.repeats) open_ = false;
      return true;
    }
    if (as_asked) {
      accept(request);
      return true;
    }
    if (open_ && !now_.empty()) {
      open_ = changed_ = false;
      now_.clear(), before_.clear();
      return learns(cycles, request);
    }
    // Without BR only evidence of DATA_EXCH excludes a new initialisation.
    const bool restarted = !scene_.record.sees(wire::kBr) && (!exchange.exchanged() || exchange.repeats) &&
                           fits(cycles, request, bus::kMinTsdrBits);
    if (restarted) restart();
    return restarted;
  }
  /// Every value that fits is possible: the capture begins in operation, or a Set_Prm was not read.
  bool learns(const Span& cycles, const LineTelegram& request) {
    for (int bits = bus::kMinTsdrBits; bits <= bus::baud(request.baud).max_tsdr_bits; ++bits)
      if (fits(cycles, request, bits)) now_.push_back(bits);
    return !now_.empty();
  }

  void hold() {
    found_.judge.holds(kTsdr);
    if (changed_) found_.judge.holds(kMinTsdr);
    changed_ = false;
  }
  void fail(const Span& cycles, const LineTelegram& request, Tick at) {
    const int bits = now_.empty() ? bus::kMinTsdrBits : now_.front();
    const double expected = bits_at(request, bits) * request.bit();
    const double by = cycles.lo > expected + 1 ? cycles.lo - expected - 1 : cycles.hi - expected;
    const bool as_before =
        std::any_of(before_.begin(), before_.end(), [&](int each) { return fits(cycles, request, each); });
    const bool as_set = begins_at(cycles, request, bits);  // without the limits
    found_.judge.fails(as_before || as_set ? kMinTsdr : kTsdr, at,
                       fmt::format("TSDR {:.2f} bit times, {:+.1f} cycles from min_TSDR {}",
                                   cycles.middle() / request.bit(), by, bits_at(request, bits)));
  }

  const Scene& scene_;
  Found& found_;
  Tick looked_ = 0;
  std::vector<int> now_;        ///< possible values of min_TSDR; empty: not shown yet
  std::optional<Asked> asked_;  ///< value of a Set_Prm that perhaps was, or will be, accepted
  std::vector<int> before_;     ///< value before the last Set_Prm
  bool changed_ = false;        ///< by a Set_Prm, and no answer has shown it yet
  bool open_ = false;           ///< a Set_Prm may not have been read: the first answer that shows min_TSDR counts
};

}  // namespace

void measure_tsdr(const Scene& scene, Found& found) {
  TsdrJudge judge(scene, found);
  for (const Exchange& exchange : scene.exchanges) judge.judge(exchange);
}

ClaimList tsdr_claims() { return {&kTsdr, &kMinTsdr}; }

}  // namespace dsdpv1::calibrate
