// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The last part of every reproducer: compares what was drawn with what is right.
static const void* planes[PLANES];

static float number(uint32_t plane, uint32_t at, uint32_t k) {
    return ((const float*)planes[plane])[words_of(plane) * at + k];
}

// Depth as a number; codes of a UNORM format as the binary32 nearest to code / DEPTH_STEPS.
static float depth_at(uint32_t at) {
    const void* plane = planes[PLANES - 1];
    double code;
    if (DEPTH_STEPS == 0) {
        return ((const float*)plane)[at];
    }
    if (SAMPLES > 1) {  // a shader's conversion is off by far less than a step
        const float read = ((const float*)plane)[at];
        const double scaled = (double)read * DEPTH_STEPS;
        if (!(scaled >= 0 && scaled <= DEPTH_STEPS)) {
            return read;
        }
        code = (uint32_t)(scaled + 0.5);
        if (scaled - code > 0.25 || code - scaled > 0.25) {
            return read;
        }
    } else {
        code = DEPTH_STEPS > 65535 ? ((const uint32_t*)plane)[at] & 0xffffffU
                                   : ((const uint16_t*)plane)[at];
    }
    return (float)(code / (DEPTH_STEPS > 0 ? DEPTH_STEPS : 1));
}

static int is_within(const struct Range* r, float got) {
    return r->low > r->high || (got >= r->low && got <= r->high);
}

static int is_clear_depth(float depth) {
    return depth == DEPTH_CLEAR_LOW || depth == DEPTH_CLEAR_HIGH;
}

// Lines beyond MOST_LINES are counted, not printed.
static uint32_t wrong;
static int tell(uint32_t at) {
    if (++wrong > MOST_LINES) {
        return 0;
    }
    printf("pixel (%u, %u) sample %u: ", at / SAMPLES % WIDTH, at / SAMPLES / WIDTH, at % SAMPLES);
    return 1;
}

static void tell_value(uint32_t at, const char* name, double low, double high, float got) {
    if (tell(at)) {
        printf("%s: expected %.9g to %.9g, got %.9g\n", name, low, high, (double)got);
    }
}

static int are_allowed(const struct Bounds* b, double front, double back) {
    return front >= b->front_min && front <= b->front_max && back >= b->back_min &&
           back <= b->back_max && front - back >= b->signed_min && front - back <= b->signed_max &&
           front + back >= b->total_min && front + back <= b->total_max &&
           front == (double)(uint32_t)front && back == (double)(uint32_t)back;
}

// Tells the first value of a fragment that is wrong for its writer; 1 if all are right.
static int judge_values(uint32_t at, const struct Writer* w, int is_told) {
    static const char* const kComponents[4] = {"x", "y", "z", "w"};
    const struct Range* r = &kRanges[w->ranges];
    const float x = (float)(at / SAMPLES % WIDTH) + 0.5F, y = (float)(at / SAMPLES / WIDTH) + 0.5F;
    char name[32];
    uint32_t k;
    for (k = 0; k < 4 + HAS_DEPTH + 4 * kDraws[w->draw].attributes; ++k) {
        struct Range range = {0, 0};
        int is_flat = 0;
        float got;
        if (k < 2) {
            range.low = range.high = k == 0 ? x : y;
            got = number(FRAG_XY, at, k);
            sprintf(name, "FragCoord.%s", kComponents[k]);
        } else if (k < 4) {
            range = r[k - 2];
            got = number(FRAG_ZW, at, k - 2);
            sprintf(name, "FragCoord.%s", kComponents[k]);
        } else if (k < 4 + HAS_DEPTH) {
            if (!kDraws[w->draw].depth_write) {
                continue;
            }
            range = r[2];
            got = depth_at(at);
            sprintf(name, "depth");
        } else {
            const uint32_t n = k - 4 - HAS_DEPTH;
            range = r[3 + n];
            is_flat = kDraws[w->draw].flat >> n / 4 & 1;
            got = number(FIRST_ATTRIBUTE + n / 4, at, n % 4);
            sprintf(name, "attribute %u.%s", n / 4, kComponents[n % 4]);
        }
        if (!is_within(&range, got) ||
            (is_flat && range.low == range.high && memcmp(&range.low, &got, sizeof got) != 0)) {
            if (is_told) {
                tell_value(at, name, (double)range.low, (double)range.high, got);
            }
            return 0;
        }
    }
    return 1;
}

// Depth where the last writer does not write it.
static void judge_older_depth(uint32_t at, const struct Expected* e) {
    const float got = depth_at(at);
    uint32_t k;
    if (e->depth_may_be_clear && is_clear_depth(got)) {
        return;
    }
    for (k = 0; k < e->depths; ++k) {
        if (is_within(&kRanges[e->first_depth + k], got)) {
            return;
        }
    }
    if (e->depths > 0) {
        tell_value(at, "depth", (double)kRanges[e->first_depth].low,
                   (double)kRanges[e->first_depth].high, got);
    } else {
        tell_value(at, "depth", (double)DEPTH_CLEAR_LOW, (double)DEPTH_CLEAR_HIGH, got);
    }
}

static void judge_fragment(uint32_t at, const struct Expected* e) {
    const struct Writer* named = NULL;
    uint32_t k;
    for (k = 0; k < e->writers; ++k) {
        const struct Writer* w = &kWriters[e->first_writer + k];
        if (number(WRITER, at, 0) == (float)w->draw &&
            number(WRITER, at, 1) == (float)w->provoking_vertex) {
            named = w;
            if (judge_values(at, w, 0)) {
                break;
            }
        }
    }
    if (named == NULL) {
        if (tell(at)) {
            printf("last triangle: expected draw %u vertex %u%s, got draw %g vertex %g\n",
                   kWriters[e->first_writer].draw, kWriters[e->first_writer].provoking_vertex,
                   e->writers > 1 ? " (or others)" : "", (double)number(WRITER, at, 0),
                   (double)number(WRITER, at, 1));
        }
    } else if (k == e->writers) {
        judge_values(at, named, 1);
    } else if (HAS_DEPTH && !kDraws[named->draw].depth_write) {
        judge_older_depth(at, e);
    }
}

static void judge_sample(uint32_t at, const struct Expected* e) {
    const struct Bounds* b = &kBounds[e->bounds];
    const double front = (double)number(HITS, at, 0) - (double)NO_HITS;
    const double back = (double)number(HITS, at, 1) - (double)NO_HITS;
    if (!are_allowed(b, front, back)) {
        if (tell(at)) {
            printf(
                "hits: expected %u to %u (front %u to %u, back %u to %u, difference %d to %d), "
                "got %g front, %g back\n",
                b->total_min, b->total_max, b->front_min, b->front_max, b->back_min, b->back_max,
                b->signed_min, b->signed_max, front, back);
        }
    } else if (front + back > 0) {
        judge_fragment(at, e);
    } else if (number(WRITER, at, 0) != -1.0F || (HAS_DEPTH && !is_clear_depth(depth_at(at)))) {
        if (tell(at)) {
            printf("no hit, but something was written\n");
        }
    }
}

int main(int argc, char** argv) {
    uint32_t run, left, at = 0;
    choose_device(argc > 1 ? argv[1] : "");
    check_limits();
    make_device();
    draw(planes);
    printf("%s\non %s, %s\n", kCase, properties.deviceName, kProfile);
    for (run = 0; run < sizeof kExpected / sizeof kExpected[0]; ++run) {
        for (left = kExpected[run].samples; left > 0; --left, ++at) {
            judge_sample(at, &kExpected[run]);
        }
    }
    if (wrong > MOST_LINES) {
        printf("... and %u more\n", wrong - MOST_LINES);
    }
    printf("%u of %u samples are wrong\n", wrong, at);
    return wrong > 0;
}
