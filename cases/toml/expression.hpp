// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers as text: exact rational arithmetic over decimals, hexadecimal floats, powers and names.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "cases/toml/binary32.hpp"

namespace cases {

// The names that an expression may use. `find` returns nothing for an unknown name.
struct Names {
    std::function<std::optional<Number>(std::string_view)> find;
    std::vector<std::string> known;  // for "did you mean"
    // Why a known name has no number; "" for an unknown one.
    std::function<std::string(std::string_view)> why = {};
};

// The exact value of an expression:
//   sum     := product (("+" | "-") product)*
//   product := unary (("*" | "/") unary)*
//   unary   := "-" unary | power
//   power   := atom ("^" ["-"] atom)?           the exponent is an integer, |exponent| <= 4096
//   atom    := decimal ["f"] | hexadecimal float | name | "(" sum ")"
// A decimal is read exactly; with "f" it is its nearest binary32. Errors are one sentence that
// quotes the expression: syntax, unknown name, division by zero, a result of more than 16384 bits.
tl::expected<Number, std::string> evaluate(std::string_view text, const Names& names);

}  // namespace cases
