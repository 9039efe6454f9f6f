#pragma once
// The address map as the user sees it (M tables 3.2 and 3.3): below 16H the sides of reading and writing differ, and a
// read may be a command. Addresses are in Intel order.
#include <algorithm>

#include "model/spc3/ram_store.hpp"

namespace dsdpv1::spc3 {

class AddressMap {
 public:
  AddressMap(profibus::EventLog& log, const Config& config, RamStore& store, Interrupt& interrupt,
             profibus::Station& station)
      : log_(log),
        config_(config),
        variant_(row(config.variant)),
        store_(store),
        interrupt_(interrupt),
        station_(station) {}

  void reset();

  /// An access that the logic takes at the edge of `now`, still to come (A16). An address beyond the map wraps.
  std::uint8_t read(Cycle now, Address address);
  void write(Cycle now, Address address, std::uint8_t value);
  /// Without effect: the cells of commands are 00, and those of registers stay.
  std::uint8_t peek(Address address) const;
  void poke(Address address, std::uint8_t value);

  /// A read of it is a command.
  static bool is_command(Address address);

  /// The edge of `now`, after the station's and the store's: OFFLINE that was asked for (A55), the user's timer (A36).
  void eval(Cycle now);
  Cycle next() const { return std::min(user_timer_, touched_); }
  bool stops() const { return stops_; }
  /// Early_Rdy (A42).
  bool early_ready() const { return store_.modes().has0(regs::kMode0EarlyRdy); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, config, variant, its_store, interrupt, station, stops, violated, user_timer, touched] = *this;
    archive.given(log, config, variant, its_store, interrupt, station);
    archive(stops, violated);
    archive.cycles(user_timer, touched);
  }

 private:
  Address in_map(Address address) const;
  std::uint8_t command(Cycle now, Address address);
  std::uint8_t status(bool high) const;
  std::uint8_t mode1() const;
  void write_register(Cycle now, Address address, std::uint8_t value);
  void write_mode0(Cycle now, Address address, std::uint8_t value);
  void set_mode1(Cycle now, std::uint8_t bits);
  void write_cell(Cycle now, Address address, std::uint8_t value);
  bool may_write(Address address) const;
  void start(Cycle now);
  void stop(Cycle now);
  void begin_timer(Cycle now);
  void take_violation(Cycle now);

  profibus::EventLog& log_;
  const Config& config_;
  const VariantRow& variant_;
  RamStore& store_;
  Interrupt& interrupt_;
  profibus::Station& station_;
  bool stops_ = false;     // OFFLINE as soon as the line is quiet
  bool violated_ = false;  // status bit 3
  Cycle user_timer_ = profibus::kNever;
  Cycle touched_ = profibus::kNever;  // the edge that takes the last access
};

}  // namespace dsdpv1::spc3
