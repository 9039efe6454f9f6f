@ Waits until DEVICE is 1, in the way that the word at 0x20000100 says; then notes the cycle counter and what it has in r5 to r8.
        .include "vectors.inc"
        .equ    DEVICE, 0x40001000
function main
        control 0x100, 3
        control 0xDFC, 0x01000000
        ldr     r2, =0xE0001000
        movs    r1, #1
        str     r1, [r2]
        ldr     r0, =0x20000104
        ldr     r0, [r0]
        cbz     r0, 1f
        ldr     r1, =SCS + 0x010        @ SysTick with this reload value
        str     r0, [r1, #4]
        movs    r0, #7
        str     r0, [r1]
1:      ldr     r3, =DEVICE
        ldr     r4, =0x20000200
        movs    r5, #0
        movs    r6, #0
        movs    r7, #0
        movs    r8, #0
        ldr     r0, =0x20000100
        ldr     r0, [r0]
        tbb     [pc, r0]
ways:   .byte   (look - ways) / 2, (two - ways) / 2, (memory - ways) / 2, (counts - ways) / 2, (stores - ways) / 2, (block - ways) / 2
        .byte   (works - ways) / 2, (calls - ways) / 2, (wide - ways) / 2
        .balign 2
look:   ldr     r1, [r3]                @ at one register
        cmp     r1, #1
        bne     look
        b       over
two:    ldr     r1, [r3, #4]            @ at two
        ldr     r1, [r3]
        cmp     r1, #1
        bne     two
        b       over
memory: ldr     r1, [r3]                @ at memory, too
        ldr     r2, [r4]
        cmp     r1, #1
        bne     memory
        b       over
counts: adds    r5, #1                  @ counting in a register
        ldr     r1, [r3]
        cmp     r1, #1
        bne     counts
        b       over
stores: ldr     r6, [r4]                @ counting in memory
        adds    r6, #1
        str     r6, [r4]
        movs    r6, #0
        ldr     r1, [r3]
        cmp     r1, #1
        bne     stores
        ldr     r6, [r4]
        b       over
block:  ldr     r1, [r3]                @ with an IT block
        cmp     r1, #1
        ite     eq
        moveq   r7, #1
        movne   r7, #0
        bne     block
        b       over
wide:   ldr     r1, [r3]                @ with more than flash gives at once
        .rept   6
        add.w   r8, r8, #0
        .endr
        cmp     r1, #1
        bne     wide
        b       over
works:  ldr     r1, [r3]                @ with more than a few instructions between two looks
        .rept   80
        add     r8, r8, #0
        .endr
        cmp     r1, #1
        bne     works
        b       over
calls:  bl      reads                   @ in a function
        cmp     r1, #1
        bne     calls
over:   ldr     r2, =0xE0001000
        ldr     r2, [r2, #4]
        ldr     r0, =PORT
        str     r2, [r0]
        str     r5, [r0]
        str     r6, [r0]
        str     r7, [r0]
        exit
        .pool
function reads
        ldr     r1, [r3]
        bx      lr
@ Leaves everything as it was.
function irq1
        bx      lr
function sys_tick
        bx      lr
function irq0
        ldr     r0, =PORT
        movs    r1, #99
        str     r1, [r0]
        bx      lr
