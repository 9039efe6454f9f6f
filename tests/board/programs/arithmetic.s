@ Ten instructions up to the exit's store, without and with an IT block.
        .include "vectors.inc"
function main
        movs    r0, #10
        movs    r1, #0
loop:
        adds    r1, r0
        subs    r0, #1
        bne     loop
        cmp     r1, #55
        itee    ne
        movne   r2, #1
        moveq   r2, #2
        moveq   r3, #3
        ldr     r4, =EXIT
        str     r1, [r4]
        b       .
