/* The public headers must compile alone in C99, even if included twice. */
#include "driver/dsdpv1_acyclic.h"
#include "driver/spc3/spc3.h"

/* Each a second time, after the others. */
#include "driver/dsdpv1.h"
#include "driver/spc3/spc3.h"

dsdpv1_error standalone(dsdpv1_acyclic* acyclic);

dsdpv1_error standalone(dsdpv1_acyclic* acyclic) {
  dsdpv1_acyclic_result result;
  return dsdpv1_acyclic_poll(acyclic, &result);
}
