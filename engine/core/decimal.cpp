#include "engine/core/decimal.h"

#include <limits>
#include <string_view>

namespace anvil {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Whether |number| is above 1, for numbers so large or small that it is all that matters.
bool above_one(std::string_view text) {
    const size_t mark = text.find_first_of("eE");
    long long exponent = 0;
    if (mark != std::string_view::npos) {
        const bool negative = text[mark + 1] == '-';
        const char* digits = text.data() + mark + (is_digit(text[mark + 1]) ? 1 : 2);
        const std::from_chars_result result = std::from_chars(digits, text.data() + text.size(), exponent);
        if (result.ec != std::errc()) {
            return !negative;
        }
        exponent = negative ? -exponent : exponent;
        text = text.substr(0, mark);
    }
    const auto point = static_cast<long long>(std::min(text.find('.'), text.size()));
    const auto leading = static_cast<long long>(std::min(text.find_first_of("123456789"), text.size()));
    return point - leading + exponent > 0;
}

} // namespace

const char* parse_number(const char* begin, const char* end, double& value) {
    const bool plus = end - begin > 1 && *begin == '+' && begin[1] != '-' && begin[1] != '+';
    const char* start = plus ? begin + 1 : begin;
    const std::from_chars_result result = std::from_chars(start, end, value);
    if (result.ec == std::errc()) {
        return result.ptr;
    }
    if (result.ec != std::errc::result_out_of_range) {
        return begin;
    }
    const std::string_view text(start, static_cast<size_t>(result.ptr - start));
    value = above_one(text) ? std::numeric_limits<double>::infinity() : 0.0;
    value = *start == '-' ? -value : value;
    return result.ptr;
}

} // namespace anvil
