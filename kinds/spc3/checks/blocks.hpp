#pragma once
// Set_Prm, Chk_Cfg and Set_Slave_Address for the user: their buffers and answers.
#include <array>
#include <vector>

#include "kinds/spc3/checks/buffers.hpp"
#include "kinds/spc3/checks/check.hpp"
#include "tb/chip/checks/duty.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::spc3_checks {

class Blocks {
 public:
  /// Both must outlive it.
  Blocks(checks::Recorder& recorder, const SeenChip& chip) : recorder_(recorder), chip_(chip) {}

  /// RESET or OFFLINE: nothing is pending.
  void drop();
  /// START: the organisation says where the buffers are.
  void start();
  void accessed(const RegisterAccess& access);
  /// The chip tells that a telegram is for the user.
  void arrived(Tick at, std::size_t block);
  /// The chip has left its master: what the user has not seen may not come.
  void left();
  void pass(Tick now);

  /// New_Cfg_Data was seen and is not answered.
  bool judges_cfg() const { return entries_[1].seen; }

 private:
  struct Entry {
    bool seen = false;    ///< its event, since the last answer
    bool opened = false;  ///< and then its pointer was read
    bool read = false;    ///< and then its buffer
    std::uint8_t pointer = 0;
    checks::Duty answer;
  };
  void touched(const RegisterAccess& access);
  void answered(const RegisterAccess& access, std::size_t block);
  void judge(const RegisterAccess& access, std::size_t block);
  void exchange_cfg(const Entry& cfg);
  bool is_sweep(const RegisterAccess& access);
  Span span_of(std::uint8_t pointer, int length) const;

  checks::Recorder& recorder_;
  const SeenChip& chip_;
  std::array<Entry, kBlocks.size()> entries_;
  std::vector<Span> spans_;  ///< of the buffers that telegrams exchange
  std::uint8_t read_cfg_ = 0;
  int last_read_ = -1, in_a_row_ = 0;  ///< reads of consecutive addresses
  bool swept_ = false;                 ///< up to a command
};

}  // namespace dsdpv1::spc3_checks
