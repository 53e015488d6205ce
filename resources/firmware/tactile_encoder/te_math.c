#include "te_parts.h"

#define LOG2_E 1.44269504F
#define LN_2 0.693147181F

/* Reading another member than the one written gives its bytes anew (C99 with TC3, 6.5.2.3). */
union bits {
    float value;
    uint32_t bits;
};

uint32_t te_bits(float x) {
    union bits both;
    both.value = x;
    return both.bits;
}

static float from_bits(uint32_t x) {
    union bits both;
    both.bits = x;
    return both.value;
}

float te_nan(void) { return from_bits(0x7FC00000U); }

int te_is_number(float x) { return (te_bits(x) & 0x7F800000U) != 0x7F800000U; }

float te_log2(float x) {
    const uint32_t bits = te_bits(x);
    int32_t exponent = (int32_t)(bits >> 23U) - 127;
    float m = from_bits((bits & 0x007FFFFFU) | 0x3F800000U);
    float z;
    float z2;
    if (m > 1.41421356F) {
        m *= 0.5F;
        ++exponent;
    }
    /* ln m = 2 artanh((m - 1) / (m + 1)) */
    z = (m - 1.0F) / (m + 1.0F);
    z2 = z * z;
    z *= 1.0F + z2 * (1.0F / 3.0F + z2 * (0.2F + z2 * (1.0F / 7.0F + z2 * (1.0F / 9.0F))));
    return (float)exponent + 2.0F * LOG2_E * z;
}

float te_exp2(float x) {
    int32_t whole;
    float f;
    if (!(x > -126.0F)) return 0.0F;
    if (x > 127.0F) x = 127.0F;
    whole = (int32_t)(x < 0.0F ? x - 0.5F : x + 0.5F);
    f = (x - (float)whole) * LN_2;
    f = 1.0F + f * (1.0F + f * (0.5F + f * (1.0F / 6.0F + f * (1.0F / 24.0F + f * (1.0F / 120.0F + f / 720.0F)))));
    return f * from_bits((uint32_t)(whole + 127) << 23U);
}

float te_sin(float x) {
    const float y = x * x;
    const float terms = 1.0F / 6227020800.0F;
    return x * (1.0F + y * (-1.0F / 6.0F +
                            y * (1.0F / 120.0F + y * (-1.0F / 5040.0F + y * (1.0F / 362880.0F +
                                                                             y * (-1.0F / 39916800.0F + y * terms))))));
}

float te_seconds(int64_t ns) {
    if (ns > INT32_MIN && ns < INT32_MAX) return (float)(int32_t)ns * 1e-9F;
    ns /= 1000;
    if (ns > INT32_MIN && ns < INT32_MAX) return (float)(int32_t)ns * 1e-6F;
    return ns > 0 ? 1e9F : -1e9F;
}

int64_t te_ns(float seconds) {
    int32_t us;
    if (!(seconds > 0.0F)) return 0;
    if (!(seconds < 2000.0F)) return 2000 * TE_SECOND_NS;
    us = (int32_t)(seconds * 1e6F);
    return ((float)us * 1e-6F < seconds ? (int64_t)us + 1 : (int64_t)us) * 1000;
}
