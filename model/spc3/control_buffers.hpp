#pragma once
// The control buffers (M 5.1, 5.2.1 to 5.2.3; A22): a Set_Prm, Check_Cfg or Set_Slave_Address is read into its Aux
// buffer, which is then exchanged for the buffer of its kind. While the user has that one, the newest Set_Prm or
// Check_Cfg waits in Aux.
#include <array>

#include "model/profibus/event_log.hpp"
#include "model/profibus/request.hpp"
#include "model/spc3/ram.hpp"

namespace dsdpv1::spc3 {

using profibus::Cycle;

enum class Block : std::uint8_t { kPrm, kCfg, kSsa };

class ControlBuffers {
 public:
  ControlBuffers(Ram& ram, profibus::EventLog& log) : ram_(ram), log_(log) {}

  /// Nothing is with the user.
  void reset() { blocks_ = {}; }

  /// False: the telegram gets RR, as the log says; `spec`: the Prm buffer itself takes it (A37).
  bool has_room(Cycle now, Block block, int size, bool spec = false);
  /// Reads the bytes of a telegram that has room.
  void receive(Cycle now, Block block, const profibus::Request& request, bool spec = false);
  /// Exchanges what has been read for its buffer, and sets its length: the events of that.
  std::uint16_t deliver();
  /// None is pending any more, and none waits.
  void drop(Block block) { of(block) = {}; }

  bool pending(Block block) const { return of(block).state != State::kFree; }
  bool with_user(Block block) const { return of(block).state == State::kWithUser; }
  /// The user, who has it, gives its buffer up. True: the newest that waited is now with the user.
  bool next(Block block);

  template <class Archive>
  void store(Archive& archive) {
    auto& [ram, log, blocks] = *this;
    archive.given(ram, log);
    archive(blocks);
  }

 private:
  enum class State : std::uint8_t { kFree, kOnWay, kWithUser };
  struct Entry {
    State state = State::kFree;
    bool waits = false;     ///< one is in Aux, the user has an older one
    bool is_there = false;  ///< on its way without an exchange
    std::uint8_t size = 0;  ///< of the one in Aux, or on its way

    template <class Archive>
    void store(Archive& archive) {
      auto& [place, behind, direct, length] = *this;
      archive.within(State::kFree, State::kWithUser, place);
      archive(behind, direct, length);
    }
  };
  Entry& of(Block block) { return blocks_[static_cast<std::size_t>(block)]; }
  const Entry& of(Block block) const { return blocks_[static_cast<std::size_t>(block)]; }
  int aux_of(Block block) const;
  bool is_held(Block block, bool spec) const;
  void exchange(Block block);

  Ram& ram_;
  profibus::EventLog& log_;
  std::array<Entry, 3> blocks_{};
};

}  // namespace dsdpv1::spc3
