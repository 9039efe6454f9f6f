@ WFI with PRIMASK set wakes without the handler; WFE with SEV does not sleep; WFI until SysTick; then SLEEPONEXIT.
        .include "vectors.inc"
function main
        control 0x100, 3
        cpsid   i
        note    1
        wfi
        note    2
        cpsie   i
        nop
        note    3
        sev
        wfe
        note    4
        wfe
        note    5
        wfi.w
        note    6
        control 0x014, 999
        control 0x018, 0
        control 0x010, 7
        wfi
        note    7
        control 0x010, 0
        control 0xD10, 2
        wfi
        note    8
        exit
function irq0
        note    10
        bx      lr
function irq1
        note    11
        control 0xD10, 0
        bx      lr
function sys_tick
        note    12
        bx      lr
