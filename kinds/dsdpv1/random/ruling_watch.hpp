#pragma once
// Counts situations of rulings that no event names and no service or transfer shows: D16, R6, R9, P13, S11, V13, V15.
#include <array>
#include <bitset>
#include <map>

#include "bus/telegram/telegram.hpp"
#include "cosim/random/situations.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "model/profibus/event.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::cosim {

class RulingWatch {
 public:
  RulingWatch(const tb::Dsdpv1Settings& chip, Situations& counted) : chip_(chip), situations_(counted) {}

  void begins(const tb::PinDevice& model) { model_ = &model; }
  /// RESET falls.
  void reset();
  void event(const profibus::Event& event);
  /// The chip's access works on another item, "-" after it.
  void works_on(const char* item);
  /// A block of this item is complete in the DPRAM.
  void block_written(const char* item);
  /// A request to this station, or the answer to it.
  void request(const bus::Telegram& telegram);
  void answer(const bus::Telegram& telegram);
  /// The user has written or read a cell that was his.
  void written(int address);
  void read(int address);

 private:
  /// An access of the chip, as far as it concerns B00B.2 and B011.7 (D16).
  struct Access {
    bool runs = false, history = false, asked = false, was_wrong = false;
    bool inputs = false, refused = false, wrong = false;  ///< a block of inputs; a refusal; a CRC of inputs
  };
  void access_begins();
  void access_ended();
  void min_tsdr(int bits);
  void answered(const char* who, int sap, int bytes);
  void acyclic_event(const profibus::Event& event);
  void c2_ended(int sap, bool by_user_timer);

  const tb::Dsdpv1Settings& chip_;
  Situations& situations_;
  const tb::PinDevice* model_ = nullptr;
  Access access_;
  const char* min_tsdr_ = nullptr;             ///< counts from the next answer on
  std::array<bool, 2> early_{};                ///< a request of C1, C2 came while B011.0, B011.1 was set
  std::map<int, int> asked_;                   ///< bytes of a read, by SAP
  int read_sap_ = 0, read_bytes_ = 0;          ///< of the last request, if it reads
  int comes_ = 0, waits_ = 0, with_user_ = 0;  ///< SAPs of C2 requests: not written yet; after the other; in the DPRAM
  bool has_waited_ = false;                    ///< the one in the DPRAM
  bool withdrawn_ = false;                     ///< the user's time for the one in the DPRAM has ended
  std::bitset<regs::kDpramSize> reserved_written_;
};

}  // namespace dsdpv1::cosim
