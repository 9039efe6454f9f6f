#include "model/xgate/fieldbus.hpp"

#include <algorithm>

#include "model/xgate/diagnosis_block.hpp"
#include "model/xgate/reasons.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr std::uint8_t kDpv1Enable = 0x80, kCheckCfgMode = 0x01;  // DPV1_Status_1, 2
constexpr std::uint8_t kDiagPresent = 0x81, kDiagGone = 0x01;     // UserDiagnosis, D9
namespace dpv1 = profibus::dpv1;

template <int N>
void copy(const profibus::Block<N>& block, Frame& answer) {
  answer.data.assign(block.bytes.data(), block.size);
}

/// An answer of the host has the form of its request (4.4.1, tables 4.7 and 4.8).
bool answer_right(const Mailbox& box, const profibus::Pdu& request) {
  if (box.size < dpv1::kHeader) return false;
  if ((box.data[0] & dpv1::kNegative) != 0) return box.size == dpv1::kHeader;
  if (request.bytes[0] == dpv1::kWrite) return box.size == dpv1::kHeader;
  if (box.size != dpv1::kHeader + box.data[3] || box.size > dpv1::kHeader + profibus::kMaxAcyclic) return false;
  return request.bytes[0] != dpv1::kRead || box.data[3] <= request.bytes[3];
}

}  // namespace

void Fieldbus::reset() {
  given_ = {};
  forget();
}

void Fieldbus::forget() {
  has_prm_ = new_prm_ = has_cfg_ = cfg_known_ = acknowledged_ = false;
  fault_ = error::kNone;
  c1_shown_ = c2_shown_ = profibus::kNever;
}

void Fieldbus::start(Cycle now, const Initialisation& given) {
  given_ = given;
  restart(now);
}

void Fieldbus::restart(Cycle now) {
  forget();
  offer();
  user_.initialise(now, given_.slave());
}

void Fieldbus::stop(Cycle now) {
  station_.stop(now);
  user_.msac().c2.reset();
  user_.mail().c2.due.clear();
  forget();
}

void Fieldbus::leave_master(Cycle now) { station_.leave_master(now); }

/// 4.2.2: what an Initiate of a class 2 master is answered (4.4.5, X20).
void Fieldbus::offer() {
  constexpr int kUnits = 10;  // 100 ms in 10 ms
  profibus::C2Offer offered;
  offered.most_data = static_cast<std::uint8_t>(given_.c2_size());
  std::copy_n(given_.dpv1.data(), offered.features.size(), offered.features.data());
  offered.least_timeout = given_.c2_timeout() * kUnits;
  user_.msac().c2.offer(offered);
}

// --- from PROFIBUS ---------------------------------------------------------------------------------------------------

void Fieldbus::eval(Cycle now) {
  judge_prm(now);
  judge_cfg(now);
  take_acknowledgement();
  refuse_requests(now);
}

void Fieldbus::judge_prm(Cycle now) {
  profibus::PrmMail& mail = user_.mail().prm;
  if (!mail.due.waiting()) return;
  mail.due.clear();
  const bool good = given_.prm_fits(mail.block.size);
  fault_ = good ? error::kNone : error::kParametersDiffer;
  if (!good) log_.at_cycle(now, Reason::kParameters, static_cast<unsigned>(mail.block.size), given_.prm_size);
  if (good) {
    prm_ = mail.block;
    has_prm_ = new_prm_ = true;
  }
  user_.prm_verdict(now, good);
}

void Fieldbus::judge_cfg(Cycle now) {
  profibus::CfgMail& mail = user_.mail().cfg;
  if (!mail.due.waiting()) return;
  mail.due.clear();
  if (exchanging()) return;  // the same again (S16)
  const bool good = given_.any_cfg || cfg_may_differ() || given_.cfg.equals(mail.block.bytes.data(), mail.block.size);
  fault_ = good ? error::kNone : error::kConfigurationDiffers;
  if (!good)
    log_.at_cycle(now, Reason::kConfiguration, static_cast<unsigned>(mail.block.size),
                  static_cast<unsigned>(given_.cfg.size));
  if (good) {
    cfg_ = mail.block;
    has_cfg_ = true;
    cfg_known_ = false;
  }
  user_.cfg_verdict(now, good);
}

/// X10: the host and the master allow it.
bool Fieldbus::cfg_may_differ() const {
  return given_.cfg_may_differ() && prm_.size > 1 && (prm_.bytes[0] & kDpv1Enable) != 0 &&
         (prm_.bytes[1] & kCheckCfgMode) != 0;
}

void Fieldbus::take_acknowledgement() {
  profibus::Due& due = user_.msac().alarms.mail().due;
  acknowledged_ = acknowledged_ || due.waiting();
  due.clear();
}

Cycle Fieldbus::next() const {
  const profibus::UserMail& mail = user_.mail();
  const Cycle blocks = std::min({mail.prm.due.since, mail.cfg.due.since, user_.msac().alarms.mail().due.since});
  const Cycle first = refusable(c1(), given_.c1_size()) ? c1().due.since : profibus::kNever,
              second = refusable(c2(), given_.c2_size()) ? c2().due.since : profibus::kNever;
  const Cycle since = std::min({blocks, first, second});
  return since == profibus::kNever ? since : since + 1;
}

/// A request beyond what the host has said in 4.2.2: the module answers it.
bool Fieldbus::refusable(const profibus::AcyclicMail& mail, int most) const {
  return mail.due.waiting() && (!given_.reads_and_writes() || mail.pdu.size > dpv1::kHeader + most);
}

void Fieldbus::refuse_requests(Cycle now) {
  while (refuse_request(now, 1, c1(), given_.c1_size()) || refuse_request(now, 2, c2(), given_.c2_size()))
    continue;  // another one of C2 may have had to wait
}

bool Fieldbus::refuse_request(Cycle now, int area, const profibus::AcyclicMail& mail, int most) {
  if (!refusable(mail, most)) return false;
  const bool long_one = mail.pdu.size > dpv1::kHeader + most;
  profibus::Pdu answer;
  profibus::negative_answer(mail.pdu.bytes[0], long_one ? dpv1::kWriteLength : dpv1::kNotSupported, answer);
  give(now, area, answer.bytes.data(), answer.size);
  return true;
}

// --- from the host ---------------------------------------------------------------------------------------------------

Error Fieldbus::exchange_fault() const {
  if (exchanging()) return given_.any_cfg && !cfg_known_ ? error::kExchange : error::kNone;  // 4.7.3
  if (fault_) return fault_;
  return station_.baud_found() ? error::kExchange : error::kNotConnected;
}

Error Fieldbus::set_inputs(Cycle now, const Frame& frame) {
  if (frame.size() != user_.input_size()) return error::kTooFew;
  if (frame.size() > 0) user_.new_inputs(now, frame.data.bytes.data(), frame.size());
  return error::kNone;
}

void Fieldbus::outputs(Frame& answer) {
  user_.mail().output.due.clear();
  copy(user_.outputs(), answer);
}

bool Fieldbus::prm(Frame& answer) const {
  if (has_prm_) copy(prm_, answer);
  return has_prm_;
}

const profibus::Block<profibus::kMaxCfg>* Fieldbus::known_cfg() const {
  if (has_cfg_) return &cfg_;
  return given_.any_cfg ? nullptr : &given_.cfg;
}

bool Fieldbus::cfg(Frame& answer) {
  const auto* const known = known_cfg();
  if (known != nullptr) copy(*known, answer);
  cfg_known_ = has_cfg_;
  return known != nullptr;
}

bool Fieldbus::lengths(Frame& answer) const {
  const auto* const known = known_cfg();
  if (known == nullptr) return false;
  const profibus::CfgLengths found = profibus::cfg_lengths(known->bytes.data(), known->size);
  const std::uint8_t bytes[] = {static_cast<std::uint8_t>(found.output()), static_cast<std::uint8_t>(found.input())};
  answer.data.assign(bytes, 2);
  return true;
}

void Fieldbus::requests(Frame& answer) {
  const Mailbox boxes[] = {{static_cast<std::uint8_t>(config_.c1_id), c1().pdu.bytes.data(), c1().pdu.size},
                           {static_cast<std::uint8_t>(config_.c2_id), c2().pdu.bytes.data(), c2().pdu.size}};
  const auto show_c1 = [&] {
    if (for_host(c1(), given_.c1_size()) && append(answer, boxes[0], config_)) c1_shown_ = c1().due.since;
  };
  const bool c1_first = c1().due.since <= c2().due.since;
  if (c1_first) show_c1();
  if (for_host(c2(), given_.c2_size()) && append(answer, boxes[1], config_)) c2_shown_ = c2().due.since;
  if (!c1_first) show_c1();
}

Fieldbus::Open Fieldbus::open(const Mailbox& box) {
  profibus::UserMail& mail = user_.mail();
  if (box.id == config_.c1_id && mail.c1.due.waiting() && mail.c1.due.since == c1_shown_) return {&mail.c1, 1};
  if (box.id == config_.c2_id && mail.c2.due.waiting() && mail.c2.due.since == c2_shown_) return {&mail.c2, 2};
  return {nullptr, 0};
}

Error Fieldbus::answer_requests(Cycle now, const Frame& frame) {
  if (frame.size() == 0) return error::kTooFew;
  if (const Error wrong = give(now, frame, true)) return wrong;
  const Error wrong = give(now, frame, false);
  refuse_requests(now);
  return wrong;
}

Error Fieldbus::give(Cycle now, const Frame& frame, bool check_only) {
  for (MailboxReader reader(frame, config_.mailboxes); !reader.at_end();) {
    Mailbox box;
    if (!reader.read(box)) return error::kParameter;
    const Open request = open(box);
    if (request.mail == nullptr || !answer_right(box, request.mail->pdu)) return error::kParameter;
    if (!profibus::answer_fits(now, log_, request.area, box.data, request.mail->pdu)) return error::kParameter;
    if (!check_only) give(now, request.area, box.data, box.size);
  }
  return error::kNone;
}

void Fieldbus::give(Cycle now, int area, const std::uint8_t* pdu, int size) {
  if (area == 1) {
    user_.mail().c1.due.clear();
    user_.c1_answer(now, pdu, size);
  } else {
    user_.mail().c2.due.clear();
    user_.c2_answer(now, pdu, size);
  }
}

Error Fieldbus::diagnosis(Cycle now, const Frame& frame) {
  if (frame.size() == 0) return error::kTooFew;
  MailboxReader reader(frame, config_.mailboxes);
  Mailbox box;
  if (!reader.read(box) || !reader.at_end()) return error::kParameter;
  const DiagnosisBlocks blocks = read_diagnosis(box.data, box.size);
  if (!blocks.right) return error::kParameter;
  if (!blocks.alarm) {
    const bool given = user_.new_diagnosis(now, blocks.channel ? kDiagPresent : kDiagGone, box.data, box.size);
    return given ? error::kNone : error::kResource;
  }
  const bool allowed = given_.alarm_enabled(box.data[1]) && user_.msac().alarms.open() < given_.most_alarms();
  return allowed && user_.new_alarm(now, box.data, box.size) ? error::kNone : error::kResource;
}

}  // namespace dsdpv1::xgate
