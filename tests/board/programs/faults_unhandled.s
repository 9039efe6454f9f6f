@ No handler for any fault.
        .include "faults.inc"
