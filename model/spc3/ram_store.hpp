#pragma once
// The chip's SlaveStore: every byte is in the RAM, in the buffers to which the organisation points. A telegram's
// effects on buffers and IRR come at one edge, a delay after its decision (A40), those of the user or a watchdog at
// once. Each service is in the file of its name.
#include "model/profibus/slave_store.hpp"
#include "model/profibus/station.hpp"
#include "model/spc3/control_buffers.hpp"
#include "model/spc3/diag_buffers.hpp"
#include "model/spc3/din_buffers.hpp"
#include "model/spc3/dout_buffers.hpp"
#include "model/spc3/interrupt.hpp"
#include "model/spc3/mode_registers.hpp"
#include "model/spc3/user_watchdog.hpp"

namespace dsdpv1::spc3 {

using profibus::DpState;
using profibus::Request;
using profibus::View;

class RamStore final : public profibus::SlaveStore {
 public:
  /// `station` has this store.
  RamStore(profibus::EventLog& log, const Config& config, Interrupt& interrupt, profibus::Station& station);
  RamStore(const RamStore&) = delete;  // its parts refer to each other
  RamStore& operator=(const RamStore&) = delete;

  void reset();  ///< RESET; the RAM keeps its bytes (A9)
  /// From OFFLINE (A7), and to OFFLINE (A17).
  void start(Cycle now);
  void stop(Cycle now);
  bool online() const { return station_.slave().state() != DpState::kOffline; }

  /// The edge of `now`, after the station's: a telegram's effects, and the end of an answer (A19).
  void eval(Cycle now);
  Cycle next() const { return due_; }
  /// Effects from now on are the user's.
  void set_by_user(bool by_user) { by_user_ = by_user; }

  // --- the user's commands: their answers ---------------------------------------------------------------------------
  std::uint8_t new_din(Cycle now);
  std::uint8_t next_dout() { return dout_.next(); }
  std::uint8_t new_diag(Cycle now);
  std::uint8_t prm_verdict(Cycle now, bool good);
  std::uint8_t cfg_verdict(Cycle now, bool good);
  std::uint8_t free_ssa() {
    blocks_.drop(Block::kSsa);
    return 0;
  }
  /// Registers or cells that the station knows have changed.
  void refresh();
  /// Sets everything that follows from registers and is not part of the state.
  void derive();

  // --- parts --------------------------------------------------------------------------------------------------------
  Ram& ram() { return ram_; }
  const Ram& ram() const { return ram_; }
  ModeRegisters& modes() { return modes_; }
  const ModeRegisters& modes() const { return modes_; }
  const DinBuffers& din() const { return din_; }
  const DoutBuffers& dout() const { return dout_; }
  const DiagBuffers& diag() const { return diag_; }
  std::uint64_t data_exchanges() const { return data_exchanges_; }
  std::uint64_t outputs_missed() const { return outputs_missed_; }

  /// With the slave's state in its place: see Station::store.
  template <class Archive, class Slave>
  void store(Archive& archive, Slave& slave) {
    auto& [log, config, variant, interrupt, station, ram, modes, din, dout, diag, blocks, user_watchdog, by_user, due,
           events, delivers, clears, has_control, control, sync, freeze, filled, cfg_held, locked, data_exchanges,
           outputs_missed, answer] = *this;
    archive.given(log, config, variant, interrupt, station, by_user);
    archive.scratch(answer);
    archive(ram, modes, din, dout, diag, blocks, user_watchdog, events, delivers, clears, has_control, control, sync,
            freeze, filled, cfg_held, locked, data_exchanges, outputs_missed, slave);
    archive.cycles(due);
    slave.store_faults(archive);
  }

 private:
  // ram_store.cpp
  void entered(Cycle now, DpState from, DpState to) override;
  void left(Cycle now, bool by_watchdog) override;
  void baud(Cycle now, profibus::BaudIndex index) override;
  void forget();
  void effect(Cycle now, std::uint16_t events = 0);
  void open_gates();
  profibus::SlaveConfig slave_config() const;
  profibus::SlaveRules rules() const;
  int length(Address cell) const;
  View bytes(Cycle now, Address pointer, int size, int skip = 0);
  // data_exchange.cpp
  profibus::Exchanged exchange(Cycle now, const Request& request, bool fail_safe) override;
  View read_inputs(Cycle now) override;
  View read_outputs(Cycle now) override;
  bool has_io_buffers(Cycle now) const;
  void put_outputs(Cycle now, const Request& request);
  void pass_outputs(Cycle now);
  void clear_outputs(Cycle now);
  void tell_no_outputs(Cycle now);
  void deliver_outputs(bool cleared);
  bool user_is_gone(Cycle now);
  // set_prm.cpp, check_cfg.cpp, set_slave_address.cpp
  bool has_room(Cycle now, const Request& request) override;
  profibus::Take parameters(Cycle now, const Request& request) override;
  bool reserved_right(Cycle now, const Request& request);
  bool is_spec_prm(const Request& request) const;
  profibus::Take configuration(Cycle now, const Request& request, bool exchanging) override;
  profibus::IoLengths configured() override;
  View read_cfg(Cycle now, bool exchanging) override;
  bool has_inputs() const;
  void begin_exchange(Cycle now);
  std::uint8_t take_back(Cycle now, Block block, std::uint16_t event);
  profibus::Take address(Cycle now, const Request& request, bool right) override;
  // global_control.cpp, diagnosis.cpp
  void control(Cycle now, const profibus::Control& control) override;
  profibus::StoredDiagnosis diagnosis(Cycle now, bool to_holder) override;
  void exchange_diag();

  profibus::EventLog& log_;
  const Config& config_;
  const VariantRow& variant_;
  Interrupt& interrupt_;
  profibus::Station& station_;
  Ram ram_;
  ModeRegisters modes_;
  DinBuffers din_;
  DoutBuffers dout_;
  DiagBuffers diag_;
  ControlBuffers blocks_;
  UserWatchdog user_watchdog_;

  bool by_user_ = false;
  Cycle due_ = profibus::kNever;  // the edge at which the following take effect
  std::uint16_t events_ = 0;
  bool delivers_ = false, clears_ = false;  // D becomes N; then it is cleared, and becomes N
  bool has_control_ = false;
  std::uint8_t control_ = 0;  // for 3CH

  bool sync_ = false, freeze_ = false;
  bool filled_ = false;    // D has outputs that Sync holds back
  bool cfg_held_ = false;  // accepted, but A24 has more conditions
  bool locked_ = false;    // 39H at START
  std::uint64_t data_exchanges_ = 0, outputs_missed_ = 0;
  std::array<std::uint8_t, profibus::kMaxIo> answer_{};
};

}  // namespace dsdpv1::spc3
