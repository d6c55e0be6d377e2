#include "engine/mesh/sample_shapes.h"

#include "engine/core/error.h"
#include "engine/mesh/sample_bodies.h"
#include "engine/mesh/sample_primitives.h"

namespace anvil {

namespace {

struct Shape {
    const char* name;
    size_t least; ///< vertices that the shape needs
    Mesh (*make)(size_t vertices);
};

constexpr std::array<Shape, 8> shapes{{
    {"bust", 500, sample::bust},
    {"cube", 8, sample::cube},
    {"cylinder", 8, sample::cylinder},
    {"hand", 500, sample::hand},
    {"icosphere", 4, sample::sphere},
    {"plane", 4, sample::plane},
    {"sphere", 4, sample::sphere},
    {"torus", 9, sample::torus},
}};

std::string all_names() {
    std::string list;
    for (const std::string& name : sample_shape_names()) {
        list += (list.empty() ? "" : ", ") + name;
    }
    return list;
}

} // namespace

const std::vector<std::string>& sample_shape_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        result.reserve(shapes.size());
        for (const Shape& shape : shapes) {
            result.emplace_back(shape.name);
        }
        return result;
    }();
    return names;
}

Mesh make_sample(const std::string& shape, size_t vertices) {
    const auto* const known =
        std::find_if(shapes.begin(), shapes.end(), [&](const Shape& s) { return s.name == shape; });
    if (known == shapes.end()) {
        throw InputError("there is no sample shape \"" + shape + "\"; the shapes are " + all_names());
    }
    if (vertices < known->least) {
        throw InputError("sample " + shape + ": " + std::to_string(vertices) +
                         " vertices are too few; give at least " + std::to_string(known->least));
    }
    if (vertices > max_sample_vertices) {
        throw InputError("sample " + shape + ": " + std::to_string(vertices) +
                         " vertices are too many; give at most " + std::to_string(max_sample_vertices));
    }
    return known->make(vertices);
}

} // namespace anvil
