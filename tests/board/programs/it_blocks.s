@ What is left of an IT block is kept by an interrupt that becomes pending inside of it, and by SVC.
        .include "vectors.inc"
function main
        control 0x100, 1
        ldr     r0, =SCS + 0x200
        movs    r1, #1
        movs    r2, #0
        ldr     r3, =PORT
        cmp     r1, #1
        itttt   eq
        streq   r1, [r0]
        addeq   r2, #1
        addeq   r2, #1
        streq   r2, [r3]
        note    3
        movs    r4, #0
        movs    r5, #0
        movs    r1, #1
        cmp     r1, #1
        itete   eq
        svceq   #1
        movne   r5, #1
        moveq   r4, #7
        movne   r5, #2
        cmp     r1, #2
        itt     eq
        svceq   #2
        moveq   r5, #3
        cmp     r1, #1
        itt     eq
        wfieq
        moveq   r7, #1
        exit
function irq0
        note    10
        bx      lr
function svc
        cmp     r1, #9
        ite     eq
        moveq   r6, #8
        movne   r6, #9
        note    20
        bx      lr
