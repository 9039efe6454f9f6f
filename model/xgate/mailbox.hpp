#pragma once
// Mailboxes, in which requests of C1 and C2, their answers and diagnoses travel (table 4.6, X6): `id, length, special,
// data[length], XOR of special and data`. In the short form `special` is missing.
#include "model/xgate/frame.hpp"

namespace dsdpv1::xgate {

struct Mailbox {
  std::uint8_t id = 0;
  const std::uint8_t* data = nullptr;  ///< valid as long as the bytes that it was read from
  int size = 0;
};

/// Reads the mailboxes of a frame, oldest first.
class MailboxReader {
 public:
  MailboxReader(const Frame& frame, MailboxForm form) : frame_(frame), form_(form) {}

  bool at_end() const { return at_ == frame_.size(); }
  /// False: the mailbox is cut, or its XOR is wrong. The reader is at its end then.
  bool read(Mailbox& box);

 private:
  const Frame& frame_;
  const MailboxForm form_;
  int at_ = 0;
};

/// Appends a mailbox. False: a frame has not enough room, and nothing has changed.
bool append(Frame& frame, const Mailbox& box, const Config& config);

}  // namespace dsdpv1::xgate
