// What benchmarks of occluders share: meshes by name, and winding numbers to hold signs against.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/support/summed_winding.h"

#include <cstdlib>
#include <string>

namespace anvil::bench {

/// A file, or SAMPLE:VERTICES.
inline Mesh mesh_named(const std::string& name) {
    const size_t colon = name.rfind(':');
    if (colon != std::string::npos) {
        return make_sample(name.substr(0, colon), std::strtoul(name.c_str() + colon + 1, nullptr, 10));
    }
    Log log;
    return read_mesh(name, log);
}

} // namespace anvil::bench
