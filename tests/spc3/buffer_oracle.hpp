#pragma once
// The buffers of the SPC3 family as the tables of docs/spc3.md ("State machines") have them: the oracle of tests that
// compare the model over all edges. It was written from that page alone. Lengths of outputs and inputs are not 0 here.
#include <array>
#include <cstddef>
#include <utility>

namespace dsdpv1::spc3_oracle {

enum Place : std::size_t { D, N, U, F };  // buffers 1 to 3, nil is 0; exactly one of N and F is nil
using Move = std::array<Place, 4>;        // the place that D, N, U and F come from
struct Edge {
  Move n_nil, n_held;
};
constexpr Move kStays{D, N, U, F};
constexpr Edge kFilled{{F, D, U, N}, {N, D, U, F}};  // D of Dout goes to N
constexpr Edge kNextDout{kStays, {D, F, N, U}};
constexpr Edge kNewDin{{D, U, F, N}, {D, U, N, F}};
constexpr Edge kFetched{kStays, {N, F, U, D}};  // N of Din goes to D

struct Buffers {
  std::array<int, 4> at{1, 0, 2, 3};  // A17

  void take(const Edge& edge) {
    const std::array<int, 4> old = at;
    for (std::size_t to = 0; to < at.size(); ++to) at[to] = old[(old[N] == 0 ? edge.n_nil : edge.n_held)[to]];
  }
  int sm() const { return at[D] | at[N] << 2 | at[U] << 4 | at[F] << 6; }  // 08, 0A
};

struct Dout : Buffers {              // events return true for DX_OUT
  std::array<bool, 4> is_cleared{};  // by buffer
  bool sync = false, filled = false;

  bool& cleared(Place place) { return is_cleared[static_cast<std::size_t>(at[place])]; }
  bool telegram() {
    cleared(D) = false;
    filled = sync;
    return !sync && exchange();
  }
  bool command(bool on) {  // Sync or Unsync is executed (A56)
    sync = on;
    return filled && exchange();
  }
  bool clear() {  // START and Clear_Data; Leave_Master, which then ends `sync`
    cleared(D) = true;
    return exchange();
  }
  int next() {  // the answer of 0B
    const int fresh = at[N] != 0 ? 4 : 0;
    take(kNextDout);
    return at[U] | fresh | (cleared(U) ? 8 : 0);
  }

 private:
  bool exchange() {
    filled = false;
    take(kFilled);
    return true;
  }
};

struct Din : Buffers {
  bool freeze = false;

  int new_din() {  // the answer of 09
    take(kNewDin);
    return at[U];
  }
  void answer() { take(freeze ? kNothing : kFetched); }  // before an answer with inputs
  void command(bool on) {                                // Freeze or Unfreeze is executed (A29)
    freeze = on;
    take(on ? kFetched : kNothing);
  }

 private:
  static constexpr Edge kNothing{kStays, kStays};
};

struct Diagnosis {
  int user = 1, chip = 2;  // A18; user 0: none, an exchange is remembered
  bool sends = false, flag = false;
  int changed = 0;  // how often event 12 has come

  int new_diag() {  // the answer of 0D
    if (sends)
      user = 0;
    else
      exchange();
    return user;
  }
  void accepted() { sends = true; }
  void sent(bool to_holder, bool stat_diag) {
    sends = false;
    if (to_holder && !stat_diag) flag = false;
    if (user == 0) exchange();
  }
  int sm() const { return owner(1) | owner(2) << 2; }  // 0C

 private:
  void exchange() {
    user = std::exchange(chip, 3 - chip);
    flag = true;
    ++changed;
  }
  int owner(int buffer) const { return buffer == user ? 1 : sends && buffer == chip ? 3 : 2; }
};

enum Kind : std::size_t { kPrm, kCfg, kSsa };  // the bits of 2A
enum Stage : std::size_t { kFree, kPending, kWaiting };
constexpr std::array<int, 3> kAnswers{3, 0, 1};  // to an ok or not ok, by stage; a verdict is what is answered 0
constexpr std::array<Stage, 3> kAfterAnswer{kFree, kFree, kPending};

struct Control {
  unsigned select = 0;                  // 2A
  std::array<int, 2> aux{}, room{};     // 2B, 2C; 28, 29
  std::array<int, 3> target{}, size{};  // 30, 32, 2E; 2F, 31, 2D
  int read_cfg = 0;                     // 34
  std::array<Stage, 3> stage{};
  std::array<bool, 3> event{};  // 11, 10, 9
  std::array<int, 3> received{};

  bool telegram(Kind kind, int bytes) {  // a right one, a Set_Prm of more than 7 bytes; false: RR
    if (bytes > room[aux_of(kind)]) return false;
    if (kind == kPrm) drop(kCfg);  // A53
    for (const Kind other : {kPrm, kCfg})
      if (other != kind && stage[other] == kWaiting && aux_of(other) == aux_of(kind)) return false;  // A57
    if (kind == kSsa && stage[kind] != kFree) return false;                                          // A23
    received[kind] = bytes;
    if (stage[kind] == kFree) exchange(kind);
    stage[kind] = stage[kind] == kFree ? kPending : kWaiting;
    return true;
  }
  int answer(Kind kind, bool change = false) {  // 0E to 11; `change`: ok with En_Change_Cfg_Buffer (A26)
    const Stage old = std::exchange(stage[kind], kAfterAnswer[stage[kind]]);
    event[kind] = false;
    if (old == kWaiting) exchange(kind);
    if (old == kPending && change) std::swap(target[kCfg], read_cfg);
    return kAnswers[old];
  }
  void drop(Kind kind) { stage[kind] = kFree; }  // Leave_Master, OFFLINE, A20, A53; SSA_Buffer_Free. The event stays.

 private:
  std::size_t aux_of(Kind kind) const { return select >> kind & 1U; }
  void exchange(Kind kind) {
    std::swap(aux[aux_of(kind)], target[kind]);
    size[kind] = received[kind];
    event[kind] = true;
  }
};

}  // namespace dsdpv1::spc3_oracle
