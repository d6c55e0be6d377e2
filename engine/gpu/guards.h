// Known bytes behind a kernel's output: what no kernel may touch. Internal to engine/gpu.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace anvil {

inline constexpr std::byte guard_byte{0xA5};

inline std::vector<std::byte> make_guards(size_t bytes) {
    return std::vector<std::byte>(bytes, guard_byte);
}

inline bool guards_intact(std::span<const std::byte> bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == guard_byte; });
}

} // namespace anvil
