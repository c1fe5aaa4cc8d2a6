// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/blit/blit_operations.hpp"

#include <gtest/gtest.h>

namespace ref {
namespace {

Picture filled(int64_t width, int64_t height, const Rgba& value) {
    return {width, height, std::vector<Rgba>(static_cast<size_t>(width * height), value)};
}

// Every texel another number, alphas 0, 1/4, 1/2, 3/4, 1 in turn.
Picture numbered(int64_t width, int64_t height) {
    Picture p = filled(width, height, {});
    for (size_t k = 0; k < p.texels.size(); ++k) {
        const mpq_class n(static_cast<unsigned long>(k + 1), p.texels.size() + 1);
        p.texels[k] = {n, n * n, 1 - n, mpq_class(static_cast<unsigned long>(k % 5), 4UL)};
        for (mpq_class& v : p.texels[k]) {
            v.canonicalize();
        }
    }
    return p;
}

const Rgba kGrey = {mpq_class(1, 2), mpq_class(1, 2), mpq_class(1, 2), mpq_class(1)};

}  // namespace

TEST(BlitOperations, ClippingEqualsTestingEveryTexel) {
    const Picture source = numbered(3, 4);
    for (int64_t y = -5; y <= 7; ++y) {
        for (int64_t x = -4; x <= 7; ++x) {
            Picture clipped = filled(5, 6, kGrey);
            copy_blit(source, clipped, x, y);
            for (int64_t j = 0; j < 6; ++j) {
                for (int64_t i = 0; i < 5; ++i) {
                    const bool inside =
                        i >= x && i < x + source.width && j >= y && j < y + source.height;
                    EXPECT_EQ(clipped.at(i, j), inside ? source.at(i - x, j - y) : kGrey)
                        << x << "," << y << " at " << i << "," << j;
                }
            }
        }
    }
}

TEST(BlitOperations, AMaskCopiesWhatIsAboveTheThreshold) {
    const Picture source = numbered(5, 1);  // alphas 0, 1/4, 1/2, 3/4, 1
    for (const auto& [threshold, copied] :
         {std::pair(mpq_class(0), 4), std::pair(mpq_class(1, 2), 2), std::pair(mpq_class(1), 0)}) {
        Picture destination = filled(5, 1, kGrey);
        masked_blit(source, destination, 0, 0, threshold);
        int count = 0;
        for (int64_t i = 0; i < 5; ++i) {
            const bool is_copied = source.at(i, 0)[3] > threshold;
            EXPECT_EQ(destination.at(i, 0), is_copied ? source.at(i, 0) : kGrey);
            count += is_copied ? 1 : 0;
        }
        EXPECT_EQ(count, copied);
    }
}

TEST(BlitOperations, BlendingByHand) {
    Picture source = filled(1, 1, {mpq_class(1), mpq_class(0), mpq_class(1, 3), mpq_class(1, 4)});
    Picture destination = filled(1, 1, kGrey);
    blended_blit(source, destination, 0, 0);
    // 1/4 * 1 + 3/4 * 1/2, 1/4 * 0 + 3/4 * 1/2, 1/4 * 1/3 + 3/4 * 1/2, 1/4 + 3/4 * 1
    EXPECT_EQ(destination.at(0, 0),
              (Rgba{mpq_class(5, 8), mpq_class(3, 8), mpq_class(11, 24), mpq_class(1)}));
}

TEST(BlitOperations, OpaqueBlendsCopyAndTransparentOnesDoNothing) {
    Picture source = numbered(4, 4);
    for (Rgba& texel : source.texels) {
        texel[3] = texel[3] >= mpq_class(1, 2) ? 1 : 0;
    }
    Picture blended = numbered(4, 4);
    Picture masked = blended;
    for (Picture* picture : {&blended, &masked}) {
        for (Rgba& texel : picture->texels) {
            texel[3] = 1;
        }
    }
    blended_blit(source, blended, 1, -1);
    masked_blit(source, masked, 1, -1, 0);
    EXPECT_EQ(blended, masked);
    EXPECT_NE(blended, numbered(4, 4));
}

}  // namespace ref
