@ Instructions of several cycles, in which interrupt 0 comes.
        .include "vectors.inc"
function main
        control 0x100, 1
        ldr     r0, =0x20000400
        ldr     r3, =PORT
        mov     r1, #-1
        mov     r2, #1
        bl      long
        str     r2, [r3]
        exit
        .balign 8
function long
        push    {r4-r6, lr}
        str     r2, [r3]
        ldm     r0, {r4-r12}
        stm     r0, {r4-r12}
        udiv    r4, r1, r2
        umull   r4, r5, r1, r1
        cmp     r1, r1
        nop
        itt     eq
        ldmeq   r0, {r4-r6}
        addeq   r4, #1
        pop     {r4-r6, pc}
function irq0
        str     r3, [r3]
        bx      lr
