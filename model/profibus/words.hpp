#pragma once
// A chip's words for its user's side, used in reasons. The reasons of every DP slave name no register: `{sync}` in
// their text is replaced by the chip's word for it, or by the GSD's name if the chip has none.
namespace dsdpv1::profibus {

struct Words {
#define X(name, neutral) const char* name = neutral;
#include "model/profibus/words.inc"
#undef X
};

}  // namespace dsdpv1::profibus
