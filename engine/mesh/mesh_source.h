// What the readers of the four formats share (internal to engine/mesh).
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/mesh.h"

#include <string>
#include <string_view>

namespace anvil {

/// A mesh file in memory, and how to complain about it.
struct MeshSource {
    std::string name;
    std::string_view text;
    Log& log;

    [[noreturn]] void fail(const std::string& cause, const std::string& mend) const;
    [[noreturn]] void fail_at_line(size_t line, const std::string& cause, const std::string& mend) const;
    [[noreturn]] void fail_at_byte(size_t byte, const std::string& cause, const std::string& mend) const;
    void warn(const std::string& message) const { log.warn(name + ": " + message); }
};

Mesh read_obj(const MeshSource& source);
Mesh read_ply(const MeshSource& source);
Mesh read_stl(const MeshSource& source);
Mesh read_off(const MeshSource& source);

/// Coordinates up to this size are accepted: beyond, single precision is near its end (3.4e38).
inline constexpr double largest_accepted_coordinate = 1e36;

/// Counts things that are left out and remembers where the first one was (a line or a byte).
struct Skipped {
    size_t count = 0;
    size_t first = 0;

    void add(size_t place) {
        if (count++ == 0) {
            first = place;
        }
    }
    /// Warns "MESSAGE_AFTER_COUNT (first: line 7)" if anything was counted.
    void report(const MeshSource& source, const std::string& what, const char* unit = "line") const;
};

/// The largest vertex index that the faces use, and where.
struct LargestIndex {
    uint32_t index = 0;
    size_t place = 0;
    bool any = false;

    void see(uint32_t value, size_t where) {
        if (!any || value > index) {
            *this = {value, where, true};
        }
    }
    bool beyond(size_t count) const { return any && index >= count; }
};

} // namespace anvil
