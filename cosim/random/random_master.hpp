#pragma once
// The master of a random case: valid and invalid DP services, broken telegrams, idle times at their limits.
#include <optional>

#include "bus/telegram/telegram.hpp"
#include "cosim/random/random_setup.hpp"

namespace dsdpv1::cosim {

class RandomMaster {
 public:
  RandomMaster(Random& random, Setup& setup, Stimulus& stimulus, const SearchTimes& times)
      : random_(random), setup_(setup), stimulus_(stimulus), times_(times) {}

  /// Changes the baud rate, and sends telegrams until the chip must have found it.
  void choose_rate();
  void slow_rate();
  void fastest_rate();
  void rate_of_500k();
  /// A telegram that is decided just after the end of the window of 93.75 kbit/s, then one of the next rate. The
  /// initialisation that begins the search is the user's last action.
  void rate_after_a_window();
  void forget_series() { fcv_ = false; }
  /// From now on the line is free of faults: T_SYN is kept, each request begins a series, one master.
  void careful(bool careful) { careful_ = careful; }
  /// From now on acyclic requests are valid, too.
  void sure(bool sure) { sure_ = sure; }
  void slave_diag();
  void set_prm(bool right);
  /// Set_Prm with Unlock by the present holder: the slave is free again.
  void unlock();
  void check_cfg(bool right);
  void data_exchange();
  void global_control();
  void set_slave_address();
  void set_slave_address_to(int address);
  void read_service();
  /// WD_On, WD_Base, so many ms in two factors; then a silence of about 1 or 2 ms.
  void set_prm_with_watchdog(int factor_1, int factor_2);
  void wait_watchdog();
  void set_prm_with_tsdr(int bits);
  /// Group_Ident, Sync and Freeze.
  void set_prm_of_groups(int groups);
  /// Global_Control to these groups.
  void command(int command, int groups);
  /// Requests of a series of which two differ in FCB, not in FCS.
  void other_fcb_same_fcs();
  /// To this SAP, 0: the default one, with FCV, so that it may be repeated.
  void in_a_series(int sap);
  /// Repeats the last request exactly.
  void repeat_last();
  /// Any service except those that parameterise, usually valid, by this master or another.
  void any_service();
  void anything();
  /// To SAP 51 (channel 0), 48 or 47: without data, or a valid or invalid PDU.
  void acyclic_poll(int channel);
  void acyclic_request(int channel);
  /// Send_Timeout in units of 10 ms.
  void initiate(int timeout = 1);
  void abort(int channel);
  /// Waits so many milliseconds, give or take some cycles, while only the watchdog is triggered, or both C2 channels
  /// are polled continuously. `sa`: who triggers the watchdog.
  void wait_timer(int ms, bool polls, int sa = 2);
  /// An idle line, for a while.
  void silence();
  /// ... until BAUD_CONTROL has expired.
  void wait_baud_control();

 private:
  void be_found();
  bus::Bytes prm(bool right);
  void request(int dsap, const bus::Bytes& data);
  void send_acyclic(int dsap, int ssap, const bus::Bytes& data);
  bus::Bytes acyclic_pdu(int channel);
  void other_service();
  void repetition();
  void broken();
  void noise();
  void spike();
  void sd3();
  void send(const bus::Bytes& bytes, Tick idle, bool answered, const bus::WireFaults& faults = {});
  void send(const bus::Telegram& telegram, bool answered = true);
  std::uint8_t function_code();
  std::uint8_t master();
  Tick bit() const;
  Tick idle();

  Random& random_;
  Setup& setup_;
  Stimulus& stimulus_;
  const SearchTimes times_;
  bool fcb_ = true, fcv_ = false, careful_ = false, sure_ = false;
  std::optional<bus::Telegram> last_;
  Tick extra_ = 0;  ///< waited before the next telegram
};

}  // namespace dsdpv1::cosim
