/* The public header must stand alone in C99, twice included. */
#include "tb/driver/dsdpv1.h"

dsdpv1_error standalone(dsdpv1_device* device);

dsdpv1_error standalone(dsdpv1_device* device) { return dsdpv1_service(device); }
