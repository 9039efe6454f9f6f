#pragma once
// Shared by the hosts at SPI and UART: valid and invalid telegrams, cells and blocks by telegrams, straps.
#include "kinds/dsdpv1/random/random_host.hpp"

namespace dsdpv1::cosim {

class RandomSerial : public RandomHost {
 public:
  RandomSerial(Random& random, Stimulus& stimulus, HostMode mode) : RandomHost(random, stimulus), mode_(mode) {}

  void strap() override;
  void write(int address, int value) override;
  void read(int address) override { ask(address, random_.one_in(8) ? random_.between(1, 40) : 1); }
  void block(int address, int crc_address, const bus::Bytes& bytes) override;
  void rude() override;
  bool own_traffic() override;
  void break_rules() override;

 protected:
  /// Sends a telegram, adding its CRC; a reply of so many bytes is expected.
  virtual void send(const bus::Bytes& telegram, int reply) = 0;
  /// Inputs, or a block that an exchange may carry; returns false if it cannot.
  virtual bool exchange(int address, const bus::Bytes& bytes) = 0;
  virtual void own_telegram() = 0;

  std::uint8_t start(int command) { return static_cast<std::uint8_t>(command << 5 | card()); }
  /// The address in a telegram: usually the card's.
  std::uint8_t card();
  /// The third of the kinds of telegrams, specific to the port, to `address` if it names one.
  virtual void third(int address, const bus::Bytes& bytes) = 0;

  /// A telegram of hundreds of bytes, rarer the longer it lasts.
  bool is_long() { return random_.one_in(3 + 3 * slowness()); }
  void ask(int address, int count);
  void write_bytes(int address, const bus::Bytes& bytes);
  /// Adds the CRC, and sometimes changes a byte.
  bus::Bytes finished(bus::Bytes telegram);

  int adr_ = 1, ubr_ = 7, uiv_ = 0;

 private:
  void wrong_telegram();
  void straps();

  HostMode mode_;
};

}  // namespace dsdpv1::cosim
