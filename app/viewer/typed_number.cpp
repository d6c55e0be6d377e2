#include "app/viewer/typed_number.h"

#include <charconv>
#include <cmath>

namespace anvil {

namespace {

constexpr size_t most_characters = 24;

} // namespace

bool TypedNumber::type(uint32_t character) {
    const bool digit = character >= '0' && character <= '9';
    if (!digit && character != '.' && character != '-') {
        return false;
    }
    if (character == '-') {
        text_ = text_.starts_with('-') ? text_.substr(1) : "-" + text_;
    } else if (text_.size() < most_characters) {
        text_ += static_cast<char>(character);
    }
    return true;
}

void TypedNumber::erase_last() {
    if (!text_.empty()) {
        text_.pop_back();
    }
}

std::optional<double> TypedNumber::value() const {
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    return error == std::errc() && end == text_.data() + text_.size() && std::isfinite(value)
               ? std::optional(value)
               : std::nullopt;
}

} // namespace anvil
