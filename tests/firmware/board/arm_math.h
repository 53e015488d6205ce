/* arm_math.h - what te_spectrum.c takes of CMSIS-DSP, with the names, types and packing of its documentation; the
 * transform is the plain sum in double precision (Transform.c).
 *
 * Thread-safety: pure.
 */
#ifndef ARM_MATH_H
#define ARM_MATH_H

#include <stdint.h>

typedef float float32_t;
typedef enum { ARM_MATH_SUCCESS = 0, ARM_MATH_ARGUMENT_ERROR = -1 } arm_status;
typedef struct {
    uint16_t fftLenRFFT;
} arm_rfft_fast_instance_f32;

arm_status arm_rfft_fast_init_f32(arm_rfft_fast_instance_f32* instance, uint16_t length);
/* Spoils `from`, as the real one does. */
void arm_rfft_fast_f32(const arm_rfft_fast_instance_f32* instance, float32_t* from, float32_t* to, uint8_t inverse);

#endif
