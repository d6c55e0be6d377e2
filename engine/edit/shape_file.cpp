#include "engine/edit/shape_file.h"

#include "engine/core/atomic_file.h"
#include "engine/core/read_file.h"
#include "engine/edit/recipe_parts.h"

#include <nlohmann/json.hpp>

namespace anvil {

ShapeChoice parse_shape(const std::string& text, const std::string& file_name) {
    const nlohmann::json document = parse_json(text, file_name);
    return read_shape(JsonReader(document, file_name));
}

ShapeChoice read_shape_file(const std::filesystem::path& file) {
    return parse_shape(read_file(file), file.string());
}

void write_shape_file(const std::filesystem::path& file, const ShapeChoice& shape) {
    write_file_atomically(file, written(shape).dump(2) + "\n");
}

} // namespace anvil
