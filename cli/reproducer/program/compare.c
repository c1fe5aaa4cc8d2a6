// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The last part of every reproducer: the drawings that must agree bit for bit, and what is told.
static uint32_t bits_of(float number) {
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static uint32_t word_of(const struct Drawing* d, uint32_t plane, uint32_t at, uint32_t k) {
    const enum Role role = role_of(d, plane);
    return role == DEPTH
               ? bits_of(depth_of(d, at))
               : ((const uint32_t*)drawn[d - kDrawings][plane])[bytes_of(role) / 4 * at + k];
}

// The word that a drawing must have, by that of the case as it stands. `original`: its plane there.
static uint32_t expected_word(const struct Drawing* d, uint32_t plane, uint32_t original,
                              uint32_t at, uint32_t k, int is_clear) {
    const uint32_t word = word_of(kDrawings, original, at, k);
    switch (role_of(d, plane)) {
        case TARGET:
            return word;
        case DEPTH:
            return (d->masks_depth || (is_clear && d->other_depth_clear)) ? bits_of(clear_depth(d))
                                                                         : word;
        default:
            break;
    }
    if (is_clear || is_masked(d, plane)) {
        return bits_of(clear_number(d, plane));
    }
    return plane == HITS && HAS_INSTRUMENTS
               ? bits_of(number(HITS, at, k) - clear_number(kDrawings, HITS) +
                         clear_number(d, HITS))
               : word;
}

// Colours whose texels are no whole words are compared by their codes.
static int is_same_color(const struct Drawing* d, uint32_t at) {
    uint32_t k;
    for (k = 0; k < 4; ++k) {
        if (code_at(drawn[d - kDrawings][color_plane(d)], at, k) !=
            code_at(drawn[0][color_plane(kDrawings)], at, k)) {
            return 0;
        }
    }
    return 1;
}

// Tells the first word of a sample that is not what it must be.
static void compare_sample(const struct Drawing* d, uint32_t at) {
    const int is_clear = HAS_INSTRUMENTS && number(HITS, at, 0) == NO_HITS &&
                         number(HITS, at, 1) == NO_HITS;
    uint32_t plane, k;
    for (plane = 0; plane < planes_of(d); ++plane) {
        const enum Role role = role_of(d, plane);
        uint32_t original = plane;
        if (role == TARGET) {
            if (!is_same_color(d, at) && tell(at)) {
                printf("%s: the colour has other bits\n", d->name);
            }
            continue;
        }
        if (role == DEPTH) {
            original = depth_plane(kDrawings);
        } else if (role == ATTRIBUTE && plane - FIRST_ATTRIBUTE >= kDrawings->attributes) {
            original = plane - kDrawings->attributes;  // a copy
        }
        for (k = 0; k < bytes_of(role) / 4; ++k) {
            const uint32_t expected = expected_word(d, plane, original, at, k, is_clear);
            const uint32_t got = word_of(d, plane, at, k);
            const int may_be_clear = role == DEPTH && d->other_depth_clear &&
                                     word_of(kDrawings, original, at, k) == bits_of(DEPTH_CLEAR) &&
                                     got == bits_of(clear_depth(d));
            if (got != expected && !may_be_clear) {
                if (tell(at)) {
                    printf("%s: attachment %u word %u: expected 0x%08x, got 0x%08x\n", d->name,
                           plane, k, expected, got);
                }
                return;
            }
        }
    }
}

int main(int argc, char** argv) {
    uint32_t run, left, k, at = 0;
    choose_device(argc > 1 ? argv[1] : "");
    check_limits();
    make_device();
    submit(VK_FALSE);
    submit(VK_TRUE);
    printf("%s\non %s, %s\n", kCase, properties.deviceName, kProfile);
    for (run = 0; run < sizeof kExpected / sizeof kExpected[0]; ++run) {
        for (left = kExpected[run].samples; left > 0; --left, ++at) {
            judge_sample(at, &kExpected[run]);
        }
    }
    for (k = 1; k < DRAWINGS; ++k) {
        for (at = 0; at < WIDTH * HEIGHT * LAYERS * SAMPLES; ++at) {
            compare_sample(&kDrawings[k], at);
        }
    }
    if (wrong > MOST_LINES) {
        printf("... and %u more\n", wrong - MOST_LINES);
    }
    printf("%u of %d samples are wrong\n", wrong,
           WIDTH * HEIGHT * LAYERS * SAMPLES);
    return wrong > 0;
}
