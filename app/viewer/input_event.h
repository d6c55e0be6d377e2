// What a person does to the window, as data: the window's callbacks and scripts make the same events.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace anvil {

enum class MouseButton : uint8_t { left, right, middle };

/// Held while an event happened.
struct Modifiers {
    bool shift = false;
    bool control = false;
    bool alt = false;

    bool operator==(const Modifiers&) const = default;
};

struct InputEvent {
    enum class Kind : uint8_t { move, press, release, scroll, key_down, key_up, text, drop, close };

    Kind kind = Kind::move;
    double x = 0; ///< move: pixels from the window's left and top; scroll: x and y steps
    double y = 0;
    MouseButton button = MouseButton::left; ///< press, release
    int key = 0;                            ///< key_down (repeats too), key_up: GLFW's number of the key
    Modifiers modifiers;                    ///< all but text, drop and close
    uint32_t character = 0;                 ///< text: a Unicode code point
    std::vector<std::string> files;         ///< drop
};

} // namespace anvil
