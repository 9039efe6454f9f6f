#ifndef INTERRUPTS_H
#define INTERRUPTS_H
/* The handlers that the vector table (startup.c) points to. */

void reset_handler(void);
/* Every millisecond (board.c). */
void systick_handler(void);
/* EXTI lines 5 to 9, of which only line 6, INTR0, is enabled (board.c). */
void exti9_5_handler(void);

#endif /* INTERRUPTS_H */
