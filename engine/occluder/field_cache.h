// Baked fields between runs: what a field was baked from names it on disk.
#pragma once

#include "engine/core/file_cache.h"
#include "engine/occluder/adaptive_field.h"
#include "engine/occluder/distance_volume.h"
#include "engine/occluder/solid.h"

#include <string>
#include <string_view>

namespace anvil {

/// Where a baked field is looked for and kept; nowhere without `files`.
struct BakeCache {
    const FileCache* files = nullptr;
    std::string description; ///< of all that the field depends on
};

/// The cache's entry of a shape and field: the shape with the content of its files in place of their names.
/// @throws InputError if a file cannot be read.
BakeCache bake_cache(const FileCache* files, const OccluderShape& shape, const Field& field,
                     const SolidSource& source);

/// The bytes of a baked field, for this machine. They carry no check of their own: FileCache's suffices.
std::string packed(const DistanceVolume& volume);
std::string packed(const AdaptiveField& field);

/// False, and `sampled` is unspecified, if the bytes are not those of such a field.
bool unpack(std::string_view bytes, DistanceVolume& sampled);
bool unpack(std::string_view bytes, AdaptiveField& sampled);

/// The cached field, or what `bake()` makes, which is kept then.
template <typename Sampled, typename Bake>
Sampled cached(const BakeCache& cache, const Bake& bake) {
    if (cache.files == nullptr) {
        return bake();
    }
    Sampled sampled;
    if (const auto bytes = cache.files->find(cache.description); bytes && unpack(*bytes, sampled)) {
        return sampled;
    }
    sampled = bake();
    cache.files->keep(cache.description, packed(sampled));
    return sampled;
}

} // namespace anvil
