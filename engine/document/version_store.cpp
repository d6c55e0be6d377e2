#include "engine/document/version_store.h"

#include "engine/core/error.h"
#include "engine/document/surface_difference.h"

#include <algorithm>
#include <set>

namespace anvil {

namespace {

/// All that the result of an edit depends on, apart from the surface before it and the back end.
struct EditContent {
    Edit edit; ///< its occluders with everything filled in
    std::vector<OccluderShape> shapes;
    std::vector<Field> fields;

    bool operator==(const EditContent&) const = default;
};

EditContent content_of(const Recipe& recipe, const Edit& edit) {
    EditContent content{edit, {}, {}};
    content.edit.occluders = occluders_of(recipe, edit);
    for (const OccluderUse& use : *content.edit.occluders) {
        const Occluder& occluder = *find_occluder(recipe, use.name);
        content.shapes.push_back(occluder.shape);
        content.fields.push_back(field_of(occluder));
    }
    return content;
}

std::string maker_of(const Backend& backend) {
    return backend.device_name() + "\n" + backend.driver_name();
}

} // namespace

struct VersionStore::Place {
    std::shared_ptr<Place> before; ///< empty: the file's mesh
    EditContent content;
    std::shared_ptr<const SurfaceVersion> version; ///< empty: to be made (again)
    std::optional<SurfaceDifference> change;       ///< that makes it of the surface before it
    std::string maker;                             ///< of both
    uint64_t used = 0;

    bool made_by(const std::string& back_end) const { return version && (!before || maker == back_end); }
    bool changed_by(const std::string& back_end) const { return change && maker == back_end; }
};

VersionStore::VersionStore(std::shared_ptr<const Mesh> file, size_t budget)
    : file_(std::make_shared<Place>()), places_{file_}, budget_(budget) {
    file_->version = std::make_shared<const SurfaceVersion>(first_version(std::move(file)));
}

std::vector<std::shared_ptr<VersionStore::Place>> VersionStore::live() const {
    std::vector<std::shared_ptr<Place>> places;
    for (const std::weak_ptr<Place>& place : places_) {
        if (auto held = place.lock()) {
            places.push_back(std::move(held));
        }
    }
    return places;
}

VersionStore::Chain VersionStore::chain_of(const Recipe& recipe) {
    std::erase_if(places_, [](const std::weak_ptr<Place>& place) { return place.expired(); });
    Chain chain = {file_};
    for (const Edit& edit : recipe.edits) {
        EditContent content = content_of(recipe, edit);
        std::shared_ptr<Place> next;
        for (const std::weak_ptr<Place>& weak : places_) {
            const auto place = weak.lock();
            if (place && place->before == chain.back() && place->content == content) {
                next = place;
                break;
            }
        }
        if (!next) {
            next = std::make_shared<Place>();
            next->before = chain.back();
            next->content = std::move(content);
            places_.push_back(next);
        }
        chain.push_back(std::move(next));
    }
    return chain;
}

std::shared_ptr<const SurfaceVersion> VersionStore::version(const Chain& chain, size_t index,
                                                            const EditOccluders& occluders,
                                                            const EditWork& work) {
    const std::string maker = maker_of(work.backend);
    if (!chain[index]->made_by(maker) && take_back_to(chain[index], maker)) {
        return chain[index]->version;
    }
    size_t first = index;
    while (!chain[first]->made_by(maker)) {
        --first;
    }
    chain[first]->used = ++clock_;
    if (first == index) {
        return chain[index]->version;
    }
    const EditTools tools{occluders, solvers_, work.backend, work.log, work.progress};
    SurfaceVersion version = *chain[first]->version;
    for (size_t i = first; i < index; ++i) {
        work.progress.report("forge", static_cast<double>(i - first) / static_cast<double>(index - first));
        Place& place = *chain[i + 1];
        if (place.changed_by(maker)) {
            apply(*place.change, version);
        } else {
            SurfaceVersion after =
                apply_edit(version, place.content.edit, "edits[" + std::to_string(i) + "]", tools);
            ++edits_applied_;
            place.version.reset();
            place.change = difference(version, after);
            place.maker = maker;
            version = std::move(after);
        }
        place.used = ++clock_;
        if (i + 1 == index || !place.change) {
            place.version = std::make_shared<const SurfaceVersion>(version);
        }
        keep_within_budget(place);
    }
    work.progress.report("forge", 1);
    return chain[index]->version;
}

/// What undoing asks for: it costs the one edit, however many there are before.
bool VersionStore::take_back_to(const std::shared_ptr<Place>& place, const std::string& maker) {
    for (const auto& next : live()) {
        if (next->before == place && next->made_by(maker) && next->change) {
            SurfaceVersion version = *next->version;
            take_back(*next->change, version);
            if (place->maker != maker) {
                place->change.reset();
            }
            place->version = std::make_shared<const SurfaceVersion>(std::move(version));
            place->maker = maker;
            place->used = ++clock_;
            keep_within_budget(*place);
            return true;
        }
    }
    return false;
}

std::shared_ptr<const SurfaceVersion> VersionStore::version_at_hand(const Chain& chain, size_t index) {
    return chain[index]->version;
}

size_t VersionStore::bytes() const {
    size_t sum = 0;
    std::set<const Mesh*> meshes;
    const auto add_mesh = [&](const SurfaceVersion& surface) {
        if (surface.refined() && meshes.insert(surface.mesh.get()).second) {
            sum += mesh_bytes(surface);
        }
    };
    for (const auto& place : live()) {
        if (place->version) {
            sum += own_bytes(*place->version);
            add_mesh(*place->version);
        }
        if (place->change) {
            sum += own_bytes(*place->change);
            add_mesh(*place->change->after);
        }
    }
    return sum;
}

std::shared_ptr<VersionStore::Place> VersionStore::oldest(const Place& pinned,
                                                          bool can_be_put_together) const {
    std::shared_ptr<Place> found;
    for (const auto& place : live()) {
        const bool holds =
            can_be_put_together ? place->version && place->change : place->version || place->change;
        const bool may_go = holds && place->before && place.get() != &pinned;
        if (may_go && (!found || place->used < found->used)) {
            found = place;
        }
    }
    return found;
}

void VersionStore::keep_within_budget(const Place& pinned) {
    while (bytes() > budget_) {
        if (const auto whole = oldest(pinned, true)) {
            whole->version.reset();
        } else if (const auto any = oldest(pinned, false)) {
            any->version.reset();
            any->change.reset();
        } else {
            return;
        }
    }
}

} // namespace anvil
