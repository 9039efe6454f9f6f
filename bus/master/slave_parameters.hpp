#pragma once
// A class-1 master's data about its bus and one slave. The bench derives it from a GSD file; tests write it directly.
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "bus/baud.hpp"
#include "bus/bytes.hpp"
#include "bus/master/alarms.hpp"

namespace dsdpv1::bus {

/// Outputs from one data exchange to the next.
enum class OutputPattern : std::uint8_t {
  kFixed,   ///< as last set
  kCount,   ///< each byte is the number of the exchange, from 1 on, modulo 256
  kRandom,  ///< of a seed
};

struct SlaveParameters {
  std::string name = {};       ///< for messages
  std::uint8_t address = 0;    ///< 0..126
  std::uint16_t ident = 0;     ///< Ident_Number
  Bytes user_prm = {};         ///< Set_Prm after the first 7 bytes, at most 237
  Bytes cfg = {};              ///< Chk_Cfg data, 1..244
  int input_length = 0;        ///< bytes the slave sends, 0..244
  int output_length = 0;       ///< bytes the slave gets, 0..244
  std::uint8_t wd_fact_1 = 0;  ///< watchdog = fact 1 x fact 2 x 10 ms (or 1 ms); 0 switches it off
  std::uint8_t wd_fact_2 = 0;
  bool wd_base_1ms = false;                ///< sets WD_Base in the first user byte
  std::uint8_t group_ident = 0;            ///< bit n: member of group n + 1
  std::uint8_t min_tsdr = kMinTsdrBits;    ///< bit times; Personality::kHighAlways sends 0 instead
  bool sync = false, freeze = false;       ///< requests these modes
  bool lock = true;                        ///< Lock_Req
  bool fail_safe = false;                  ///< sets Fail_Safe; the slave gets empty outputs instead of zeros in Clear
  bool dpv1 = false;                       ///< sets DPV1_Enable; user_prm is filled up to three bytes
  AlarmParameters alarms = {};             ///< with `dpv1` only
  int c1_response_timeout = 100;           ///< C1_Response_Timeout, units of 10 ms: maximum wait for a C1 answer
  std::int64_t min_slave_interval_us = 0;  ///< Min_Slave_Intervall: polled no more often than this
  std::array<int, kBaudCount> max_tsdr = {};  ///< bit times by baud index, 0 = that of the baud rate; for monitors
};

/// The data of Set_Prm (table 19). `min_tsdr` 0 leaves the slave's value unchanged.
Bytes set_prm_data(const SlaveParameters& slave, std::uint8_t min_tsdr);

/// Default T_TR: some thirty messages of full length, 4.2 ms at 12 Mbit/s and 33 ms at 1.5 Mbit/s.
constexpr int kTargetRotationBits = 50'000;

/// Bus parameters of EN 50170, in bit times unless noted. Unset ones follow the baud rate.
struct BusParameters {
  std::optional<int> slot_bits = {};    ///< T_SL
  std::optional<int> set_bits = {};     ///< T_SET
  std::optional<int> quiet_bits = {};   ///< T_QUI
  std::optional<int> max_retries = {};  ///< repetitions of an unanswered request; default 1, at 3/6/12 Mbit/s 2/3/4
  /// Cycles from one FDL status poll for the live list to the next; 0: none. In a ring it is G: the GAP is polled, one
  /// address per token, and again G x T_TR after the end of that.
  int gap_factor = 10;
  std::uint8_t highest_address = 126;  ///< HSA: last address of the live list
  /// Minimum time between the starts of two cycles; unset: the greatest of the master's slaves.
  std::optional<std::int64_t> min_slave_interval_us = {};
  bool token = true;  ///< passes the token to itself after each cycle, as a single master does
  /// Takes part in a ring of several masters: learns the active stations, waits to be polled in the GAP, shares the
  /// token. false: a single master, which passes the token to itself after each cycle (`token`).
  bool ring = false;
  /// T_TR: target time in bit times for one rotation of the token; ring only. The remaining time is the token hold
  /// time.
  int target_rotation_bits = kTargetRotationBits;
  std::int64_t clock_ppm = 0;  ///< error of the sender's clock; positive = slow

  int slot(int baud_index) const;
  int retries(int baud_index) const;
  /// T_SM: the safety margin before a request.
  int safety(int baud_index) const;
  /// T_ID1: idle time after an answer or a token.
  int id1(int baud_index) const;
  /// T_ID2: idle time after a telegram without answer.
  int id2(int baud_index) const;
};

/// Behaviour where EN 50170 leaves a choice; both kinds are in the field (ruling "Real masters differ").
enum class Personality : std::uint8_t {
  kHighAlways,  ///< SRD high for everything, SD3 whenever 8 bytes fit, min_TSDR 0, finds slaves by Slave_Diag
  kClassic,     ///< SRD low for Slave_Diag, Set_Prm and Chk_Cfg, Clear before Set_Prm, finds slaves by FDL status
};

}  // namespace dsdpv1::bus
