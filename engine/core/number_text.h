// Numbers as text, the same in every locale.
#pragma once

#include <charconv>
#include <string>

namespace anvil {

/// Shortest decimal that reads back as the same double; at most 17 significant digits.
inline std::string number_text(double x) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, x).ptr;
    return {buffer, end};
}

/// For messages: 6 significant digits.
inline std::string rounded_text(double x) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, 6).ptr;
    return {buffer, end};
}

/// For columns of numbers: appends 17 significant digits, which read back as the same double; "inf", "-inf".
inline void append_17_digits(std::string& text, double x) {
    char buffer[40];
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, 17).ptr);
}

} // namespace anvil
