#pragma once
// The chip's side of the DPRAM as the driver sees it, in memory and without time: it makes one access whenever the user
// releases: when R_REQ and R_STA are both low, in whichever order they fell. It watches the user's discipline: no
// access without ownership, B006 counted once per hold, R_STA only with R_REQ and after two free samples.
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "driver/dsdpv1.h"

namespace dsdpv1 {

struct FakeChip {
  // ------------------------------------------------------------------------------------------------------ behaviour
  bool present = true;         ///< makes its accesses
  bool takes_commands = true;  ///< reads B010 in them
  bool refuses_silently = false;
  bool looks_at_crcs = true;               ///< of the user's blocks: not over SPI and UART (SP15)
  int not_ready_accesses = 0;              ///< accesses until B004 becomes 0xC5
  int busy_samples = 0;                    ///< L_REQ samples that still find the chip active
  std::map<std::uint16_t, int> bad_reads;  ///< address -> how many reads of it return a wrong value
  std::function<void()> before_access;     ///< called at each release
  std::function<void(bool)> on_r_req;

  // ------------------------------------------------------------------------------------------------------- what it saw
  std::array<std::uint8_t, 2048> memory{};
  std::vector<std::string> violations;
  int holds = 0;
  int accesses = 0;
  int pauses = 0;
  std::vector<std::uint8_t> inputs, diagnosis;  ///< as consumed, without CRC
  int initialisations = 0;
  std::vector<std::uint8_t> answers[2];  ///< the last answer of class 1 and 2 with a right CRC, without the CRC
  int answers_taken = 0;                 ///< all, with a right or a wrong CRC
  std::vector<std::string> verdicts;     ///< "prm ok", "cfg wrong" ... in one entry what came in one access

  FakeChip();
  dsdpv1_port port();
  std::uint8_t& at(std::uint16_t address) { return memory.at(address); }
  void user_writes(std::uint16_t address, std::uint8_t value);
  /// The holder releases the DPRAM.
  void let_in();
  /// Puts a block where the chip puts them, with its CRC.
  void put_outputs(const std::vector<std::uint8_t>& data);
  void put_prm(const std::vector<std::uint8_t>& data);
  void put_cfg(std::uint8_t outputs, std::uint8_t inputs_length, const std::vector<std::uint8_t>& data);
  /// A request of a master of class 1 or 2: Function_Num, slot, index, length and the rest.
  void put_request(int master_class, const std::vector<std::uint8_t>& request);
  /// Bytes of the memory from `address`.
  std::vector<std::uint8_t> bytes(std::uint16_t address, std::size_t count) const;

 private:
  void access();
  void take_init();
  void take_verdicts();
  void take_clearing();
  void take_inputs();
  void take_diagnosis();
  void take_answer(int master_class);
  bool crc_is_right(std::uint16_t address, std::size_t count, std::uint16_t crc) const;
  void put_block(std::uint16_t address, const std::vector<std::uint8_t>& block, std::uint16_t crc, std::uint8_t flag,
                 std::uint16_t command = 0x00E);
  void check_ownership(const char* what);
  void set_r_req(bool level);
  void set_r_sta(bool level);
  void lowered();  ///< one of the two fell: H1, the later one lets the chip in
  bool l_req();
  bool l_sta();

  bool r_req_ = false, r_sta_ = false, l_ = false;
  int free_samples_ = 0;
  int counted_ = 0;  ///< writes of B006 in this hold
};

}  // namespace dsdpv1
