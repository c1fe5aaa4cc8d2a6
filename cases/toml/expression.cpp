// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/toml/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/select/selector.hpp"

namespace cases {

namespace {

constexpr long kMaxExponent = 4096;
constexpr size_t kMaxBits = 16384;   // of a numerator or denominator
constexpr size_t kMaxLength = 1024;  // characters of an expression
constexpr int kMaxNesting = 64;      // parentheses and signs

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_name_start(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
int hex_digit(char c) {
    if (is_digit(c)) {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

mpq_class power(const mpq_class& base, long exponent) {
    const auto magnitude = static_cast<unsigned long>(std::labs(exponent));
    mpz_class num;
    mpz_class den;
    mpz_pow_ui(num.get_mpz_t(), base.get_num_mpz_t(), magnitude);
    mpz_pow_ui(den.get_mpz_t(), base.get_den_mpz_t(), magnitude);
    mpq_class result = exponent >= 0 ? mpq_class(num, den) : mpq_class(den, num);
    result.canonicalize();
    return result;
}

struct SyntaxError {
    std::string message;
};

class Parser {
  public:
    Parser(std::string_view text, const Names& names) : text_(text), names_(names) {}

    Number parse() {
        Number n = sum();
        skip_blanks();
        if (at_ < text_.size()) {
            fail(fmt::format("{} stands where an operator or the end is expected", here()));
        }
        return n;
    }

  private:
    [[noreturn]] static void fail(std::string message) { throw SyntaxError{std::move(message)}; }

    std::string here() const {
        if (at_ >= text_.size()) {
            return "the end";
        }
        const auto c = static_cast<unsigned char>(text_[at_]);
        if (c < 0x20 || c >= 0x7f) {
            return fmt::format("the byte 0x{:02x}", c);
        }
        return fmt::format("'{}'", text_[at_]);
    }
    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) {
            ++at_;
        }
    }
    bool take(char c) {
        skip_blanks();
        if (at_ < text_.size() && text_[at_] == c) {
            ++at_;
            return true;
        }
        return false;
    }
    static Number checked(mpq_class value) {
        if (mpz_sizeinbase(value.get_num_mpz_t(), 2) > kMaxBits ||
            mpz_sizeinbase(value.get_den_mpz_t(), 2) > kMaxBits) {
            fail(fmt::format("it needs more than {} bits", kMaxBits));
        }
        return {std::move(value), false};
    }

    Number sum() {
        if (++nesting_ > kMaxNesting) {
            fail(fmt::format("it nests deeper than {} levels", kMaxNesting));
        }
        Number left = product();
        while (true) {
            if (take('+')) {
                left = checked(left.value + product().value);
            } else if (take('-')) {
                left = checked(left.value - product().value);
            } else {
                --nesting_;
                return left;
            }
        }
    }

    Number product() {
        Number left = unary();
        while (true) {
            if (take('*')) {
                left = checked(left.value * unary().value);
            } else if (take('/')) {
                const Number right = unary();
                if (right.value == 0) {
                    fail("it divides by zero");
                }
                left = checked(left.value / right.value);
            } else {
                return left;
            }
        }
    }

    Number unary() {
        if (!take('-')) {
            return raised();
        }
        if (++nesting_ > kMaxNesting) {
            fail(fmt::format("it nests deeper than {} levels", kMaxNesting));
        }
        const Number n = unary();
        --nesting_;
        return {-n.value, n.value == 0 && !n.negative_zero};
    }

    Number raised() {
        Number base = atom();
        if (!take('^')) {
            return base;
        }
        const bool negative = take('-');
        const mpq_class exponent = atom().value;
        if (exponent.get_den() != 1 || abs(exponent) > kMaxExponent) {
            fail(fmt::format("an exponent is an integer of at most {}", kMaxExponent));
        }
        const long e = negative ? -exponent.get_num().get_si() : exponent.get_num().get_si();
        if (base.value == 0 && e < 0) {
            fail("it divides by zero");
        }
        const size_t bits = std::max(mpz_sizeinbase(base.value.get_num_mpz_t(), 2),
                                     mpz_sizeinbase(base.value.get_den_mpz_t(), 2));
        if (bits * static_cast<size_t>(std::labs(e)) > 2 * kMaxBits) {
            fail(fmt::format("it needs more than {} bits", kMaxBits));
        }
        return checked(power(base.value, e));
    }

    Number atom() {
        if (take('(')) {
            Number n = sum();
            if (!take(')')) {
                fail(fmt::format("{} stands where ')' is expected", here()));
            }
            return n;
        }
        skip_blanks();
        if (at_ < text_.size() && is_name_start(text_[at_])) {
            return name();
        }
        if (text_.substr(at_, 2) == "0x" || text_.substr(at_, 2) == "0X") {
            return hexadecimal();
        }
        if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) {
            return decimal();
        }
        fail(fmt::format("{} stands where a number is expected", here()));
    }

    Number name() {
        const size_t start = at_;
        while (at_ < text_.size() && (is_name_start(text_[at_]) || is_digit(text_[at_]))) {
            ++at_;
        }
        const std::string_view word = text_.substr(start, at_ - start);
        if (const std::optional<Number> n = names_.find ? names_.find(word) : std::nullopt) {
            return *n;
        }
        if (word == "inf" || word == "nan") {
            fail(fmt::format("{} is no number here", word));
        }
        if (const std::string why = names_.why ? names_.why(word) : ""; !why.empty()) {
            fail(why);
        }
        const std::string nearest = nearest_name(word, names_.known);
        if (!nearest.empty()) {
            fail(fmt::format("the name {} is unknown; did you mean {}?", word, nearest));
        }
        fail(fmt::format("the name {} is unknown; names are the keys of [matrix]", word));
    }

    // Digits of one base; advances past them and counts those after the point.
    template <class DigitOf>
    void digits(int base, DigitOf digit_of, mpz_class& value, long& fraction_digits) {
        bool any = false;
        bool after_point = false;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '.' && !after_point) {
                after_point = true;
                continue;
            }
            const int d = digit_of(text_[at_]);
            if (d < 0) {
                break;
            }
            value = value * base + d;
            fraction_digits += after_point ? 1 : 0;
            any = true;
        }
        if (!any) {
            fail(fmt::format("{} stands where a digit is expected", here()));
        }
    }

    // An optional sign and decimal digits, after "e" or "p".
    long exponent() {
        bool negative = false;
        if (at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-')) {
            negative = text_[at_++] == '-';
        }
        if (at_ >= text_.size() || !is_digit(text_[at_])) {
            fail(fmt::format("{} stands where an exponent is expected", here()));
        }
        long e = 0;
        for (; at_ < text_.size() && is_digit(text_[at_]); ++at_) {
            e = e * 10 + (text_[at_] - '0');
            if (e > kMaxExponent) {
                fail(fmt::format("an exponent is an integer of at most {}", kMaxExponent));
            }
        }
        return negative ? -e : e;
    }

    Number hexadecimal() {
        at_ += 2;
        mpz_class value;
        long fraction_digits = 0;
        digits(16, hex_digit, value, fraction_digits);
        long e = -4 * fraction_digits;
        if (at_ < text_.size() && (text_[at_] == 'p' || text_[at_] == 'P')) {
            ++at_;
            e += exponent();
        }
        end_of_number();
        return checked(value * power(2, e));
    }

    Number decimal() {
        mpz_class value;
        long fraction_digits = 0;
        digits(
            10, [](char c) { return is_digit(c) ? c - '0' : -1; }, value, fraction_digits);
        long e = -fraction_digits;
        if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
            ++at_;
            e += exponent();
        }
        Number n = checked(value * power(10, e));
        if (at_ < text_.size() && text_[at_] == 'f') {
            ++at_;
            const Rounded rounded = round_to_binary32(n.value);
            if (std::isinf(rounded.value)) {
                fail("a number with f is larger than the largest binary32");
            }
            n.value = exact(static_cast<double>(rounded.value));
        }
        end_of_number();
        return n;
    }

    void end_of_number() {
        if (at_ < text_.size() &&
            (is_name_start(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.')) {
            fail(fmt::format("{} stands where an operator or the end is expected", here()));
        }
    }

    std::string_view text_;
    const Names& names_;
    size_t at_ = 0;
    int nesting_ = 0;
};

}  // namespace

tl::expected<Number, std::string> evaluate(std::string_view text, const Names& names) {
    if (text.size() > kMaxLength) {
        return tl::unexpected(
            fmt::format("an expression of {} characters is too long; at most {} are read",
                        text.size(), kMaxLength));
    }
    try {
        return Parser(text, names).parse();
    } catch (const SyntaxError& error) {
        return tl::unexpected(fmt::format("\"{}\" is not a number: {}", text, error.message));
    }
}

}  // namespace cases
