#include "model/xgate/mailbox.hpp"

#include <algorithm>

namespace dsdpv1::xgate {
namespace {

constexpr int kIdAndLength = 2;

int special_bytes(MailboxForm form) { return form == MailboxForm::kSpecial ? 1 : 0; }

}  // namespace

bool MailboxReader::read(Mailbox& box) {
  const int left = frame_.size() - at_, special = special_bytes(form_);
  const std::uint8_t* bytes = frame_.data.bytes.data() + at_;
  at_ = frame_.size();
  if (left < kIdAndLength) return false;
  const int checked = special + bytes[1], whole = kIdAndLength + checked + 1;
  if (left < whole) return false;
  if (xor_of(bytes + kIdAndLength, checked) != bytes[whole - 1]) return false;
  box = {bytes[0], bytes + kIdAndLength + special, bytes[1]};
  at_ -= left - whole;
  return true;
}

bool append(Frame& frame, const Mailbox& box, const Config& config) {
  const int special = special_bytes(config.mailboxes), checked = special + box.size;
  if (frame.size() + kIdAndLength + checked + 1 > kMostData) return false;
  std::uint8_t* bytes = frame.data.bytes.data() + frame.size();
  bytes[0] = box.id;
  bytes[1] = static_cast<std::uint8_t>(box.size);
  bytes[2] = static_cast<std::uint8_t>(config.mailbox_special);  // overwritten if there is none
  std::copy_n(box.data, box.size, bytes + kIdAndLength + special);
  bytes[kIdAndLength + checked] = xor_of(bytes + kIdAndLength, checked);
  frame.data.size += kIdAndLength + checked + 1;
  return true;
}

}  // namespace dsdpv1::xgate
