#include "tb/bench/observer.hpp"

#include "bus/telegram/explain.hpp"

namespace tb {

const std::string& HeardTelegram::words() const {
  if (!words_)
    words_ = telegram.decoded.readable ? bus::explain_line(telegram.decoded.telegram) : std::string("not readable");
  return *words_;
}

}  // namespace tb
