#pragma once
/* Stands for vcml: the part of its interface that examples/platform_component.cpp uses. */
#include <map>
#include <string>
#include <systemc>

namespace vcml {

inline std::map<std::string, std::string>& stand_in_values() {
  static std::map<std::string, std::string> values;
  return values;
}

/* Takes -c name=value. */
class broker_arg {
 public:
  broker_arg(int argc, const char* const* argv) {
    for (int i = 1; i + 1 < argc; ++i) {
      const std::string setting = argv[i + 1];
      const std::size_t equals = setting.find('=');
      if (argv[i] == std::string("-c")) stand_in_values()[setting.substr(0, equals)] = setting.substr(equals + 1);
    }
  }
};

template <class T>
class property {
 public:
  property(const char* name, const T& initial) : value_(initial) {
    const auto given = stand_in_values().find(std::string(sc_core::sc_get_current_object()->name()) + "." + name);
    if (given != stand_in_values().end()) value_ = static_cast<T>(std::stoul(given->second));
  }
  operator T() const { return value_; }

 private:
  T value_;
};

}  // namespace vcml
