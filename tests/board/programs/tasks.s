@ Two unprivileged threads with stacks of their own take turns through SVC and PendSV.
        .include "vectors.inc"
        .equ    STACK_A, 0x20000400
        .equ    STACK_B, 0x20000604
        .equ    OTHER, 0x20000700
function main
        ldr     r0, =STACK_B - 32
        ldr     r1, =task_b
        str     r1, [r0, #24]
        mov     r1, #0x01000000
        str     r1, [r0, #28]
        ldr     r1, =OTHER
        str     r0, [r1]
        ldr     r0, =STACK_A
        msr     psp, r0
        control 0xD20, 0x00F00000
        movs    r0, #3
        msr     control, r0
        isb
        note    1
        svc     #1
        note    2
        svc     #1
        note    3
        svc     #2
        b       .
function task_b
        note    11
        movs    r0, #0
        msr     primask, r0
        msr     control, r0
        mrs     r2, control
        ldr     r0, =PORT
        str     r2, [r0]
        svc     #1
        note    12
        svc     #1
        b       .
function svc
        mrs     r0, psp
        ldr     r1, [r0, #24]
        ldrb    r1, [r1, #-2]
        cmp     r1, #2
        beq     1f
        control 0xD04, 0x10000000
        bx      lr
1:      exit
function pend_sv
        mrs     r0, psp
        ldr     r1, =OTHER
        ldr     r2, [r1]
        str     r0, [r1]
        msr     psp, r2
        mrs     r3, ipsr
        ldr     r1, =PORT
        str     r3, [r1]
        str     lr, [r1]
        bx      lr
