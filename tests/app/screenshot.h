// Pictures that the program wrote, by their pixels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace anvil {

struct Screenshot {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgb;

    /// How far the pixel's colour is from this one: the largest difference of red, green and blue.
    int off(int x, int y, int red, int green, int blue) const;
    /// How many pixels are no farther than `most` from a colour.
    size_t count(int red, int green, int blue, int most) const;
};

/// A test failure if the file is none.
Screenshot read_screenshot(const std::string& file);

/// Pixels of the first `rows` that differ by more than `least` in one colour, by column from the left.
std::vector<size_t> changed_by_column(const Screenshot& a, const Screenshot& b, int rows, int least);

} // namespace anvil
