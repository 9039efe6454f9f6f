#pragma once
// Counts the situations of one run from the pins, the model's events and the telegrams on the line.
#include <array>
#include <memory>
#include <string>

#include "cosim/random/play_listener.hpp"
#include "cosim/random/situations.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/random/ruling_watch.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tb/chip/host_reader.hpp"

namespace dsdpv1::cosim {

class SituationWatch : public PlayListener {
 public:
  SituationWatch(const tb::Dsdpv1Settings& chip, Situations& counted)
      : chip_(chip), situations_(counted), rulings_(chip, counted) {}

  void begins(const tb::PinDevice& both) override;
  void pin(Tick at, Side side, PinNumber pin, Level level) override;
  void event(const profibus::Event& event) override;
  void telegram(Tick now, const bus::WireTelegram& telegram) override;
  void evaluated(Tick now, tb::PinDevice& model) override;

 private:
  void input_changed(Tick at, Pin pin, Level level);
  void access_begins(bool write);
  void block_written();
  void cell_read(int address);
  void write_ends();
  void released(Tick at);
  void global_control(unsigned command);
  void host_telegram(const tb::HostTelegram& telegram);
  void host_reply(const bus::Bytes& bytes);
  void exchange_reply(unsigned function);
  /// The part of the access in progress, "-" between two.
  std::string phase() const;
  Level level(Pin pin) const { return levels_[static_cast<std::size_t>(pin)]; }

  const tb::Dsdpv1Settings& chip_;
  Situations& situations_;
  RulingWatch rulings_;
  const tb::PinDevice* model_ = nullptr;
  std::array<Level, kRsuPinCount> levels_{};
  const char* item_ = nullptr;  ///< of the access in progress, counted
  std::array<std::uint8_t, regs::kDpramSize>
      unread_{};  ///< cells of a block: its number and its part of kBlockCells, from 1
  unsigned state_ = 0;
  bool sync_ = false, freeze_ = false;
  std::string service_;  ///< requested from this station and not answered yet; empty: none
  std::unique_ptr<tb::HostReader> reader_;
  bus::Bytes request_;  ///< the last one of the host
};

}  // namespace dsdpv1::cosim
