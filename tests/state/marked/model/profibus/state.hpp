#pragma once
// Replaces the core's header for a core whose writer notes the positions of the fields of a state.
#define StateWriter UnmarkedStateWriter
#include "../../../../../model/profibus/state.hpp"
#undef StateWriter

namespace dsdpv1::profibus {

/// Bytes of a state.
struct StateField {
  std::size_t at, size;
};

class StateWriter : public StateArchive<StateWriter> {
 public:
  static constexpr bool kReads = false;

  StateWriter() { fields().clear(); }
  /// The fields of the state written last.
  static std::vector<StateField>& fields() {
    static std::vector<StateField> all;
    return all;
  }

  template <class T>
  void number(const T& value, T least, T most) {
    // for times, the flag that says whether there is one precedes the number; only the number may be below 0
    if (sizeof(T) == sizeof(Tick) && least < T{0})
      fields().back().size += sizeof(T);
    else
      note(sizeof(T));
    writer_.number(value, least, most);
  }
  void bytes(const std::uint8_t* values, std::size_t count) {
    note(count);
    writer_.bytes(values, count);
  }
  void check(bool /*possible*/) {}

  std::vector<std::uint8_t> take() { return writer_.take(); }

 private:
  void note(std::size_t size) {
    std::vector<StateField>& all = fields();
    all.push_back({all.empty() ? 0 : all.back().at + all.back().size, size});
  }

  UnmarkedStateWriter writer_;
};

}  // namespace dsdpv1::profibus
