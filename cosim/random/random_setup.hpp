#pragma once
// Shared by the lanes of a random case: the random numbers, and the slave's setup.
#include <cstdint>
#include <random>

#include "bus/bytes.hpp"
#include "cosim/random/stimulus.hpp"

namespace dsdpv1::cosim {

/// The chip's limits of the baud search and of BAUD_CONTROL (S1), for which the master waits.
struct SearchTimes {
  Tick window = 0, baud_control = 0;
  int window_bits = 0;
};

/// Random numbers that are equal with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// 0 .. limit - 1.
  int below(int limit) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(limit)); }
  /// least .. most.
  int between(int least, int most) { return least + below(most - least + 1); }
  bool one_in(int n) { return below(n) == 0; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(engine_()); }
  bus::Bytes bytes(int count) {
    bus::Bytes bytes;
    for (int i = 0; i < count; ++i) bytes.push_back(byte());
    return bytes;
  }
  template <class T, std::size_t N>
  T pick(const T (&list)[N]) {
    return list[static_cast<std::size_t>(below(static_cast<int>(N)))];
  }

 private:
  std::mt19937_64 engine_;
};

/// The initialisation of the slave, as far as master and user need it.
struct Setup {
  std::uint8_t address = 5;
  std::uint8_t command = 0x0F;  ///< enables Set_Slave_Address (bit 0), Freeze, Sync, Fail_Safe
  std::uint16_t ident = 0x0CC9;
  int max_input = 244, max_output = 244, max_diag = 32, max_prm = 237, max_cfg = 200;
  int prm_mode = 0, cfg_mode = 0;
  bus::Bytes cfg = {0x11, 0x21};  ///< of the initialisation
  int inputs = 2, outputs = 2;    ///< bytes that `cfg` describes
  int rate = 0;
  bool dpv1 = false;       ///< permitted by the user and enabled in Set_Prm
  bool locked = false;     ///< the address (S5)
  bool fail_safe = false;  ///< requested in the last Set_Prm
  /// Function, slot and index of the last acyclic requests to SAP 51, 48 and 47.
  std::uint8_t function[3] = {0x5E, 0x5E, 0x5E}, slot[3] = {}, index[3] = {};
};

}  // namespace dsdpv1::cosim
