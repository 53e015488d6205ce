/* The encoder's transform as it is with CMSIS-DSP, under names of its own. */
#include <math.h>

#include "arm_math.h"

#define TE_CMSIS_DSP
#define te_rfft256 te_rfft256_of_cmsis
#define te_spectrum_init te_spectrum_init_of_cmsis
#define te_window_power te_window_power_of_cmsis
#include "resources/firmware/tactile_encoder/te_spectrum.c"

arm_status arm_rfft_fast_init_f32(arm_rfft_fast_instance_f32* instance, uint16_t length) {
    instance->fftLenRFFT = length;
    return ARM_MATH_SUCCESS;
}

void arm_rfft_fast_f32(const arm_rfft_fast_instance_f32* instance, float32_t* from, float32_t* to, uint8_t inverse) {
    const uint32_t n = inverse ? 0U : instance->fftLenRFFT;
    uint32_t k, i;
    for (k = 0; k <= n / 2U; ++k) {
        double re = 0.0, im = 0.0;
        for (i = 0; i < n; ++i) {
            const double turn = 2.0 * 3.14159265358979323846 * (double)(k * i % n) / (double)n;
            re += (double)from[i] * cos(turn);
            im -= (double)from[i] * sin(turn);
        }
        if (k == n / 2U) {
            to[1] = (float32_t)re;
        } else {
            to[2U * k] = (float32_t)re;
            if (k > 0U) to[2U * k + 1U] = (float32_t)im;
        }
    }
    for (i = 0; i < n; ++i) from[i] = 0.0F;
}
