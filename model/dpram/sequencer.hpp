#pragma once
// The chip's side of the DPRAM (5.1, chapter 8; rulings H1 to H8, D1 to D17): one access a microsecond, one byte a
// cycle, in the order that docs/microarchitecture.md defines. It moves blocks between the DPRAM and profibus::UserSide,
// independent of how the user accesses the DPRAM (strobes or telegrams).
//
// Bytes move lazily: `next()` is the next cycle with an effect visible to others, and the moves before it are simulated
// then (or earlier, by catch_up, when the DPRAM is read). While owns() is not observed, whole accesses that find no
// work are simulated afterwards as well: the sequencer dozes.
#include <array>

#include "model/dpram/inside.hpp"
#include "model/dpram/ram.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/user_side.hpp"

namespace dsdpv1::dpram {

using profibus::Cycle;

/// Sizes of the DPRAM areas.
constexpr profibus::Capacities kCapacities = {regs::kPrmDataSize, regs::kCfgDataSize, regs::kInputDataSize,
                                              regs::kC1DataSize};

class Sequencer {
 public:
  Sequencer(profibus::EventLog& log, Ram& ram, profibus::UserSide& user, Cycle interval, Cycle ready_cycles)
      : log_(log), ram_(ram), user_(user), interval_(interval), ready_cycles_(ready_cycles) {}

  void reset();
  /// The logic leaves reset at `now` (cycle R): the start-up access is due (H6).
  void start_up(Cycle now);
  /// Whether the user holds or requests the DPRAM, as the logic sees it from the coming eval() on (H1). No access
  /// begins meanwhile; a running one continues to its end.
  void user_holds(bool holds) { user_holds_ = holds; }
  /// Whether the CRCs of the user's blocks are judged; if not, all count as right.
  void judge_crc(bool judged) { judges_crc_ = judged; }

  /// The rising edge of `now`. Returns true if it has a result for the station or the user.
  bool eval(Cycle now);
  /// Simulates pending byte moves, and accesses while dozing, up to and including `until`.
  void catch_up(Cycle until);
  Cycle next() const;

  /// True between two accesses, if the next ones have no work until the user or the station acts.
  bool may_doze() const;
  /// True if neither mail of the station nor a status byte waits for an access.
  bool nothing_due() const { return due_items(profibus::kNever) == 0; }
  /// Until wake() no access is an event. Call it only if may_doze(). The caller ensures that owns() is not read and
  /// that catch_up() precedes every act of the user or the station.
  void doze() { dozing_ = true; }
  bool dozing() const { return dozing_; }
  /// Simulates everything up to and including `now`; accesses are events again.
  void wake(Cycle now);
  /// Begins the next access at next(); it ends after kQuietAccess cycles. For a caller who knows from may_doze() that
  /// the access finds no work, because neither user nor station acts meanwhile.
  void begin_quietly() { begin(due_); }
  void end_quietly();

  static constexpr int kHeaderMoves = 6;
  /// Cycles from the start of an access without work to its end.
  static constexpr Cycle kQuietAccess = kHeaderMoves + 1;

  bool owns() const { return phase_ > Phase::kIdle; }       ///< an access of the chip is under way
  bool started_up() const { return phase_ > Phase::kDue; }  ///< the start-up access of this reset has begun
  /// True while the start-up access is due or running.
  bool starts_up() const { return phase_ <= Phase::kDue || phase_ == Phase::kStartUp; }
  bool initialised() const { return initialised_; }  ///< an initialisation has succeeded
  /// The cycle at which new parameters or a new configuration were last flagged for the user (P7); kNever: not since
  /// reset. Read it after eval().
  Cycle told_user() const { return told_user_; }
  std::uint64_t accesses() const { return accesses_; }
  Cycle began() const { return start_; }  ///< the last access
  /// From the start of an access without work to that of the next.
  Cycle period() const { return interval_ > kQuietAccess ? interval_ : kQuietAccess + 1; }
  Cycle longest_wait() const { return longest_wait_; }
  std::uint64_t outputs_overwritten() const {
    return outputs_overwritten_;
  }  ///< in the DPRAM, while B00E.0 was still set
  /// Notes each byte move from now on for inside().
  void note_moves() { notes_moves_ = true; }
  /// State at the edge of `now`, the last one evaluated. Valid only if every edge is evaluated.
  Inside inside(Cycle now) const;

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, ram, user, interval, ready_cycles, user_holds, dozing, judges_crc, told_user, phase, item, origin,
           start, due, op, visible, effect, index, image, image_size, image_crc, user_command1, user_command2,
           chip_command1, chip_command2, dpv1, valid_written, offline_written, status3_written, init_result_due1,
           init_result_due4, chip_status1, chip_status4, status2_set, status2_clear, status2_read, initialised,
           accesses, outputs_overwritten, notes_moves, moved, crc_item, crc_right, longest_wait] = *this;
    archive.given(log, ram, user, interval, ready_cycles, notes_moves);
    archive(user_holds, dozing, judges_crc, initialised);
    archive.within(Phase::kOff, Phase::kStatus2, phase);
    archive.within(Item::kInit, Item::kNone, item, crc_item);
    archive.cycles(told_user, origin, start, due, op, visible, effect);
    archive.within(0, kStartUpMoves + 1, index);
    archive.within(0, kMostBlock, image_size);
    archive(image, image_crc, user_command1, user_command2, chip_command1, chip_command2, dpv1);
    archive(valid_written, offline_written, status3_written, init_result_due1, init_result_due4);
    archive(chip_status1, chip_status4, status2_set, status2_clear, status2_read);
    archive(accesses, outputs_overwritten, moved, crc_right);
    archive.lengths(longest_wait);
  }
  /// Whether a restored state is possible after the edge of `now`: the item in progress is within its bytes, and has
  /// begun lately.
  bool is_possible(Cycle now) const;

 private:
  // The work of one access, in the order of ruling H4; then the changed status bytes by address.
  enum class Item : std::uint8_t {
    kInit,
    kPrmVerdict,
    kCfgVerdict,
    kInputClear,
    kInput,
    kDiag,
    kC1Answer,
    kC2Answer,
    kPrm,
    kCfg,
    kOutput,
    kC1Request,
    kC2Request,
    kValidFlag,
    kOfflineHigh,
    kOfflineLow,
    kChipStatus1,
    kChipStatus2,
    kChipStatus3,
    kChipStatus4,
    kNone,
  };
  enum class Phase : std::uint8_t {
    kOff,       // reset
    kDue,       // the start-up access waits for the user
    kIdle,      // no access: the DPRAM is free or the user's
    kStartUp,   // clearing the RAM
    kHeader,    // B006 := 1, reading B010, B011, B00E, B00F, B005
    kChoose,    // the next item begins, or the access ends
    kRead,      // a block of the user: first bytes up to the length
    kDecode,    // the length is evaluated
    kReadRest,  // the remaining bytes by the length, and the CRC
    kCheck,     // the last byte has arrived
    kCommit,    // the flag is cleared, the block takes effect
    kWrite,     // a block for the user
    kCrcHigh,
    kCrcLow,
    kFlag,     // its flag is set
    kStatus2,  // B00B, second cycle: written back
  };
  struct ByteMove {
    Cycle at = profibus::kNever;
    regs::Address address = 0;
    std::uint8_t byte = 0;
    bool writes = false;
    Phase phase = Phase::kOff;
    Item item = Item::kNone;

    template <class Archive>
    void store(Archive& archive) {
      auto& [when, cell, value, to_ram, in_phase, of_item] = *this;
      archive.cycles(when);
      archive(cell, value, to_ram);
      archive.within(Phase::kOff, Phase::kStatus2, in_phase);
      archive.within(Item::kInit, Item::kNone, of_item);
    }
  };
  static const char* name(Phase phase, Item item);
  struct Area {
    regs::Address base, crc;
    int header;   // bytes up to and including the length
    int maximum;  // largest length
    std::uint8_t flag;
  };
  static const Area& area(Item item);
  static constexpr int kVersionBytes = 4;
  static constexpr int kStartUpMoves = regs::kDpramSize + kVersionBytes + 1;  // the RAM, the version, B006
  static constexpr int kMostBlock = 254;                                      // with its CRC 256 bytes
  static constexpr std::uint8_t kChipWasHere = 1;                             // B006
  // All commands of the user in B010 and B011.
  static constexpr std::uint8_t kUserCommands1 = regs::kUserCommand1Init | regs::kUserCommand1PrmVerdict |
                                                 regs::kUserCommand1CfgVerdict | regs::kUserCommand1Input |
                                                 regs::kUserCommand1Diag;
  static constexpr std::uint8_t kUserCommands2 =
      regs::kUserCommand2InputClear | regs::kUserCommand2C1 | regs::kUserCommand2C2;
  bool is_possible_block() const;
  static bool acyclic_answer(Item item) { return item == Item::kC1Answer || item == Item::kC2Answer; }

  // sequencer.cpp
  bool waiting() const { return phase_ == Phase::kIdle || phase_ == Phase::kDue; }
  void make_moves(Cycle until);
  void begin(Cycle now);
  void end(Cycle now);
  void move(Cycle now);  // the byte move of one cycle
  // doze.cpp
  void make_up_accesses(Cycle until);
  // start_up.cpp
  void move_start_up(Cycle now);
  // access_count.cpp
  void move_header(Cycle now);
  void read_header(int index);
  void header_at_once();
  // access_order.cpp
  void choose(Cycle now);
  unsigned due_items(Cycle now) const;
  unsigned due_commands() const;
  unsigned due_mail(Cycle now) const;
  unsigned due_status() const;
  static constexpr unsigned mask(Item item) { return 1U << static_cast<unsigned>(item); }
  static constexpr unsigned when(Item item, bool due) { return due ? mask(item) : 0U; }
  void start(Item item, Cycle now);
  void next_item() { item_ = static_cast<Item>(static_cast<int>(item_) + 1); }
  // moving bytes; each move advances the cycle of the next one
  void note(regs::Address address, std::uint8_t byte, bool writes);
  std::uint8_t get(regs::Address address) {
    const std::uint8_t byte = ram_.read(address);
    if (notes_moves_) note(address, byte, false);
    return byte;
  }
  void put(regs::Address address, std::uint8_t byte) {
    ram_.write(address, byte);
    if (notes_moves_) note(address, byte, true);
  }
  // block_moves.cpp
  void start_read(Cycle now, const Area& area);
  void read_byte();
  void decode(Cycle now);
  void start_write(Cycle now, Item item);
  void write_byte();
  void write_crc();
  void flag(Cycle now);
  void goto_phase(Phase phase, Cycle visible) {
    phase_ = phase;
    visible_ = visible;
  }
  // status_cells.cpp
  void status_byte(Item item, Cycle now);
  void move_status(Item item, Cycle now);
  void write_status2(Cycle now);
  std::uint8_t status3() const;
  // commit.cpp
  void commit(Cycle now);
  bool input_history() const;
  void clear_input_error(Cycle now);
  bool crc_right(Cycle now, profibus::Reason reason, std::uint8_t error_bit);
  void commit_init(Cycle now);
  void commit_input(Cycle now);
  void commit_diag(Cycle now);
  void commit_verdict(Cycle now);
  void commit_acyclic(Cycle now);
  void refuse_length(Cycle now);
  void init_result(bool good);
  bool offline() const { return user_.mail().state.state == profibus::DpState::kOffline; }

  profibus::EventLog& log_;
  Ram& ram_;
  profibus::UserSide& user_;
  const Cycle interval_, ready_cycles_;
  bool user_holds_ = false, dozing_ = false, judges_crc_ = true;
  Cycle told_user_ = profibus::kNever;

  Phase phase_ = Phase::kOff;
  Item item_ = Item::kNone;  // in progress, or the last one done in this access
  Cycle origin_ = 0;         // cycle R
  Cycle start_ = 0, due_ = 0;
  Cycle op_ = 0;  // the cycle of the next byte move
  Cycle visible_ = profibus::kNever;
  Cycle effect_ = profibus::kNever;  // the last cycle at which a block took effect or was flagged
  int index_ = 0;
  std::array<std::uint8_t, 256> image_{};  // the block in progress, from its first byte
  int image_size_ = 0;                     // without the CRC
  std::uint16_t image_crc_ = 0;

  // B010, B011, B00E, B00F and B005 as this access found them
  std::uint8_t user_command1_ = 0, user_command2_ = 0, chip_command1_ = 0, chip_command2_ = 0, dpv1_ = 0;
  // status bytes as last written, and those to be written
  bool valid_written_ = false;
  std::uint16_t offline_written_ = 0;
  std::uint8_t status3_written_ = 0;
  bool init_result_due1_ = false, init_result_due4_ = false;
  std::uint8_t chip_status1_ = 0, chip_status4_ = 0;
  std::uint8_t status2_set_ = 0, status2_clear_ = 0, status2_read_ = 0;
  bool initialised_ = false;
  std::uint64_t accesses_ = 0, outputs_overwritten_ = 0;
  // for inside()
  bool notes_moves_ = false;
  ByteMove moved_;
  Item crc_item_ = Item::kNone;
  bool crc_right_ = false;
  Cycle longest_wait_ = 0;
};

}  // namespace dsdpv1::dpram
