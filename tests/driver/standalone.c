/* The public headers must stand alone in C99, twice included. */
#include "driver/dsdpv1_acyclic.h"

/* Each again, after the other. */
#include "driver/dsdpv1.h"

dsdpv1_error standalone(dsdpv1_acyclic* acyclic);

dsdpv1_error standalone(dsdpv1_acyclic* acyclic) {
  dsdpv1_acyclic_result result;
  return dsdpv1_acyclic_poll(acyclic, &result);
}
