@ Interrupts 0 and 1 with priorities 0x80 and 0x40; the handler of 0 is preempted by 1.
        .include "vectors.inc"
function main
        control 0x400, 0x00004080
        control 0x100, 3
        note    1
        control 0x200, 1
        note    2
        exit
function irq0
        push    {lr}
        note    10
        control 0x200, 2
        note    11
        mrs     r2, ipsr
        ldr     r0, =PORT
        str     r2, [r0]
        pop     {pc}
function irq1
        note    20
        str     lr, [r0]
        bx      lr
