#pragma once
// The words in which a chip's reasons speak of its user's side. The reasons of every DP slave know no register: where
// their text has `{sync}`, the chip says what that is to its user; a chip that says nothing has the GSD's
// name for it.
namespace dsdpv1::profibus {

struct Words {
#define X(name, neutral) const char* name = neutral;
#include "model/profibus/words.inc"
#undef X
};

}  // namespace dsdpv1::profibus
