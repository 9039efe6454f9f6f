@ SysTick every 100 cycles, three times; COUNTFLAG and the counter are then read.
        .include "vectors.inc"
function main
        movs    r7, #0
        control 0x014, 99
        control 0x018, 0
        control 0x010, 7
1:      cmp     r7, #3
        blt     1b
        control 0x010, 5
        ldr     r4, [r0]
        ldr     r5, [r0, #8]
        ldr     r6, [r0, #8]
        ldr     r8, [r0, #4]
        exit
function sys_tick
        adds    r7, #1
        ldr     r0, =PORT
        str     r7, [r0]
        bx      lr
