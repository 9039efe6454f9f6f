#include "tb/bench/observer.hpp"

#include "bus/telegram/explain.hpp"

namespace dsdpv1::tb {

const std::string& HeardTelegram::words() const {
  if (!words_)
    words_ = telegram.decoded.readable ? bus::explain_line(telegram.decoded.telegram) : std::string("not readable");
  return *words_;
}

}  // namespace dsdpv1::tb
