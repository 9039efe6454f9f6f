#include "model/xgate/module.hpp"

#include <algorithm>

#include "model/profibus/chip_state.hpp"

namespace dsdpv1::xgate {
namespace {

/// The head of a saved state.
struct StateHead {
  static constexpr profibus::StateFrame kFrame{0x3156'4554'4147'58, 1};  // "XGATEV1"

  explicit StateHead(const Config& of) : config(of) {}
  template <class Archive>
  void store_name(Archive& /*archive*/) {}
  std::string title() const { return "XGate-DPS10"; }
  template <class Tell>
  void each_parameter(const Tell& tell) {
    config.each_parameter(tell);
  }

  Config config;
};

}  // namespace

Module::Module(const Config& settings)
    : config(settings),
      user_(log_, kCapacities, station_),
      station_(log_, {}, user_, &user_.msac()),
      firmware_(log_, config, user_, station_) {
  user_.reset();
}

void Module::set_reset(Cycle now, bool low) {
  if (low) user_.reset();
  firmware_.set_reset(now, low);
}

void Module::eval(Cycle now) {
  now_ = now;
  firmware_.eval(now);
  station_.eval(now);
}

Cycle Module::next() const { return std::min({station_.next(), station_.unseen(), firmware_.next(now_)}); }

std::vector<std::uint8_t> save(Module& module) { return profibus::save_chip<StateHead>(module); }

void restore(std::unique_ptr<Module>& module, const std::uint8_t* bytes, std::size_t size) {
  profibus::restore_chip<StateHead>(module, bytes, size);
}

}  // namespace dsdpv1::xgate
