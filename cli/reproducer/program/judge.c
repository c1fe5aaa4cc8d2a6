// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The seventh part of every reproducer: compares what was drawn with what is right.
static float number(uint32_t plane, uint32_t at, uint32_t k) {
    const uint32_t numbers = bytes_of(role_of(kDrawings, plane)) / 4;
    return ((const float*)drawn[0][plane])[numbers * at + k];
}

// Depth as a number; codes of a UNORM format as the binary32 nearest to code / DEPTH_STEPS.
static float depth_of(const struct Drawing* d, uint32_t at) {
    const void* plane = drawn[d - kDrawings][depth_plane(d)];
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

static float depth_at(uint32_t at) {
    return depth_of(kDrawings, at);
}

static int is_within(const struct Range* r, float got) {
    return r->low > r->high || (got >= r->low && got <= r->high);
}

static int is_clear_depth(float depth) {
    return depth == DEPTH_CLEAR_LOW || depth == DEPTH_CLEAR_HIGH;
}

// A sample counts once, by what is told of it first. Lines beyond MOST_LINES are not printed.
static uint8_t is_wrong[WIDTH * HEIGHT * LAYERS * SAMPLES];
static uint32_t wrong;
static int tell(uint32_t at) {
    if (is_wrong[at]) {
        return 0;
    }
    is_wrong[at] = 1;
    if (++wrong > MOST_LINES) {
        return 0;
    }
    if (LAYERS > 1) {
        printf("layer %u ", at / SAMPLES / WIDTH / HEIGHT);
    }
    printf("pixel (%u, %u) sample %u: ", at / SAMPLES % WIDTH, at / SAMPLES / WIDTH % HEIGHT,
           at % SAMPLES);
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

// Whether a place in the pixel is one of those that are right at the sample.
static int is_place(uint32_t places, uint32_t sample, float x, float y) {
    uint32_t k;
    if ((places & AT_CENTRE) && x == 0.5F && y == 0.5F) {
        return 1;
    }
    for (k = 0; k < SAMPLES; ++k) {
        if (((places & AT_ANY_SAMPLE) || ((places & AT_OWN_SAMPLE) && k == sample)) &&
            x == (float)kPlaces[k][0] / 16 && y == (float)kPlaces[k][1] / 16) {
            return 1;
        }
    }
    return 0;
}

static int is_whole(float v) {
    return v >= 0 && v < 65536.0F && v == (float)(uint32_t)v;
}

// Of gl_SampleID, gl_SamplePosition and gl_SampleMaskIn. `mask`: the least and the most of it.
static int is_right_kind(const struct Draw* d, uint32_t attribute, uint32_t at,
                         const struct Range* mask) {
    const float x = number(FIRST_ATTRIBUTE + attribute, at, 0);
    const float y = number(FIRST_ATTRIBUTE + attribute, at, 1);
    const uint32_t sample = at % SAMPLES, own = d->own_only >> attribute & 1;
    uint32_t bits;
    switch (d->kinds[attribute]) {
        case SAMPLE_ID:
            return is_whole(x) && (own ? x == (float)sample : x < SAMPLES);
        case SAMPLE_POSITION:
            return is_place(own ? AT_OWN_SAMPLE : AT_ANY_SAMPLE, sample, x, y);
        default:
            bits = is_whole(x) ? (uint32_t)x : 0;
            return (bits >> sample & 1) && (bits & (uint32_t)mask->low) == (uint32_t)mask->low &&
                   (bits & ~(uint32_t)mask->high) == 0;
    }
}

static void tell_other(uint32_t at, const char* what, float x, float y) {
    if (tell(at)) {
        printf("%s: got %.9g, %.9g\n", what, (double)x, (double)y);
    }
}

// A level of detail may be off by the device's precision of levels: `component` 1 once; 0, which is
// clamped to the texture's levels, before that and after it.
static struct Range level_range(const struct Draw* d, struct Range range, uint32_t component) {
    const float slack = ldexpf(component == 1 ? 1 : 2, -(int)properties.limits.mipmapPrecisionBits);
    uint32_t levels = 1;
    float most;
    while ((d->texture[0] | d->texture[1]) >> levels != 0) {
        ++levels;
    }
    most = (float)(levels - 1);
    if (component > 1 || range.low > range.high) {
        return range;
    }
    if (component == 0) {
        most = range.high > most ? range.high : most;
        range.low = range.low > slack ? range.low - slack : 0;
        range.high = range.high + slack < most ? range.high + slack : most;
    } else {
        range.low -= slack;
        range.high += slack;
    }
    return range;
}

// Tells the first value of a fragment that is wrong for its writer; 1 if all are right.
static int judge_values(uint32_t at, const struct Writer* w, int is_told) {
    static const char* const kComponents[4] = {"x", "y", "z", "w"};
    const struct Range* r = &kRanges[w->ranges];
    const struct Draw* d = &kDraws[w->draw];
    const float x = (float)(at / SAMPLES % WIDTH), y = (float)(at / SAMPLES / WIDTH % HEIGHT);
    char name[32];
    uint32_t k;
    if (!is_place(d->places, at % SAMPLES, number(FRAG_XY, at, 0) - x,
                  number(FRAG_XY, at, 1) - y)) {
        if (is_told) {
            tell_other(at,
                       d->places == AT_CENTRE ? "FragCoord.xy: expected the pixel's centre"
                                              : "FragCoord.xy: expected a sample of the fragment",
                       number(FRAG_XY, at, 0), number(FRAG_XY, at, 1));
        }
        return 0;
    }
    for (k = 2; k < 4 + HAS_DEPTH + 4 * d->attributes; ++k) {
        struct Range range = {0, 0};
        int is_flat = 0;
        float got;
        if (k < 4) {
            range = r[k - 2];
            got = number(FRAG_ZW, at, k - 2);
            if (k == 2 && d->has_bias && is_within(&r[3], got)) {
                continue;
            }
            sprintf(name, "FragCoord.%s%s", kComponents[k],
                    k == 2 && d->has_bias ? " without bias" : "");
        } else if (k < 4 + HAS_DEPTH) {
            if (!d->depth_write) {
                continue;
            }
            range = r[2];
            got = depth_at(at);
            sprintf(name, "depth");
        } else {
            const uint32_t n = k - 4 - HAS_DEPTH;
            range = r[3 + d->has_bias + n];
            is_flat = d->flat >> n / 4 & 1;
            got = number(FIRST_ATTRIBUTE + n / 4, at, n % 4);
            sprintf(name, "attribute %u.%s", n / 4, kComponents[n % 4]);
            if (d->kinds[n / 4] == LEVEL) {
                range = level_range(d, range, n % 4);
            } else if (d->kinds[n / 4] != INPUT) {
                if (n % 4 == 0 && !is_right_kind(d, n / 4, at, &range)) {
                    if (is_told) {
                        tell_other(at,
                                   d->kinds[n / 4] == SAMPLE_ID         ? "gl_SampleID"
                                   : d->kinds[n / 4] == SAMPLE_POSITION ? "gl_SamplePosition"
                                                                        : "gl_SampleMaskIn",
                                   got, number(FIRST_ATTRIBUTE + n / 4, at, 1));
                    }
                    return 0;
                }
                continue;
            }
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

// Every set of fragments that may be there, as far as the instruments tell which it was, leaves a
// colour.
static void judge_color(uint32_t at, const struct Expected* e, uint32_t hits) {
    const void* plane = drawn[0][color_plane(kDrawings)];
    const struct Color* first = NULL;
    uint32_t k;
    for (k = 0; k < e->colors; ++k) {
        const struct Color* c = &kColors[e->first_color + k];
        float captured[4] = {0, 0, 0, 0};
        int has_captured = HAS_INSTRUMENTS && c->captured > 0;
        uint32_t n;
        if (HAS_INSTRUMENTS &&
            (c->hits != hits ||
             (hits > 0 && (number(WRITER, at, 0) != (float)c->draw ||
                           number(WRITER, at, 1) != (float)c->provoking_vertex)))) {
            continue;
        }
        for (n = 0; n < 4 && has_captured; ++n) {
            captured[n] = number(FIRST_ATTRIBUTE + c->captured - 1, at, n);
            has_captured = captured[n] - captured[n] == 0;  // neither NaN nor infinity
        }
        if (is_right_color(c, plane, at, has_captured ? captured : NULL)) {
            return;
        }
        first = first != NULL ? first : c;
    }
    if (first != NULL && tell(at)) {
        print_color(first, plane, at);
    }
}

// "1", or "0 to 2".
static void print_range(const char* name, unsigned low, unsigned high) {
    printf("%s%u", name, low);
    if (high != low) {
        printf(" to %u", high);
    }
}

static void judge_instruments(uint32_t at, const struct Expected* e) {
    const struct Bounds* b = &kBounds[e->bounds];
    const double front = (double)number(HITS, at, 0) - (double)NO_HITS;
    const double back = (double)number(HITS, at, 1) - (double)NO_HITS;
    if (!are_allowed(b, front, back)) {
        if (tell(at)) {
            print_range("hits: expected ", b->total_min, b->total_max);
            print_range(" (front ", b->front_min, b->front_max);
            print_range(", back ", b->back_min, b->back_max);
            if (b->front_min != b->front_max || b->back_min != b->back_max) {
                printf(", difference %d to %d", b->signed_min, b->signed_max);
            }
            printf("), got %g front, %g back\n", front, back);
        }
        return;
    }
    if (front + back > 0) {
        judge_fragment(at, e);
    } else if (number(WRITER, at, 0) != -1.0F || (HAS_DEPTH && !is_clear_depth(depth_at(at)))) {
        if (tell(at)) {
            printf("no hit, but something was written\n");
        }
    }
    if (HAS_COLOR) {
        judge_color(at, e, (uint32_t)(front + back));
    }
}

static void judge_sample(uint32_t at, const struct Expected* e) {
    if (HAS_INSTRUMENTS) {
        judge_instruments(at, e);
        return;
    }
    judge_color(at, e, 0);
    if (HAS_DEPTH) {
        judge_older_depth(at, e);
    }
}
