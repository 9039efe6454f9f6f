@ Four interrupts pending at once behind PRIMASK: 67 and 2 with 0x20, 0 with 0x40, 1 with 0x40. Then what BASEPRI keeps out.
        .include "vectors.inc"
function main
        control 0x400, 0x00204040
        ldr     r0, =SCS + 0x400 + 67
        movs    r1, #0x20
        strb    r1, [r0]
        control 0x100, 7
        control 0x108, 8
        cpsid   i
        control 0x208, 8
        control 0x200, 7
        note    1
        cpsie   i
        nop
        note    2
        movs    r1, #0x40
        msr     basepri, r1
        control 0x200, 5
        note    3
        movs    r1, #0
        msr     basepri, r1
        nop
        note    4
        cpsid   f
        control 0x200, 4
        note    5
        cpsie   f
        nop
        note    6
        exit
function irq0
        note    10
        bx      lr
function irq1
        note    11
        bx      lr
function irq2
        note    12
        bx      lr
function irq67
        note    77
        bx      lr
