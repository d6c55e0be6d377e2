// A number that is typed in mid-drag.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace anvil {

class TypedNumber {
  public:
    /// Digits and the point are added; a minus changes the sign wherever it is typed. Whether it was one.
    bool type(uint32_t character);
    void erase_last();

    /// Nothing as long as the text is no number.
    std::optional<double> value() const;
    const std::string& text() const { return text_; }
    bool empty() const { return text_.empty(); }

  private:
    std::string text_;
};

} // namespace anvil
