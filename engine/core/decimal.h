// Numbers as text, the same in every locale.
#pragma once

#include <charconv>
#include <string>

namespace anvil {

/// Appends the shortest decimal that reads back as exactly this number.
template <typename Number>
void append_number(std::string& text, Number value) {
    char buffer[32];
    const std::to_chars_result result = std::to_chars(buffer, buffer + sizeof buffer, value);
    text.append(buffer, result.ptr);
}

/// Reads a decimal number at `begin`; a leading + is allowed. Beyond the range of double: 0 or infinity.
/// @return where it ends; `begin` if there is none.
const char* parse_number(const char* begin, const char* end, double& value);

} // namespace anvil
