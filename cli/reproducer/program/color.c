// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The sixth part of every reproducer: what the colour target holds.
enum Kind { UNORM, SRGB, HALF, BINARY32, UINT };  // of a component

static enum Kind kind_of(uint32_t component) {
    return COLOR_KIND == SRGB && component == 3 ? UNORM : (enum Kind)COLOR_KIND;
}

// The stored code of a component, from the bytes of a texel.
static uint32_t code_at(const void* plane, uint32_t at, uint32_t component) {
    const uint8_t* texel = (const uint8_t*)plane + (size_t)bytes_of(TARGET) * at;
    uint32_t code = 0, k;
    for (k = 0; k < kColorBits[component]; ++k) {
        const uint32_t bit = kColorFirst[component] + k;
        code |= (uint32_t)(texel[bit / 8] >> bit % 8 & 1) << k;
    }
    return code;
}

// Orders codes as their values are ordered; -0 is 0.
static int64_t code_key(uint32_t component, uint32_t code) {
    const enum Kind kind = kind_of(component);
    const uint32_t sign = kind == HALF ? 0x8000U : kind == BINARY32 ? 0x80000000U : 0;
    return code & sign ? -(int64_t)(code & ~sign) : (int64_t)code;
}

// Of a floating-point code, by its key; NaN beyond infinity.
static double value_of(uint32_t component, int64_t key) {
    const uint32_t size = (uint32_t)(key < 0 ? -key : key);
    const uint32_t fraction = kind_of(component) == HALF ? 10 : 23;
    const int most = kind_of(component) == HALF ? 31 : 255;
    const int exponent = (int)(size >> fraction);
    const double whole = size & ((1U << fraction) - 1);
    double value;
    if (exponent >= most) {
        value = whole == 0 ? (double)INFINITY : (double)NAN;
    } else if (exponent == 0) {
        value = ldexp(whole, 2 - (most + 1) / 2 - (int)fraction);
    } else {
        value = ldexp(whole + ldexp(1, (int)fraction),
                      exponent + 1 - (most + 1) / 2 - (int)fraction);
    }
    return key < 0 ? -value : value;
}

// Whether a code may be stored of a number that the shader wrote.
static int may_store(uint32_t component, uint32_t code, double written) {
    const int64_t key = code_key(component, code);
    const double steps = ldexp(1, kColorBits[component]) - 1;
    const double scaled = (written < 0 ? 0 : written > 1 ? 1 : written) * steps;
    double below, above;
    switch (kind_of(component)) {
        case UNORM:
            if (COLOR_SLACK > 0) {
                return code >= scaled - COLOR_SLACK && code <= scaled + COLOR_SLACK;
            }
            return code >= floor(scaled) && code <= ceil(scaled);
        case UINT:
            return written == code;
        case SRGB:
            return 1;  // by its range
        default:
            break;
    }
    below = value_of(component, key - 1);
    above = value_of(component, key + 1);
    return value_of(component, key) == written || (below < written && !(above <= written));
}

static int is_right_color(const struct Color* c, const void* plane, uint32_t at,
                          const float* captured) {
    const uint32_t mask = kDraws[c->draw].mix.colorWriteMask;
    uint32_t k;
    for (k = 0; k < 4; ++k) {
        const uint32_t code = code_at(plane, at, k);
        const int64_t key = code_key(k, code);
        if (kColorBits[k] == 0) {
            continue;
        }
        if (captured != NULL && mask >> k & 1 && kind_of(k) != SRGB
                ? !may_store(k, code, (double)captured[k])
                : key < c->low[k] || key > c->high[k]) {
            return 0;
        }
    }
    return 1;
}

static void print_color(const struct Color* c, const void* plane, uint32_t at) {
    uint32_t k;
    printf("colour: expected codes");
    for (k = 0; k < 4; ++k) {
        if (kColorBits[k] > 0) {
            printf(" %lld to %lld", (long long)c->low[k], (long long)c->high[k]);
        }
    }
    printf(", got");
    for (k = 0; k < 4; ++k) {
        if (kColorBits[k] > 0) {
            printf(" %lld", (long long)code_key(k, code_at(plane, at, k)));
        }
    }
    printf("\n");
}
