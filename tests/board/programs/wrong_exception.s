@ NMI interrupts SVCall and changes its number on the stack to 300, that of no exception. Nobody handles the fault.
        .include "vectors.inc"
function main
        svc     #0
        note    99
        exit
function svc
        ldr     r0, =SCS + 0xD04
        ldr     r1, =0x80000000
        str     r1, [r0]
        nop
        bx      lr
function nmi
        ldr     r0, [sp, #28]
        bfc     r0, #0, #9
        orr     r0, #300
        str     r0, [sp, #28]
        bx      lr
