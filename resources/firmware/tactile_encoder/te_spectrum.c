/* One-sided power of a Hann window, axes summed: S[k] = 2 |X[k]|^2 / (fs sum w^2), times the width of a bin (science.md
 * section 2.3). Bin 0 and fs/2 never lie in a band: it begins at 5 Hz and ends below 0.45 fs. */
#include <stddef.h>

#include "te_parts.h"
#ifdef TE_CMSIS_DSP
#include "arm_math.h"
#endif

#define PI 3.14159265F
#define BIN_TOLERANCE 1e-6F

/* cos(2 pi i / n), by symmetry from a sine between 0 and pi/2. */
static float cosine_of(uint32_t i, uint32_t n) {
    if (2U * i > n) i = n - i;
    if (4U * i > n) return -te_sin(PI * (float)(4U * i - n) / (float)(2U * n));
    return te_sin(PI * (float)(n - 4U * i) / (float)(2U * n));
}

static float sine_of(uint32_t i, uint32_t n) {
    if (2U * i > n) return -sine_of(n - i, n);
    if (4U * i > n) return te_sin(PI * (float)(n - 2U * i) / (float)n);
    return te_sin(2.0F * PI * (float)i / (float)n);
}

void te_spectrum_init(struct te_spectrum* spectrum, float rate_hz, uint32_t length, float low_hz, float top_hz) {
    const float width = rate_hz / (float)length;
    uint32_t i;
    spectrum->length = length;
    for (i = 0; i < length; ++i) {
        spectrum->cosine[i] = cosine_of(i, length);
        spectrum->sine[i] = sine_of(i, length);
    }
    spectrum->first = (uint32_t)(5.0F / width * (1.0F - BIN_TOLERANCE)) + 1U;
    spectrum->rough = (uint32_t)(low_hz / width * (1.0F - BIN_TOLERANCE)) + 1U;
    spectrum->last = (uint32_t)(top_hz / width * (1.0F + BIN_TOLERANCE));
    if (!(top_hz > low_hz)) spectrum->rough = spectrum->last + 1U;
    spectrum->scale = 2.0F / (rate_hz * 0.375F * (float)length) * width; /* the sum of w^2 is 3 N / 8 */
}

#ifdef TE_CMSIS_DSP
/* Its result lies in a second buffer. */
void te_rfft256(float* x, const float* cosine, const float* sine) {
    static arm_rfft_fast_instance_f32 instance;
    static float into[TE_WINDOW];
    uint32_t i;
    (void)cosine;
    (void)sine;
    if (instance.fftLenRFFT != TE_WINDOW) (void)arm_rfft_fast_init_f32(&instance, TE_WINDOW);
    arm_rfft_fast_f32(&instance, x, into, 0U);
    for (i = 0; i < TE_WINDOW; ++i) x[i] = into[i];
}
#else
#define POINTS 128U /* complex */

static void swap(float* a, float* b) {
    const float kept = *a;
    *a = *b;
    *b = kept;
}

/* Puts POINTS complex values into the order of their reversed numbers. */
static void reverse(float* x) {
    uint32_t i;
    uint32_t j = 0;
    for (i = 0; i < POINTS - 1U; ++i) {
        uint32_t bit = POINTS / 2U;
        if (i < j) {
            swap(x + 2U * (size_t)i, x + 2U * (size_t)j);
            swap(x + 2U * (size_t)i + 1U, x + 2U * (size_t)j + 1U);
        }
        while (j & bit) {
            j ^= bit;
            bit /= 2U;
        }
        j |= bit;
    }
}

/* The sum and the difference of a and w b, in their places. */
static void butterfly(float* a, float* b, float c, float s) {
    const float re = b[0] * c + b[1] * s;
    const float im = b[1] * c - b[0] * s;
    b[0] = a[0] - re;
    b[1] = a[1] - im;
    a[0] += re;
    a[1] += im;
}

static void transform(float* x, const float* cosine, const float* sine) {
    uint32_t half;
    reverse(x);
    for (half = 1; half < POINTS; half *= 2U) {
        const uint32_t stride = POINTS / half; /* in the table of 2 POINTS */
        uint32_t k;
        for (k = 0; k < half; ++k) {
            const float c = cosine[(size_t)k * stride];
            const float s = sine[(size_t)k * stride];
            uint32_t i;
            for (i = k; i < POINTS; i += 2U * half) butterfly(x + 2U * (size_t)i, x + 2U * (size_t)(i + half), c, s);
        }
    }
}

/* The spectra of even and odd samples, which lie in Z[k] and Z[POINTS - k], become those of all samples. */
static void split(float* z, float* mirrored, float c, float s) {
    const float even_re = 0.5F * (z[0] + mirrored[0]);
    const float even_im = 0.5F * (z[1] - mirrored[1]);
    const float odd_re = 0.5F * (z[1] + mirrored[1]);
    const float odd_im = 0.5F * (mirrored[0] - z[0]);
    const float re = odd_re * c + odd_im * s;
    const float im = odd_im * c - odd_re * s;
    z[0] = even_re + re;
    z[1] = even_im + im;
    mirrored[0] = even_re - re;
    mirrored[1] = im - even_im;
}

void te_rfft256(float* x, const float* cosine, const float* sine) {
    float even;
    float odd;
    uint32_t k;
    transform(x, cosine, sine);
    even = x[0];
    odd = x[1];
    for (k = 1; k < POINTS / 2U; ++k) split(x + 2U * (size_t)k, x + 2U * (size_t)(POINTS - k), cosine[k], sine[k]);
    x[POINTS + 1U] = -x[POINTS + 1U]; /* of the middle bin, whose twiddle is -i */
    x[0] = even + odd;
    x[1] = even - odd;
}
#endif

/* Another length: the sums as they stand. */
static float direct(const struct te_spectrum* spectrum, uint32_t bin) {
    float re = 0.0F;
    float im = 0.0F;
    uint32_t turn = 0;
    uint32_t i;
    for (i = 0; i < spectrum->length; ++i) {
        re += spectrum->work[i] * spectrum->cosine[turn];
        im += spectrum->work[i] * spectrum->sine[turn];
        turn += bin;
        if (turn >= spectrum->length) turn -= spectrum->length;
    }
    return re * re + im * im;
}

static float power_of(const struct te_spectrum* spectrum, uint32_t from, uint32_t to) {
    float sum = 0.0F;
    uint32_t k;
    for (k = from; k < to; ++k) {
        const float* x = spectrum->work + 2U * (size_t)k;
        sum += spectrum->length == TE_WINDOW ? x[0] * x[0] + x[1] * x[1] : direct(spectrum, k);
    }
    return sum * spectrum->scale;
}

/* One axis of the window, weighed by Hann's. */
static void load(struct te_spectrum* spectrum, const struct te_acceleration* from, uint32_t axis, uint32_t first,
                 int undone) {
    uint32_t i;
    for (i = 0; i < spectrum->length; ++i) {
        const uint32_t at = (first + i) % TE_RING;
        const float weight = 0.5F - 0.5F * spectrum->cosine[i];
        const float x = from->x[axis][at];
        spectrum->work[i] = (undone ? x * from->slot[at].divisor : x) * weight;
    }
}

struct te_power te_window_power(struct te_spectrum* spectrum, const struct te_acceleration* from, uint32_t axes,
                                uint32_t first, int undone) {
    struct te_power sum = {0.0F, 0.0F};
    const uint32_t end = spectrum->last + 1U;
    const uint32_t rough = spectrum->rough < spectrum->first ? spectrum->first : spectrum->rough;
    uint32_t axis;
    for (axis = 0; axis < axes; ++axis) {
        load(spectrum, from, axis, first, undone);
        if (spectrum->length == TE_WINDOW) te_rfft256(spectrum->work, spectrum->cosine, spectrum->sine);
        sum.low += power_of(spectrum, spectrum->first, rough);
        sum.high += power_of(spectrum, rough, end);
    }
    return sum;
}
