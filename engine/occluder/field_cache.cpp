#include "engine/occluder/field_cache.h"

#include "engine/core/read_file.h"
#include "engine/edit/recipe_parts.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace anvil {

namespace {

/// Raised whenever baking, or the layout of what it makes, changes.
constexpr const char* baking = "baked field 6\n";

OccluderShape by_content(OccluderShape shape, const SolidSource& source) {
    const auto hash = [&](std::string& file) {
        const std::string bytes = read_file(source.folder / file);
        // The name's ending decides how the bytes are read.
        file = std::filesystem::path(file).extension().string() + " " + content_hash(bytes);
    };
    if (auto* mesh = std::get_if<MeshShape>(&shape.solid)) {
        hash(mesh->file);
    } else if (auto* vdb = std::get_if<VdbShape>(&shape.solid)) {
        hash(vdb->file);
    } else if (auto* csg = std::get_if<CsgShape>(&shape.solid)) {
        for (CsgPart& part : csg->parts) {
            part.name.clear();
            part.shape = by_content(std::move(part.shape), source);
        }
    }
    return shape;
}

template <typename Value>
void append(std::string& bytes, const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const size_t end = bytes.size();
    bytes.resize(end + sizeof value);
    std::memcpy(bytes.data() + end, &value, sizeof value);
}

template <typename Value>
void append(std::string& bytes, const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const size_t end = bytes.size();
    bytes.resize(end + values.size() * sizeof(Value));
    std::memcpy(bytes.data() + end, values.data(), values.size() * sizeof(Value));
}

template <typename... Values>
std::string joined(const Values&... values) {
    std::string bytes;
    (append(bytes, values), ...);
    return bytes;
}

template <typename Value>
bool take(std::string_view& bytes, Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (bytes.size() < sizeof value) {
        return false;
    }
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
    return true;
}

template <typename Value>
bool take_all(std::string_view& bytes, std::vector<Value>& values) {
    if (bytes.empty() || bytes.size() % sizeof(Value) != 0) {
        return false;
    }
    values.resize(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return true;
}

} // namespace

BakeCache bake_cache(const FileCache* files, const OccluderShape& shape, const Field& field,
                     const SolidSource& source) {
    if (files == nullptr) {
        return {};
    }
    Occluder occluder;
    occluder.shape = by_content(shape, source);
    occluder.field = field;
    return {files, baking + written(occluder).dump()};
}

std::string packed(const DistanceVolume& volume) {
    return joined(volume.size, volume.centre, volume.half_size, volume.voxel, volume.error, volume.texels);
}

std::string packed(const AdaptiveField& field) {
    return joined(field.grid, field.centre, field.half_size, field.voxel, field.error, field.words);
}

bool unpack(std::string_view bytes, DistanceVolume& sampled) {
    return take(bytes, sampled.size) && take(bytes, sampled.centre) && take(bytes, sampled.half_size) &&
           take(bytes, sampled.voxel) && take(bytes, sampled.error) && take_all(bytes, sampled.texels) &&
           sampled.texels.size() == 4 * size_t{sampled.size[0]} * sampled.size[1] * sampled.size[2];
}

bool unpack(std::string_view bytes, AdaptiveField& sampled) {
    return take(bytes, sampled.grid) && take(bytes, sampled.centre) && take(bytes, sampled.half_size) &&
           take(bytes, sampled.voxel) && take(bytes, sampled.error) && take_all(bytes, sampled.words);
}

} // namespace anvil
